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

void GBufferPass::record(gpu::Commands& commands, FrameResources& frame, GpuScene& scene) const {
    commands.begin_pass("gbuffer");
    const std::array bindings{gpu::bind_buffer(frame.frame_block)};
    const VkDescriptorSet set = commands.descriptors().allocate(pipelines_.layout(), 0, bindings);
    // Texels are read only where depth says that something was drawn; just the ids are shown everywhere.
    std::vector<gpu::ColorTarget> targets{{&frame.gbuffer, gpu::Load::discard}};
    if (frame.all_targets) {
        targets.push_back({&frame.light, gpu::Load::discard});
        targets.push_back({&frame.layers, gpu::Load::discard});
        targets.push_back({&frame.ids, gpu::Load::clear});
    }
    // Shadow receivers compare neighbours, also those that no surface covers.
    if (frame.normal_mapped) targets.push_back({&frame.surface_normals, gpu::Load::clear});
    if (scene.vertices) {
        commands.use(scene.vertices, gpu::Use::vertex_input);
        commands.use(scene.indices, gpu::Use::vertex_input);
    }
    std::vector<const Draw*> draws;
    for (const Draw& draw : scene.draws) {
        if (!draw.blended) draws.push_back(&draw);
    }
    commands.begin_rendering(targets, gpu::DepthTarget{&frame.depth, gpu::Load::clear});
    pipelines_.draw(commands, scene.vertices, scene.indices, draws, set);
    commands.end_rendering();
}

}  // namespace candela::realtime
