#pragma once

#include "candela/scene/scene.hpp"
#include "candela/truth/light_sample.hpp"

namespace candela::truth {

/// Light from a point, spot, frustum or line; u picks the point of a line.
[[nodiscard]] LightSample sample_punctual(const scene::Light& light, const scene::Scene& scene,
                                          const glm::vec3& point, float u);

}  // namespace candela::truth
