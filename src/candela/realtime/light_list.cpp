#include "candela/realtime/light_list.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace candela::realtime {
namespace {

LightKind kind_of(const scene::Light& light) {
    return static_cast<LightKind>(light.type);
}

/// What the types keep in the fourth component of the direction and of `right`.
glm::vec2 type_numbers(const scene::Light& light) {
    switch (light.type) {
        case scene::LightType::spot:
            return {std::cos(light.inner_cone_rad), std::cos(light.outer_cone_rad)};
        case scene::LightType::frustum:
            return {std::tan(0.5f * light.horizontal_angle_rad), std::tan(0.5f * light.vertical_angle_rad)};
        case scene::LightType::sun:
            return {std::cos(0.5f * light.angular_diameter_rad), 0.0f};
        case scene::LightType::rectangle:
            return {light.half_width_m, light.half_height_m};
        default:
            return {light.half_width_m, light.radius_m};
    }
}

LightBlock light_block(const scene::Light& light) {
    constexpr int two_sided = 1;
    constexpr int limb_darkening = 2;
    const glm::vec2 numbers = type_numbers(light);
    LightBlock block;
    block.position_range = glm::vec4(light.position, std::min(light.range_m, 1e18f));
    block.color_type = glm::vec4(light.color * light.intensity, static_cast<float>(light.type));
    block.direction_a = glm::vec4(light.direction, numbers.x);
    block.right_b = glm::vec4(light.right, numbers.y);
    block.links = glm::ivec4((light.two_sided ? two_sided : 0) | (light.limb_darkening ? limb_darkening : 0),
                             -1, -1, 0);
    return block;
}

}  // namespace

LightList light_list(const scene::Scene& scene) {
    LightList list;
    list.sources.resize(scene.lights.size());
    std::iota(list.sources.begin(), list.sources.end(), 0u);
    std::stable_sort(list.sources.begin(), list.sources.end(), [&](std::uint32_t a, std::uint32_t b) {
        return kind_of(scene.lights[a]) < kind_of(scene.lights[b]);
    });
    for (const std::uint32_t source : list.sources) {
        const scene::Light& light = scene.lights[source];
        list.blocks.push_back(light_block(light));
        list.kinds |= 1u << static_cast<std::uint32_t>(kind_of(light));
    }
    return list;
}

std::vector<std::uint32_t> light_entries(const LightList& list) {
    std::vector<std::uint32_t> entries;
    for (const LightBlock& block : list.blocks) {
        entries.push_back(static_cast<std::uint32_t>(entries.size()) |
                          (static_cast<std::uint32_t>(block.color_type.w) + 1u) << 24u);
    }
    entries.push_back(kEndOfLights);
    return entries;
}

}  // namespace candela::realtime
