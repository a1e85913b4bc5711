#include "candela/realtime/shadow_visibility_pass.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "candela_shaders/shadow_receivers_comp.hpp"
#include "candela_shaders/shadow_visibility_comp.hpp"

namespace candela::realtime {
namespace {

constexpr std::size_t kBytesPerTile = std::size_t{kTileSize} * kTileSize;
constexpr std::size_t kMostBytes = std::size_t{128} << 20;
constexpr std::size_t kLeastLights = 16;
/// Of a workgroup of shaders/shadow_visibility.comp.glsl.
constexpr std::uint32_t kTilesPerGroup = 4;

/// Push constants of shaders/shadow_visibility.comp.glsl.
struct Area {
    glm::ivec4 tiles{0};  ///< x, y first; z, w one after the last
    std::int32_t slot = 0;
    std::array<std::int32_t, 3> unused{};
};

/// The tiles that a light's reach covers: all of them for one that reaches everywhere or to the camera.
glm::ivec4 covered_tiles(const FrameResources& frame, const scene::Light& light,
                         const scene::Camera& camera) {
    const glm::ivec4 all(0, 0, frame.tiles_x, frame.tiles_y);
    if (scene::is_distant(light.type) || !(light.range_m < 1e9f)) return all;
    const float aspect = static_cast<float>(frame.width) / static_cast<float>(frame.height);
    const glm::mat4 world_to_clip = scene::view_projection(camera, aspect);
    glm::vec2 low(1.0f);
    glm::vec2 high(-1.0f);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 side((corner & 1) ? 1.0f : -1.0f, (corner & 2) ? 1.0f : -1.0f,
                             (corner & 4) ? 1.0f : -1.0f);
        const glm::vec4 clip = world_to_clip * glm::vec4(light.position + light.range_m * side, 1.0f);
        if (!(clip.w > 0.0f)) return all;
        low = glm::min(low, glm::vec2(clip) / clip.w);
        high = glm::max(high, glm::vec2(clip) / clip.w);
    }
    // Samples of a still are shifted by up to half a pixel.
    const glm::vec2 size(frame.width, frame.height);
    const glm::vec2 first = (0.5f * low + 0.5f) * size - 1.0f;
    const glm::vec2 last = (0.5f * high + 0.5f) * size + 1.0f;
    const auto tile = [](float pixel, std::uint32_t tiles) {
        return static_cast<int>(
            std::clamp(std::floor(pixel / static_cast<float>(kTileSize)), 0.0f, static_cast<float>(tiles)));
    };
    return {tile(first.x, frame.tiles_x), tile(first.y, frame.tiles_y),
            tile(last.x + static_cast<float>(kTileSize), frame.tiles_x),
            tile(last.y + static_cast<float>(kTileSize), frame.tiles_y)};
}

}  // namespace

ShadowVisibilityPass::Variant ShadowVisibilityPass::variant_of(const FrameResources& frame,
                                                               const scene::Light& light) {
    const bool soft = frame.profile.shadow_filter == ShadowFilterTechnique::pcss;
    return {shadow_kind(light), soft ? shadow_shape(light) : ShadowShape::point};
}

ShadowVisibilityPass::ShadowVisibilityPass(const gpu::Device& device, const FrameResources& frame,
                                           std::span<const scene::Light> lights) {
    if (!frame.shadow_kinds) return;
    const auto sampled = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    receivers_ = gpu::create_compute_pipeline(
        device, shaders::shadow_receivers_comp,
        {{{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, sampled, sampled, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}}, 0});
    for (const scene::Light& light : lights) {
        if (!light.casts_shadow) continue;
        const Variant variant = variant_of(frame, light);
        if (pipelines_.contains(variant)) continue;
        const gpu::LayoutDesc layout{{{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                       sampled, sampled, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}},
                                     sizeof(Area)};
        pipelines_.emplace(variant, gpu::create_compute_pipeline(
                                        device, shaders::shadow_visibility_comp, layout,
                                        {static_cast<std::uint32_t>(variant.first),
                                         static_cast<std::uint32_t>(variant.second),
                                         static_cast<std::uint32_t>(frame.profile.contact_shadows)}));
    }
}

