#pragma once

#include <optional>
#include <vector>

#include "candela/realtime/light_block.hpp"
#include "candela/scene/scene.hpp"

namespace candela::realtime {

/// Emissive surfaces are lights of their own, as rectangles where two triangles make one, else as triangles,
/// up to this many. More are grouped, all of their power kept.
inline constexpr std::size_t kMaxEmissivePieces = 32;
inline constexpr std::size_t kMaxEmissiveGroups = 16;

struct EmissiveLight {
    LightBlock block;
    std::optional<scene::Light>
        shape;  ///< the same as a light of the scene, for its shadow; triangles have none
};

/// The lights of a scene's emissive surfaces, unlit materials apart, without those that light nothing to
/// speak of (emissive_cut.hpp). Textured emission is its mean over a triangle.
///
/// A flat group is its bounding rectangle with the mean luminance over it, or a disk. Any other group is a
/// disk and a sphere of the group's mean luminance: the disk has the pieces' vector area (the sum of area
/// times normal), which is what a bowl-shaped group shows to its front, and the sphere the area that is left,
/// which is all of it for a closed surface. Both together give the power of the pieces, and a sphere of
/// triangles gives the light of the sphere.
[[nodiscard]] std::vector<EmissiveLight> emissive_lights(const scene::Scene& scene);

/// An emissive primitive of an instance, unlit materials apart. It casts light in every mode.
struct EmissiveSurface {
    std::uint32_t instance = 0;
    std::uint32_t material = 0;
    std::size_t triangles = 0;
    double area_m2 = 0.0;
    glm::dvec3 mean_nit{0.0};  ///< over the area; a texture is in it
};
[[nodiscard]] std::vector<EmissiveSurface> emissive_surfaces(const scene::Scene& scene);

}  // namespace candela::realtime
