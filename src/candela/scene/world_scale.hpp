#pragma once

#include "candela/scene/scene.hpp"

namespace candela::scene {

/// The unit in m, a power of two, in which a scene is of a size that single precision and the fixed distances
/// of the shaders (shading/ray_origin.glsl, near planes) suit: 1 for diagonals of 1/8 m to 131 km. Smaller
/// scenes become 1 to 2 units wide, larger ones as few times smaller as will do.
[[nodiscard]] double suitable_unit_m(const Scene& scene);

/// States every position and length of scene and camera in another unit: luminances and illuminances stay as
/// they are, so intensities change by its square. Exact, because units are powers of two.
void set_unit(Scene& scene, Camera& camera, double unit_m);

}  // namespace candela::scene
