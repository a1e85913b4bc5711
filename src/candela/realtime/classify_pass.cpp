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

Tiles ClassifyPass::add(const FrameBuild& build, const Surfaces& surfaces) const {
    FrameResources& frame = build.frame;
    const std::size_t lists = std::size_t{kShadingClasses} * frame.tile_count() * sizeof(std::uint32_t);
    const std::size_t boxes = frame.culled_lights ? frame.tile_count() : 1;
    gpu::PassBuilder pass = build.graph.pass("classify");
    pass.read(surfaces.gbuffer);
    pass.read(surfaces.depth);
    const Tiles tiles{pass.write(build.graph.create("tiles", kArgumentBytes + lists)),
                      pass.write(build.graph.create("bounds of tiles", boxes * 2 * sizeof(glm::vec4)))};
    pass.record([this, &frame, surfaces, tiles](gpu::PassContext& c) {
        c.commands.copy(empty_lists_, c.buffer(tiles.lists), kArgumentBytes);
        c.commands.use(c.buffer(tiles.lists), gpu::Use::storage_write);
        const std::array bindings{gpu::bind_buffer(frame.frame_block),
                                  gpu::bind_sampled(c.image(surfaces.gbuffer).view(), frame.nearest.get()),
                                  gpu::bind_sampled(c.image(surfaces.depth).view(), frame.nearest.get()),
                                  gpu::bind_buffer(c.buffer(tiles.lists)),
                                  gpu::bind_buffer(c.buffer(tiles.bounds))};
        c.commands.dispatch(pipeline_, bindings, {}, groups(frame.tile_count(), 64));
    });
    return tiles;
}

}  // namespace candela::realtime
