#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::bake {

/// A picture of the sphere on the octahedron, `size` texels a side of which the outer ones are gutters.
struct OctahedralMap {
    std::uint32_t size = 0;
    std::vector<glm::vec4> texels;            ///< size * size; rgb radiance, a unused
    std::vector<float> solid_angle;           ///< interior texels, sr; gutters 0
    std::vector<glm::vec3> luminance_center;  ///< unit direction in which a texel's light is centred

    [[nodiscard]] std::uint32_t interior() const noexcept { return size - 2; }
    /// Unit direction of interior texel (x, y), both in [1, size - 2].
    [[nodiscard]] glm::vec3 direction(std::uint32_t x, std::uint32_t y) const;
};

/// Beyond an edge the octahedron goes on along the same edge, mirrored: a gutter is the interior texel across
/// the fold.
void fill_gutters(OctahedralMap& map);

/// Resamples an equirectangular environment so that every texel holds the mean of what falls into it: the sum
/// of radiance times solid angle is that of the source, however small and bright a part of it is.
[[nodiscard]] OctahedralMap from_equirect(const scene::Environment& environment, float scale,
                                          std::uint32_t size);

/// A map of about half the size, with the same sum.
[[nodiscard]] OctahedralMap halve(const OctahedralMap& from);

/// Irradiance / pi about the interior texels of a map of `size`, from all texels of `source`.
[[nodiscard]] OctahedralMap irradiance_over_pi(const OctahedralMap& source, std::uint32_t size);

}  // namespace candela::bake
