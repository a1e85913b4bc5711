#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "candela/realtime/shadow_plan.hpp"

namespace candela::realtime {

/// std140 layout of shaders/shadow_lookup.glsl.
struct ShadowRecord {
    glm::vec4 right;  ///< rows that take a point of the world into the record's frame, m
    glm::vec4 up;
    glm::vec4 forward;  ///< away from the light
    glm::vec4 texels;   ///< xy: per unit of x/z (of x for cascades); zw: centre of the tile, or half a face
    glm::vec4 numbers;  ///< x near plane (cascades: depth of the frame), y depth of the light's centre, z
                        ///< half the tile in texels, w length of a texel at 1 m (cascades: anywhere), m
    glm::vec4 extent;   ///< xy half size of what shines along the frame's x and y, m (sun: of its disc at 1
                        ///< m); z shape; w 1 / texels of the atlas
    glm::uvec4 faces;   ///< x, y, z: corners of a cube's tiles in units of 64 texels, 8 bits each; w cascades
                        ///< from here on
    glm::uvec4 unused;
};
/// Of every light; distant ones have one a cascade, the others use the first.
inline constexpr std::uint32_t kRecordsPerLight = kCascades;
/// As far apart as every device allows a uniform buffer to begin.
static_assert(kRecordsPerLight * sizeof(ShadowRecord) % 256 == 0);

/// How `extent` is spread; numbers of shaders/shadow_lookup.glsl.
enum class ShadowShape : std::uint32_t {
    point,
    facing_disc,  ///< towards the receiver
    disc,         ///< across the light's own axes
    rectangle,
    tube,  ///< along `right` and across the line of sight
};

struct ShadowView {
    glm::mat4 world_to_clip{1.0f};  ///< reversed depth
    AtlasTile tile;
    bool of_emissive_surface = false;  ///< of a light that an emissive surface is
    bool operator==(const ShadowView&) const = default;
};

struct LightViews {
    std::vector<ShadowRecord> records;
    std::vector<ShadowView> views;
};

[[nodiscard]] ShadowShape shadow_shape(const scene::Light& light);

/// A light that stays where it is whatever the camera does.
[[nodiscard]] LightViews local_views(const scene::Light& light, const LightShadow& shadow);

/// Parallel projections that follow the camera. Their axes turn with the light alone, their sizes change in
/// steps and their corners move by whole texels, so that a moving camera does not make edges crawl.
/// `visible_m`: the least and the greatest depth of what the camera sees (visible_depths.hpp), which the
/// cascades share.
[[nodiscard]] LightViews cascade_views(const scene::Light& light, const LightShadow& shadow,
                                       const scene::Camera& camera, float aspect, const scene::Aabb& bounds,
                                       const glm::vec2& visible_m);

}  // namespace candela::realtime
