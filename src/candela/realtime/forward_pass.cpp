#include "candela/realtime/forward_pass.hpp"

#include "candela/realtime/lighting_variant.hpp"
#include "candela_shaders/forward_frag.hpp"
#include "candela_shaders/forward_plain_frag.hpp"
#include "candela_shaders/forward_shadows_frag.hpp"
#include "candela_shaders/integrate_forward_frag.hpp"
#include "candela_shaders/mesh_vert.hpp"

namespace candela::realtime {
namespace {

gpu::PipelineLayout make_layout(const gpu::Device& device) {
    return {device, {{shading_set_layout(), GpuScene::material_set_layout()}, 64}};
}

gpu::GraphicsDesc make_desc(const FrameResources& frame, const GpuScene& scene) {
    const LightingVariants variants{shaders::forward_plain_frag, shaders::forward_shadows_frag,
                                    shaders::forward_frag};
    gpu::GraphicsDesc desc;
    desc.vertex = shaders::mesh_vert;
    desc.fragment = frame.integrate ? shaders::integrate_forward_frag : choose(variants, frame, scene);
    describe_vertices(desc);
    desc.color_formats = {frame.light_format(), kUnlitFormat};
    desc.blends = {gpu::Blend::premultiplied_over, gpu::Blend::premultiplied_over};
    desc.depth_format = kDepthFormat;
    desc.depth_write = false;
    return desc;
}

ShadeVariant variant(const GpuScene& scene) {
    ShadeVariant v;
    v.light_kinds = scene.light_list.kinds;
    v.forward = true;
    return v;
}

}  // namespace

ForwardPass::ForwardPass(const gpu::Device& device, const FrameResources& frame, const GpuScene& scene)
    : pipelines_(device, make_layout(device), make_desc(frame, scene), variant(scene)),
      order_(device, scene) {
    pipelines_.prepare(frame, scene, true);
}

Lit ForwardPass::add(const FrameBuild& build, const Surfaces& surfaces, Lit lit) {
    if (order_.empty()) return lit;
    FrameResources& frame = build.frame;
    GpuScene& scene = build.scene;
    const FrameView& view = build.view;
    gpu::PassBuilder pass = build.graph.pass("forward");
    read_shading_inputs(pass, build.in);
    pass.read(build.in.vertices, gpu::Use::vertex_input);
    lit.light = pass.color(lit.light, gpu::Load::keep);
    lit.unlit = pass.color(lit.unlit, gpu::Load::keep);
    (void)pass.depth(surfaces.depth, gpu::Load::keep);
    pass.record([this, &frame, &scene, &view](gpu::PassContext& c) {
        const glm::mat4& camera = view.camera->world;
        order_.sort(scene, glm::vec3(camera[3]), glm::normalize(glm::vec3(camera[2])));
        const VkDescriptorSet set =
            c.commands.descriptors().allocate(pipelines_.layout(), 0, shading_bindings(frame, scene));
        c.begin_rendering();
        pipelines_.draw(c.commands, scene.vertices, order_.indices(), order_.draws(), set);
        c.commands.end_rendering();
    });
    return lit;
}

}  // namespace candela::realtime
