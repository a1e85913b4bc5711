#include "candela/realtime/gbuffer_pass.hpp"

#include "candela_shaders/gbuffer_all_frag.hpp"
#include "candela_shaders/gbuffer_frag.hpp"
#include "candela_shaders/gbuffer_normals_frag.hpp"
#include "candela_shaders/mesh_vert.hpp"

namespace candela::realtime {
namespace {

gpu::PipelineLayout make_layout(const gpu::Device& device) {
    return {device, {{{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER}, GpuScene::material_set_layout()}, 64}};
}

gpu::GraphicsDesc make_desc(const FrameResources& frame) {
    gpu::GraphicsDesc desc;
    desc.vertex = shaders::mesh_vert;
    desc.fragment = frame.all_targets ? shaders::gbuffer_all_frag : shaders::gbuffer_frag;
    describe_vertices(desc);
    desc.color_formats = {kGBufferFormat};
    if (frame.all_targets)
        desc.color_formats = {kGBufferFormat, frame.light_format(), kGBufferFormat, kIdFormat};
    if (frame.normal_mapped) {
        desc.fragment = shaders::gbuffer_normals_frag;
        desc.color_formats.push_back(kSurfaceNormalFormat);
    }
    desc.blends.assign(desc.color_formats.size(), gpu::Blend::off);
    desc.depth_format = kDepthFormat;
    return desc;
}

}  // namespace

GBufferPass::GBufferPass(const gpu::Device& device, const FrameResources& frame, const GpuScene& scene)
    : pipelines_(device, make_layout(device), make_desc(frame), {}) {
    pipelines_.prepare(frame, scene, false);
}

Surfaces GBufferPass::add(const FrameBuild& build) const {
    FrameResources& frame = build.frame;
    GpuScene& scene = build.scene;
    Surfaces s;
    s.layers = build.in.no_layers;
    s.normals = build.in.no_normals;
    gpu::PassBuilder pass = build.graph.pass("gbuffer");
    // Texels are read only where depth says that something was drawn; just the ids are shown everywhere.
    s.gbuffer = pass.color(build.graph.create("gbuffer", build.image(kGBufferFormat)), gpu::Load::discard);
    s.light = build.graph.create("light", build.image(frame.light_format()));
    if (frame.all_targets) {
        s.light = pass.color(s.light, gpu::Load::discard);
        s.layers = pass.color(build.graph.create("layers", build.image(kGBufferFormat)), gpu::Load::discard);
        s.ids = pass.color(build.graph.create("ids", build.image(kIdFormat)), gpu::Load::clear);
    }
    // Shadow receivers compare neighbours, also those that no surface covers.
    if (frame.normal_mapped)
        s.normals =
            pass.color(build.graph.create("normals", build.image(kSurfaceNormalFormat)), gpu::Load::clear);
    s.depth = pass.depth(build.graph.create("depth", build.image(kDepthFormat)), gpu::Load::clear);
    pass.read(build.in.vertices, gpu::Use::vertex_input);
    pass.read(build.in.indices, gpu::Use::vertex_input);
    pass.record([this, &frame, &scene](gpu::PassContext& c) {
        const std::array bindings{gpu::bind_buffer(frame.frame_block)};
        const VkDescriptorSet set = c.commands.descriptors().allocate(pipelines_.layout(), 0, bindings);
        std::vector<const Draw*> draws;
        for (const Draw& draw : scene.draws) {
            if (!draw.blended) draws.push_back(&draw);
        }
        c.begin_rendering();
        pipelines_.draw(c.commands, scene.vertices, scene.indices, draws, set);
        c.commands.end_rendering();
    });

    const bool unlit = scene.any_unlit || scene.any_blended;
    s.unlit =
        build.graph.create("unlit", unlit ? build.image(kUnlitFormat) : gpu::ImageDesc{1, 1, kUnlitFormat});
    if (unlit) {
        gpu::PassBuilder clear = build.graph.pass("clear unlit");
        s.unlit = clear.color(s.unlit, gpu::Load::clear);
        clear.record([](gpu::PassContext& c) {
            c.begin_rendering();
            c.commands.end_rendering();
        });
    }
    return s;
}

}  // namespace candela::realtime
