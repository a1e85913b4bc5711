#pragma once

#include <cstdint>
#include <vector>

#include "candela/bake/octahedral_map.hpp"
#include "candela/scene/scene.hpp"

namespace candela::bake {

/// What the frame reads of a distant light, in the map's own frame and in texels times `scale`.
struct OctahedralLight {
    std::vector<OctahedralMap> specular;  ///< level 0 the mirror's, the mean of each texel; then LD terms of
                                          ///< shading/specular_levels.glsl
    OctahedralMap irradiance;             ///< divided by pi
};

/// By convolution in spherical harmonics, as filter_environment does it, on the processor.
[[nodiscard]] OctahedralLight filter_octahedral(const scene::Environment& environment, float scale,
                                                std::uint32_t irradiance_size);

}  // namespace candela::bake
