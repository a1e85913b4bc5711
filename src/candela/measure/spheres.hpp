#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "candela/measure/experiment.hpp"

namespace candela::measure {

/// Linear Rec.709 luminance, 1 = display white, of a point of the sphere in this row and column, with unit
/// normal n, seen from (0, 0, 1) at a distance.
using ShadeSphere = std::function<glm::vec3(int row, int column, const glm::vec3& n)>;

/// A grid of spheres of `diameter` pixels on white, sRGB-encoded and clipped at white.
[[nodiscard]] Panel sphere_grid(int rows, int columns, int diameter, const ShadeSphere& shade);

}  // namespace candela::measure
