#pragma once

#include <cstdint>
#include <vector>

#include "candela/realtime/light_block.hpp"
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
    tube,
    sun,
    sphere,
    disk,
    rectangle,
    triangle,     ///< of an emissive surface
    photometric,  ///< point or spot with a profile
};
[[nodiscard]] constexpr std::uint32_t kind_bit(LightKind kind) noexcept {
    return 1u << static_cast<std::uint32_t>(kind);
}
inline constexpr std::uint32_t kAreaKinds = kind_bit(LightKind::line) | kind_bit(LightKind::sun) |
                                            kind_bit(LightKind::sphere) | kind_bit(LightKind::disk) |
                                            kind_bit(LightKind::rectangle) | kind_bit(LightKind::tube) |
                                            kind_bit(LightKind::triangle);

/// Of LightList::kinds: some rectangle shows a picture.
inline constexpr std::uint32_t kLightImages = 1u << 16u;

/// All that a light reaches, std430 layout of shaders/cull_lights.comp.glsl: within the ball and within the
/// cone from its centre. A one-sided disk or rectangle has the cone of 90 degrees.
struct LightReach {
    glm::vec4 ball{0.0f};                      ///< centre, radius in m
    glm::vec4 cone{0.0f, 0.0f, -1.0f, -1.0f};  ///< unit axis, cosine of the half angle; below 0: no cone
};

/// The lights of a scene as the frame goes through them: sorted by kind, so that a pass takes one kind after
/// the other and a pipeline leaves out the kinds that do not occur.
struct LightList {
    std::vector<LightBlock> blocks;
    std::vector<LightReach> reaches;
    /// Of each the index into Scene::lights, after those into emissive_shapes; no_index: emissive triangles.
    std::vector<std::uint32_t> sources;
    std::vector<scene::Light> emissive_shapes;
    /// The tables of all profiles in cd, then the pictures that rectangles show, one after the other.
    std::vector<float> tables;
    std::uint32_t kinds = 0;    ///< kind_bit() of every kind that occurs, and kLightImages
    std::uint32_t bounded = 0;  ///< lights that do not reach everywhere
};

/// with_emissive: emissive surfaces give light too (emissive_lights.hpp).
[[nodiscard]] LightList light_list(const scene::Scene& scene, bool with_emissive);

/// Of the lights that the camera sees as shapes (sphere, disk, rectangle, tube), the indices into the list.
[[nodiscard]] std::vector<std::uint32_t> shape_lights(const LightList& list);

/// What the lists of the shaders hold for a light: its index and, from bit 24 on, its kind + 1. The list ends
/// with 0.
[[nodiscard]] std::vector<std::uint32_t> light_entries(const LightList& list);

}  // namespace candela::realtime
