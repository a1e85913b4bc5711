#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::realtime {

/// How a light looks at the scene. The numbers are those of shaders/shadow_lookup.glsl.
enum class ShadowKind : std::uint32_t {
    cascades,     ///< distant lights: parallel projections along the camera's view
    perspective,  ///< one pyramid: narrow spots, frusta, one-sided disks and rectangles
    cube,         ///< six pyramids about the centre: everything that shines all around
};
inline constexpr std::uint32_t kCascades = 4;
inline constexpr std::uint32_t kCubeFaces = 6;
/// Smallest tile, and the unit of tile positions in a ShadowRecord.
inline constexpr std::uint32_t kShadowTileUnit = 64;

[[nodiscard]] ShadowKind shadow_kind(const scene::Light& light);
[[nodiscard]] std::uint32_t shadow_tiles(ShadowKind kind);

/// Square of the atlas, in texels.
struct AtlasTile {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t size = 0;
    bool operator==(const AtlasTile&) const = default;
};

struct LightShadow {
    std::uint32_t light = 0;  ///< index into Scene::lights
    ShadowKind kind = ShadowKind::perspective;
    std::array<AtlasTile, kCubeFaces> tiles{};  ///< the first shadow_tiles(kind) of them
};

/// Which lights have shadows, and where in the atlas.
struct ShadowPlan {
    std::vector<LightShadow> lights;  ///< the most important one first
    std::uint32_t atlas_texels = 0;   ///< side; a power of two
    std::uint32_t unshadowed = 0;     ///< lights that should cast shadows but found no room
};

/// What a light asks for.
struct ShadowRequest {
    std::uint32_t light = 0;
    ShadowKind kind = ShadowKind::perspective;
    std::uint32_t size = 0;  ///< of a tile: a power of two
    float importance = 0.0f;
    float coverage = 1.0f;  ///< of the picture's height
};

/// One request a light that casts shadows: tiles as fine as the picture's pixels where the light reaches
/// (cascades by `cascade_texels` to a pixel), and the importance screen coverage times illuminance (lx,
/// half-way to where the light ends).
[[nodiscard]] std::vector<ShadowRequest> shadow_requests(const std::vector<scene::Light>& lights,
                                                         const scene::Aabb& bounds,
                                                         const scene::Camera& camera, std::uint32_t width,
                                                         std::uint32_t height, float cascade_texels = 1.0f);

/// Puts the requests into an atlas of at most atlas_texels a side. When they are too many, cascades keep half
/// of the atlas if they ask for it; of the other tiles, the largest for what they cover of the picture shrink
/// first, down to the smallest size. After that the least important lights go without, and those after the
/// first most_lights.
[[nodiscard]] ShadowPlan plan_shadows(std::vector<ShadowRequest> requests, std::uint32_t atlas_texels,
                                      std::size_t most_lights = std::numeric_limits<std::size_t>::max());

}  // namespace candela::realtime
