#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "candela/scene/scene.hpp"

/// The two meters of Frostbite Figure 21, held into a scene. Both come down to a picture: of a white card
/// that lies where the incident meter is held, or of what the spot meter points at. So whatever renders
/// pictures can be read.
namespace candela::measure {

/// Puts a matt card of reflectance 1 into the scene, facing along unit `normal` a hair above `at`, and
/// returns the camera that sees nothing but it: luminance * pi is then the illuminance. The card is a few
/// tenths of a millimetre wide, so that it neither shades nor lights what is around it.
[[nodiscard]] scene::Camera hold_card(scene::Scene& scene, const glm::vec3& at, const glm::vec3& normal);

/// A camera at `from` that sees a square of field_rad towards `towards`.
[[nodiscard]] scene::Camera point_spot_meter(const glm::vec3& from, const glm::vec3& towards,
                                             float field_rad);

/// A camera that sees one pixel of another's picture, (0, 0) at its upper left corner, and nothing else.
[[nodiscard]] scene::Camera through_pixel(const scene::Camera& camera, const glm::uvec2& pixel,
                                          const glm::uvec2& size);

}  // namespace candela::measure
