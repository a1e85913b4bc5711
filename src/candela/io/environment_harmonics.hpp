#pragma once

#include <string>

#include "candela/scene/cube_map.hpp"

/// The nine coefficients of scene::FilteredEnvironment::irradiance_sh, in cd/m^2 times `scale`, as text.
namespace candela::io::detail {

[[nodiscard]] std::string harmonics_json(const scene::FilteredEnvironment& environment);
/// A C header (also C++): the coefficients of the plain polynomial and a function that sums it.
[[nodiscard]] std::string harmonics_c(const scene::FilteredEnvironment& environment);
[[nodiscard]] std::string harmonics_glsl(const scene::FilteredEnvironment& environment);

/// The same number in every locale, to all its digits.
[[nodiscard]] std::string digits(float value);

}  // namespace candela::io::detail
