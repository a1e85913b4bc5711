#pragma once

#include <cstddef>
#include <cstdint>

#include "candela/scene/scene.hpp"

namespace candela::scene {

/// Points and segments in the scene, once an instance.
struct StrokeCount {
    std::size_t points = 0;
    std::size_t segments = 0;
};
[[nodiscard]] StrokeCount count_strokes(const Scene& scene);

/// Replaces every instance's points and lines by triangles that face the camera and are width_px wide in a
/// picture of this size: squares and ribbons, in world space, as instances of their own. All modes then draw,
/// light and trace the same surfaces. A camera that moves afterwards sees the width that this one saw.
/// width_px > 0; glTF 2.0 leaves the width to the renderer.
void widen_strokes(Scene& scene, const Camera& camera, std::uint32_t width, std::uint32_t height,
                   float width_px);

}  // namespace candela::scene
