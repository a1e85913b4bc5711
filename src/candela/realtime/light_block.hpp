#pragma once

#include <glm/vec4.hpp>

#include "candela/scene/light.hpp"

namespace candela::realtime {

/// std430 layout of a light in shaders/lights.glsl.
struct LightBlock {
    glm::vec4 position_range;
    glm::vec4 color_type;
    glm::vec4 direction_a;
    glm::vec4 right_b;
    glm::ivec4 links;
};

[[nodiscard]] LightBlock light_block(const scene::Light& light);

}  // namespace candela::realtime
