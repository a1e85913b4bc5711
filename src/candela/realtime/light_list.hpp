#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::realtime {

/// What the shaders tell apart: the light types of the scene and what real time makes of others. The numbers
/// are those of scene::LightType and, from 10 on, of shaders/lights.glsl.
enum class LightKind : std::uint8_t {
    point,
    spot,
    directional,
    frustum,
    line,
    sun,
    sphere,
    disk,
    rectangle,
    tube,
    triangle,  ///< of an emissive surface
};

/// std430 layout of a light in shaders/lights.glsl.
struct LightBlock {
    glm::vec4 position_range{0.0f};
    glm::vec4 color_type{0.0f};
    glm::vec4 direction_a{0.0f};
    glm::vec4 right_b{0.0f};
    glm::ivec4 links{0};
};

/// The lights of a scene as the frame goes through them: sorted by kind, so that a pass takes one kind after
/// the other and a pipeline leaves out the kinds that do not occur.
struct LightList {
    std::vector<LightBlock> blocks;
    std::vector<std::uint32_t> sources;  ///< of each block the index into Scene::lights
    std::uint32_t kinds = 0;             ///< bit (1 << kind) of every kind that occurs
};

[[nodiscard]] LightList light_list(const scene::Scene& scene);

/// What the lists of the shaders hold for a light: its index and, above bit 24, its kind + 1. The list ends
/// with kEndOfLights.
[[nodiscard]] std::vector<std::uint32_t> light_entries(const LightList& list);
inline constexpr std::uint32_t kEndOfLights = 0;

}  // namespace candela::realtime