std::size_t ShadowVisibilityPass::most_lights(const FrameResources& frame) {
    const std::size_t light_bytes = kBytesPerTile * frame.tile_count();
    const std::size_t wanted = std::max(kMostBytes / light_bytes, kLeastLights);
    return std::min(wanted, frame.most_storage_bytes / light_bytes);
}

void ShadowVisibilityPass::reserve(const gpu::Device& device, FrameResources& frame, std::size_t lights) {
    const std::size_t bytes = std::max<std::size_t>(lights, 1) * kBytesPerTile * frame.tile_count();
    if (frame.visibilities.size() >= bytes) return;
    frame.visibilities =
        gpu::Buffer(device, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::MemoryKind::device);
}

gpu::BufferRef ShadowVisibilityPass::add(const FrameBuild& build, const gpu::ImageRef& shadow_maps,
                                         const Surfaces& surfaces, const ShadowPlan& plan,
                                         const std::vector<scene::Light>& lights) const {
    FrameResources& frame = build.frame;
    gpu::PassBuilder facets = build.graph.pass("shadow receivers");
    // Both formats keep an octahedral normal in their first word.
    const gpu::ImageRef normals = frame.normal_mapped ? surfaces.normals : surfaces.gbuffer;
    facets.read(normals);
    facets.read(surfaces.depth);
    const gpu::ImageRef receivers =
        facets.write(build.graph.create("shadow receivers", build.image(kGBufferFormat)));
    facets.record([this, &frame, &plan, normals, depth = surfaces.depth, receivers](gpu::PassContext& c) {
        if (plan.lights.empty()) return;
        c.commands.dispatch(receivers_,
                            std::array{gpu::bind_buffer(frame.frame_block),
                                       gpu::bind_sampled(c.image(normals).view(), frame.nearest.get()),
                                       gpu::bind_sampled(c.image(depth).view(), frame.nearest.get()),
                                       gpu::bind_storage(c.image(receivers).view())},
                            {}, frame.tiles_x, frame.tiles_y);
    });

    gpu::PassBuilder pass = build.graph.pass("visibility");
    pass.read(receivers);
    pass.read(shadow_maps);
    const gpu::BufferRef visibilities = pass.write(build.in.visibilities);
    pass.record([this, build, receivers, &plan, &lights](gpu::PassContext& c) {
        find_visibility(c, build, c.image(receivers), plan, lights);
    });
    return visibilities;
}

void ShadowVisibilityPass::find_visibility(gpu::PassContext& c, const FrameBuild& build,
                                           gpu::Image& receivers, const ShadowPlan& plan,
                                           const std::vector<scene::Light>& lights) const {
    const FrameResources& frame = build.frame;
    for (std::size_t slot = 0; slot < plan.lights.size(); ++slot) {
        const scene::Light& light = lights[plan.lights[slot].light];
        Area area;
        area.tiles = covered_tiles(frame, light, *build.view.camera);
        area.slot = static_cast<std::int32_t>(slot);
        const glm::ivec2 size(area.tiles.z - area.tiles.x, area.tiles.w - area.tiles.y);
        if (size.x <= 0 || size.y <= 0) continue;
        gpu::Binding records = gpu::bind_buffer(frame.shadow_records);
        records.range = kRecordsPerLight * sizeof(ShadowRecord);
        records.offset = slot * records.range;
        c.commands.dispatch(pipelines_.at(variant_of(frame, light)),
                            std::array{gpu::bind_buffer(frame.frame_block), records,
                                       gpu::bind_sampled(frame.shadow_atlas.view(), frame.nearest.get()),
                                       gpu::bind_sampled(receivers.view(), frame.nearest.get()),
                                       gpu::bind_buffer(frame.visibilities)},
                            gpu::push(area), groups(static_cast<std::uint32_t>(size.x), kTilesPerGroup),
                            static_cast<std::uint32_t>(size.y));
    }
}

}  // namespace candela::realtime
