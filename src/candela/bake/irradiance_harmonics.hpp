#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "candela/bake/equirect_light.hpp"
#include "candela/bake/harmonics.hpp"

namespace candela::bake {

using Sh9 = std::array<glm::vec3, 9>;

/// Irradiance / pi of a map in the nine functions of shading/spherical_harmonics.glsl, world directions.
[[nodiscard]] Sh9 irradiance_sh(const EquirectLight& light, const Harmonics& harmonics);

/// Its value in a unit direction.
[[nodiscard]] glm::vec3 evaluate_sh(const Sh9& sh, const glm::vec3& direction);

/// Least lambda of sh_window with which no channel is negative anywhere, 0 where none is without; the window
/// is applied.
float window_negative(Sh9& sh);

}  // namespace candela::bake
