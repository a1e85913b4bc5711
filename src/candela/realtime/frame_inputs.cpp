#include "candela/realtime/frame.hpp"

namespace candela::realtime {

FrameInputs import_inputs(gpu::FrameGraph& graph, FrameResources& frame, GpuScene& scene) {
    FrameInputs in;
    in.vertices = graph.import("vertices", scene.vertices);
    in.indices = graph.import("indices", scene.indices);
    in.lights = graph.import("lights", scene.lights);
    in.light_reaches = graph.import("reaches of lights", scene.light_reaches);
    in.light_tables = graph.import("tables of lights", scene.light_tables);
    in.light_lists = graph.import("lists of lights", frame.light_lists);
    in.integrate_tables = graph.import("tables of the integrals", frame.integrate_tables.buffer);
    in.local_light = graph.import("probes and volumes", frame.local.buffer);
    in.local_atlas = graph.import("atlas of probes", frame.local.atlas);
    in.dfg = graph.import("DFG table", frame.dfg);
    in.ltc = graph.import("LTC table", frame.ltc);
    in.environment_specular = graph.import("environment, specular", frame.environment.specular);
    in.environment_irradiance = graph.import("environment, irradiance", frame.environment.irradiance);
    in.environment_background = graph.import("environment, background", frame.environment.background);
    in.shadow_records = graph.import("shadow records", frame.shadow_records);
    in.shadow_atlas = graph.import("shadow atlas", frame.shadow_atlas);
    in.visibilities = graph.import("visibilities", frame.visibilities);
    in.no_layers = graph.import("no layers", frame.no_layers);
    in.no_normals = graph.import("no normals", frame.no_normals);
    return in;
}

void read_shading_inputs(gpu::PassBuilder& pass, const FrameInputs& in) {
    for (const gpu::BufferRef& buffer : {in.lights, in.light_lists, in.light_tables, in.integrate_tables,
                                         in.shadow_records, in.visibilities, in.local_light})
        pass.read(buffer);
    for (const gpu::ImageRef& image : {in.ltc, in.dfg, in.environment_specular, in.environment_irradiance,
                                       in.environment_background, in.shadow_atlas, in.local_atlas})
        pass.read(image);
}

}  // namespace candela::realtime
