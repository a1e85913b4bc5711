#pragma once

#include <glm/vec4.hpp>

#include "candela/scene/light.hpp"

namespace candela::realtime {

/// std430 layout of a light in shaders/lights.glsl.
struct LightBlock {
    glm::vec4 position_range{0.0f};
    glm::vec4 color_type{0.0f};
    glm::vec4 direction_a{0.0f};
    glm::vec4 right_b{0.0f};
    glm::ivec4 links{0};
};

[[nodiscard]] LightBlock light_block(const scene::Light& light);

}  // namespace candela::realtime
