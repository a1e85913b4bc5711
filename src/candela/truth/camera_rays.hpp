#pragma once

#include "candela/truth/geometry.hpp"

namespace candela::truth {

/// A thin lens; radius 0 is a pinhole, as the real-time frame has it.
struct Lens {
    float radius_m = 0.0f;
    float focus_m = 1.0f;  ///< distance of the plane in focus, along the view
};

/// Radius in m of the aperture of a lens that sees yfov_rad on a sensor 24 mm high, at f/aperture_f.
[[nodiscard]] float lens_radius_m(float yfov_rad, float aperture_f);

/// Rays of a camera through a picture; pixel for pixel those of the real-time frame (scene::view_projection).
class CameraRays {
  public:
    CameraRays(const scene::Camera& camera, std::uint32_t width, std::uint32_t height, const Lens& lens = {});
    /// pixel: position in the picture in pixels, (0, 0) at its upper left corner. lens_u in [0,1)^2. The ray
    /// starts on the near plane and ends on the far plane.
    [[nodiscard]] Ray through(const glm::vec2& pixel, const glm::vec2& lens_u) const;
    /// Distance in m of a point of a ray from the camera's plane: the depth that the real-time frame shows.
    [[nodiscard]] float depth_m(const Ray& ray, float distance_m) const;

  private:
    [[nodiscard]] Ray clipped(Ray ray) const;

    scene::Camera camera_;
    glm::vec2 half_size_;  ///< of the picture: at distance 1, or in m when orthographic
    glm::vec2 pixel_scale_;
    Lens lens_;
};

}  // namespace candela::truth
