#pragma once

#include <cstdint>

#include "candela/bake/cube_pyramid.hpp"
#include "candela/scene/cube_map.hpp"

namespace candela::bake {

/// The LD term at the centres of a cube's texels by `sample_count` samples of GGX, each reading the level of
/// the source that is as coarse as its share of the sphere, Krivanek & Colbert 2008, or (`filtered` false)
/// always the finest.
[[nodiscard]] scene::CubeMap ggx_samples_cube(const CubePyramid& source, float alpha, std::uint32_t size,
                                              std::uint32_t sample_count, bool filtered);

/// A cosine lobe in place of GGX's, summed over all texels of the source in which it has more than 1e-6 of
/// its peak.
[[nodiscard]] scene::CubeMap cosine_power_cube(const CubePyramid& source, float alpha, std::uint32_t size);

}  // namespace candela::bake
