#pragma once

#include "candela/truth/geometry.hpp"
#include "candela/truth/light_tree.hpp"
#include "shading/lights/sampling.glsl"

/// Lights of scene::is_shape() as the path tracer meets them: shading/lights/ with a scene's light put in.
/// A two-sided disk or rectangle is the one-sided one whose bright side is towards the point.
namespace candela::truth {

/// A direction from the point to the light; pdf in 1/sr.
[[nodiscard]] shading::LightDirection sample_shape(const scene::Light& light, const glm::vec3& point,
                                                   const glm::vec2& u);
/// Density of sample_shape() in a unit direction that meets the light.
[[nodiscard]] float pdf_shape(const scene::Light& light, const glm::vec3& point, const glm::vec3& direction);
/// Distance in m to where a ray enters the light from its bright side; kNoEntry when it does not.
[[nodiscard]] float enter_shape(const scene::Light& light, const Ray& ray);
/// What the range and, of a disk, the cone leave of the light at a point.
[[nodiscard]] float shape_attenuation(const scene::Light& light, const glm::vec3& point);
/// Outward unit normal where `ray` enters after distance_m.
[[nodiscard]] glm::vec3 shape_normal(const scene::Light& light, const Ray& ray, float distance_m);
[[nodiscard]] scene::Aabb shape_box(const scene::Light& light);

}  // namespace candela::truth
