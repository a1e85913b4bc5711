#pragma once

#include "candela/scene/scene.hpp"
#include "candela/truth/light_sample.hpp"
#include "shading/lights/falloff_windows.glsl"

namespace candela::truth {

/// Light from a point, spot, frustum or line; u picks the point of a line, which has the inverse square.
[[nodiscard]] LightSample sample_punctual(const scene::Light& light, const scene::Scene& scene,
                                          const shading::Falloff& falloff, const glm::vec3& point, float u);

}  // namespace candela::truth
