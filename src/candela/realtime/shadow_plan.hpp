#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::realtime {

/// How a light looks at the scene. The numbers are those of shaders/shadows.glsl.
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
    std::vector<LightShadow> lights;
    std::uint32_t atlas_texels = 0;  ///< side; a power of two
    std::uint32_t unshadowed = 0;    ///< lights that should cast shadows but found no room
};

/// What a light asks for.
struct ShadowRequest {
    std::uint32_t light = 0;
    ShadowKind kind = ShadowKind::perspective;
    std::uint32_t size = 0;  ///< of a tile: a power of two
    float importance = 0.0f;
};

/// One request a light that casts shadows: tiles as fine as the picture's pixels where the light reaches, and
/// the importance screen coverage times illuminance (lx, half-way to where the light ends).
[[nodiscard]] std::vector<ShadowRequest> shadow_requests(const std::vector<scene::Light>& lights,
                                                         const scene::Aabb& bounds,
                                                         const scene::Camera& camera, std::uint32_t width,
                                                         std::uint32_t height);

/// Puts the requests into an atlas of at most atlas_texels a side. When they are too many all tiles shrink
/// alike, down to the smallest; after that the least important lights go without.
[[nodiscard]] ShadowPlan plan_shadows(std::vector<ShadowRequest> requests, std::uint32_t atlas_texels);

}  // namespace candela::realtime
