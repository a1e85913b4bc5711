#include "candela/realtime/light_block.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/vec2.hpp>

namespace candela::realtime {
namespace {

/// What the types keep in the fourth component of the direction and of `right`.
glm::vec2 type_numbers(const scene::Light& light) {
    switch (light.type) {
        case scene::LightType::spot:
            return {std::cos(light.inner_cone_rad), std::cos(light.outer_cone_rad)};
        case scene::LightType::frustum:
            return {std::tan(0.5f * light.horizontal_angle_rad), std::tan(0.5f * light.vertical_angle_rad)};
        case scene::LightType::sun:
            // One minus a cosine this near to 1 has few digits.
            return {std::cos(0.5f * light.angular_diameter_rad), 0.5f * light.angular_diameter_rad};
        case scene::LightType::rectangle:
            return {light.half_width_m, light.half_height_m};
        default:
            return {light.half_width_m, light.radius_m};
    }
}

}  // namespace

LightBlock light_block(const scene::Light& light) {
    constexpr int two_sided = 1;
    constexpr int limb_darkening = 2;
    constexpr int visible = 4;
    const glm::vec2 numbers = type_numbers(light);
    LightBlock block{};
    block.position_range = glm::vec4(light.position, std::min(light.range_m, 1e18f));
    block.color_type = glm::vec4(light.color * light.intensity, static_cast<float>(light.type));
    block.direction_a = glm::vec4(light.direction, numbers.x);
    block.right_b = glm::vec4(light.right, numbers.y);
    block.links = glm::ivec4((light.two_sided ? two_sided : 0) | (light.limb_darkening ? limb_darkening : 0) |
                                 (light.visible ? visible : 0),
                             -1, -1, 0);
    if (light.type == scene::LightType::disk && light.cone) {
        const auto cosine = [](float rad) { return std::bit_cast<int>(std::max(std::cos(rad), 0.0f)); };
        block.links.y = cosine(light.inner_cone_rad);
        block.links.w = cosine(light.outer_cone_rad);
    }
    return block;
}

}  // namespace candela::realtime
