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

void ForwardPass::record(gpu::Commands& commands, FrameResources& frame, GpuScene& scene,
                         const glm::vec3& eye, const glm::vec3& backward) {
    if (order_.empty()) return;
    order_.sort(scene, eye, backward);
    commands.begin_pass("forward");
    use_shading_inputs(commands, frame, scene);
    const VkDescriptorSet set =
        commands.descriptors().allocate(pipelines_.layout(), 0, shading_bindings(frame, scene));
    const std::array targets{gpu::ColorTarget{&frame.light}, gpu::ColorTarget{&frame.unlit}};
    commands.begin_rendering(targets, gpu::DepthTarget{&frame.depth});
    pipelines_.draw(commands, scene.vertices, order_.indices(), order_.draws(), set);
    commands.end_rendering();
}

}  // namespace candela::realtime
