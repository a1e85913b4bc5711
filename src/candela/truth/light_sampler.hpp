#pragma once

#include <array>
#include <limits>
#include <vector>

#include "candela/truth/light_tree.hpp"
#include "candela/truth/surface_point.hpp"

namespace candela::truth {

struct LightSample {
    glm::vec3 direction{0.0f};  ///< unit, from the receiver
    float distance_m = std::numeric_limits<float>::infinity();
    /// Luminance in cd/m^2 of a surface; of a punctual light the illuminance in lx that it gives on a plane
    /// facing it.
    glm::vec3 light{0.0f};
    float pdf = 0.0f;    ///< 1/sr of a surface; the probability of a punctual light; 0: nothing was drawn
    bool delta = false;  ///< punctual: no other way of drawing directions finds it
};

/// Draws from the lights of a scene other than its environment: punctual lights and emissive triangles. All
/// of them must outlive it.
class LightSampler {
  public:
    LightSampler(const scene::Scene& scene, const Geometry& geometry, const SurfaceReader& surfaces);

    [[nodiscard]] bool any_near() const noexcept { return !lights_.empty(); }
    [[nodiscard]] bool any_directional() const noexcept { return !directional_.empty(); }

    /// A point light, spot or emissive triangle, in proportion to what it is thought to give. choice in
    /// [0,1).
    [[nodiscard]] LightSample sample_near(const glm::vec3& point, const glm::vec3& normal, float choice,
                                          const glm::vec2& u) const;
    [[nodiscard]] LightSample sample_directional(const glm::vec3& normal, float choice) const;
    /// Density in 1/sr with which sample_near() draws the place that a ray from `point` met; 0 when it is not
    /// a light.
    [[nodiscard]] float pdf_triangle(const Ray& ray, const glm::vec3& normal, const Hit& hit) const;

  private:
    struct NearLight {
        const scene::Light* punctual = nullptr;  ///< else a triangle
        std::uint32_t part = 0;
        std::uint32_t triangle = 0;
    };
    void add_punctual(const scene::Light& light, std::vector<LightBounds>& bounds);
    void add_emissive(std::uint32_t part, std::vector<LightBounds>& bounds);
    [[nodiscard]] LightSample sample_triangle(const NearLight& light, const glm::vec3& point,
                                              const glm::vec2& u) const;

    const Geometry* geometry_;
    const SurfaceReader* surfaces_;
    std::vector<NearLight> lights_;
    std::vector<const scene::Light*> directional_;
    LightTree tree_;
    std::vector<std::vector<std::uint32_t>> light_of_triangle_;  ///< of each part; empty where nothing emits
};

}  // namespace candela::truth
