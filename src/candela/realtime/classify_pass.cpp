#include "candela/realtime/classify_pass.hpp"

#include <algorithm>

#include "candela_shaders/classify_comp.hpp"

namespace candela::realtime {
namespace {

constexpr std::size_t kArgumentBytes = kShadingClasses * sizeof(glm::uvec4);

/// True when every opaque surface is of the standard class.
bool one_class(const GpuScene& scene) {
    if (scene.visible_shapes > 0) return false;
    return std::none_of(scene.draws.begin(), scene.draws.end(), [](const Draw& draw) {
        return !draw.blended && (draw.features & (feature_layered | feature_unlit)) != 0;
    });
}

}  // namespace

ClassifyPass::ClassifyPass(const gpu::Device& device, const FrameResources& frame, const GpuScene& scene)
    : pipeline_(gpu::create_compute_pipeline(
          device, shaders::classify_comp,
          {{{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
             VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
             VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}},
           0},
          {one_class(scene) ? 1u : 0u, frame.culled_lights ? 1u : 0u})),
      empty_lists_(device, kArgumentBytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::MemoryKind::upload) {
    for (glm::uvec4& arguments : empty_lists_.mapped_as<glm::uvec4>()) arguments = glm::uvec4(0, 1, 1, 0);
}

std::size_t ClassifyPass::tile_buffer_bytes(std::uint32_t tiles) {
    return kArgumentBytes + std::size_t{kShadingClasses} * tiles * sizeof(std::uint32_t);
}

void ClassifyPass::record(gpu::Commands& commands, FrameResources& frame) const {
    commands.begin_pass("classify");
    commands.copy(empty_lists_, frame.tiles, kArgumentBytes);
    commands.use(frame.gbuffer, gpu::Use::sampled);
    commands.use(frame.depth, gpu::Use::sampled);
    commands.use(frame.tiles, gpu::Use::storage_write);
    commands.use(frame.tile_bounds, gpu::Use::storage_write);
    const std::array bindings{gpu::bind_buffer(frame.frame_block),
                              gpu::bind_sampled(frame.gbuffer.view(), frame.nearest.get()),
                              gpu::bind_sampled(frame.depth.view(), frame.nearest.get()),
                              gpu::bind_buffer(frame.tiles), gpu::bind_buffer(frame.tile_bounds)};
    commands.dispatch(pipeline_, bindings, {}, groups(frame.tile_count(), 64));
}

}  // namespace candela::realtime
