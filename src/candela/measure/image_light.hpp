#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "candela/scene/cube_map.hpp"
#include "shading/stretched_reflection.glsl"

/// Distant light from pictures of all directions, with the integrals over it, for experiments. Sums are
/// deterministic and take each of their points from the level of the picture whose texels are as large as the
/// point's share.
namespace candela::measure {

class ImageLight {
  public:
    /// `luminance` of unit directions, in units of its own, +Y up.
    ImageLight(std::string name, const std::function<glm::vec3(const glm::vec3&)>& luminance);

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    /// Bilinear within a face and linear between levels, of texels of about this solid angle in sr.
    [[nodiscard]] glm::vec3 around(const glm::vec3& direction, float solid_angle_sr) const;
    /// What a perfectly prefiltered map holds: Frostbite equation 53 (n = v = r, weighted by n.l).
    [[nodiscard]] glm::vec3 prefiltered(const glm::vec3& direction, float perceptual_roughness,
                                        int samples = 512) const;
    [[nodiscard]] glm::vec3 irradiance_over_pi(const glm::vec3& n) const;

  private:
    std::string name_;
    std::vector<scene::CubeMap> levels_;  ///< finest first
};

/// Studio, clear sky with sun, overcast sky, two-tone, lamps at night, leaves: from soft to a peak of a
/// million times the mean.
[[nodiscard]] const std::vector<ImageLight>& image_lights();

/// A surface under it, in the world; bases are right-handed and unit.
struct ReceiverFrame {
    glm::vec3 t;
    glm::vec3 b;
    glm::vec3 n;
    glm::vec3 v;
};
/// Seen at cosine NoV, turned by number: `count` of them spread over the sphere of normals and the azimuth.
[[nodiscard]] ReceiverFrame receiver_frame(float NoV, int number, int count);

/// Integral of L(l) f(l) over directions drawn in the frame of (t, b, n): draw(u) gives l, z up, and its
/// density; `integrand` is f(v, l) n.l for local l.
struct DrawnDirection {
    glm::vec3 l;
    float pdf = 0.0f;
};
[[nodiscard]] glm::vec3 integrate_light(const ImageLight& light, const ReceiverFrame& frame, int samples,
                                        const std::function<DrawnDirection(const glm::vec2&)>& draw,
                                        const std::function<glm::vec3(const glm::vec3&)>& integrand);

/// The same with the lobe of GGX as the draw: visible normals of alpha along t and b.
[[nodiscard]] glm::vec3 integrate_light_ggx(const ImageLight& light, const ReceiverFrame& frame,
                                            const glm::vec2& alpha, int samples,
                                            const std::function<glm::vec3(const glm::vec3&)>& integrand);

}  // namespace candela::measure
