#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "candela/scene/scene.hpp"

namespace candela::realtime {

/// The least and the greatest depth along the view, in m, of what the camera sees of the boxes: of their
/// parts that lie in its frustum, between its clipping planes. A ground that the picture cuts off ends where
/// the picture does. (znear_m, znear_m) when it sees none. Boxes that are empty are left out.
[[nodiscard]] glm::vec2 visible_depths_m(const scene::Camera& camera, float aspect,
                                         std::span<const scene::Aabb> boxes);

}  // namespace candela::realtime
