#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "candela/bake/cube_pyramid.hpp"
#include "candela/bake/filter_environment.hpp"
#include "candela/bake/lobe_field.hpp"

namespace candela::bake {

/// Harmonics of a map as far as lobes of `least_alpha` and wider need them.
[[nodiscard]] Harmonics analyze_for(const EquirectLight& light, float least_alpha);

/// A lobe that is so narrow that it is summed over its own points instead.
[[nodiscard]] bool is_narrow(float alpha);

/// A level from a field, in world directions.
[[nodiscard]] scene::CubeMap sample_cube(const LobeField& field, float rotation_rad, float alpha,
                                         std::uint32_t size, TexelValue texel);

/// A level of a narrow lobe: points of equal weight on the source without its peaks, and the lobe itself for
/// those.
[[nodiscard]] scene::CubeMap narrow_cube(const EquirectLight& light, const CubePyramid& smooth, float alpha,
                                         std::uint32_t size);

}  // namespace candela::bake
