#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "candela/bake/equirect_light.hpp"
#include "candela/bake/harmonics.hpp"
#include "candela/scene/cube_map.hpp"

namespace candela::bake {

using Sh9 = std::array<glm::vec3, 9>;

/// Irradiance / pi of a map in the nine functions of shading/spherical_harmonics.glsl, world directions.
[[nodiscard]] Sh9 irradiance_sh(const EquirectLight& light, const Harmonics& harmonics);

/// Its value in a unit direction.
[[nodiscard]] glm::vec3 evaluate_sh(const Sh9& sh, const glm::vec3& direction);

/// Scales the bands of each channel that is negative in some direction, and of no other, so that it no longer
/// is (to 1e-5 of its mean), by the two factors that change irradiance the least in the mean square. Zonal
/// windows as those of Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks"; changed: the factors of bands 1
/// and 2 are found each for itself. His family, which dampens the Laplacian, takes from band 2 first, of
/// which the cosine has left a quarter: for one sun it needs 0.57 and 0.13 where 0.86 and 0.9 are enough.
scene::HarmonicsWindow window_negative(Sh9& sh);

}  // namespace candela::bake
