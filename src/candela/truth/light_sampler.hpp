#pragma once

#include <vector>

#include "candela/truth/distant_lights.hpp"
#include "candela/truth/light_tree.hpp"
#include "candela/truth/shape_tree.hpp"
#include "candela/truth/surface_point.hpp"
#include "shading/lights/falloff_windows.glsl"

namespace candela::truth {

/// Draws from the lights of a scene other than its environment: scene::Light and emissive triangles. All of
/// them must outlive it.
class LightSampler {
  public:
    /// falloff: of lights without extent, the profile's.
    LightSampler(const scene::Scene& scene, const Geometry& geometry, const SurfaceReader& surfaces,
                 const shading::Falloff& falloff = {});

    [[nodiscard]] bool any_near() const noexcept { return !lights_.empty(); }
    [[nodiscard]] const DistantLights& distant() const noexcept { return distant_; }
    [[nodiscard]] const ShapeTree& shapes() const noexcept { return shape_tree_; }

    /// A light that is not distant, in proportion to what it is thought to give. choice in [0,1).
    [[nodiscard]] LightSample sample_near(const glm::vec3& point, const glm::vec3& normal, float choice,
                                          const glm::vec2& u) const;
    /// Of shapes(), by index.
    [[nodiscard]] const scene::Light& shape(std::uint32_t index) const {
        return *lights_[shapes_[index]].light;
    }
    /// Luminance in cd/m^2 where a ray enters a shape, without the window of its range.
    [[nodiscard]] glm::vec3 shape_nit(std::uint32_t index, const Ray& ray, float distance_m) const;
    /// Density in 1/sr with which sample_near() draws the ray's direction as one of this shape.
    [[nodiscard]] float pdf_shape(std::uint32_t index, const Ray& ray, const glm::vec3& normal) const;
    /// Density in 1/sr with which sample_near() draws the place that a ray from `point` met; 0 when it is not
    /// a light.
    [[nodiscard]] float pdf_triangle(const Ray& ray, const glm::vec3& normal, const Hit& hit) const;

  private:
    struct NearLight {
        const scene::Light* light = nullptr;  ///< else a triangle
        std::uint32_t part = 0;
        std::uint32_t triangle = 0;
    };
    void add_light(const scene::Light& light, std::vector<LightBounds>& bounds);
    void add_emissive(std::uint32_t part, std::vector<LightBounds>& bounds);
    [[nodiscard]] LightSample sample_triangle(const NearLight& light, const glm::vec3& point,
                                              const glm::vec2& u) const;

    [[nodiscard]] LightSample sample_shape(const scene::Light& light, const glm::vec3& point,
                                           const glm::vec2& u) const;
    [[nodiscard]] glm::vec3 shape_nit(const scene::Light& light, const Ray& ray, float distance_m) const;

    const scene::Scene* scene_;
    const Geometry* geometry_;
    const SurfaceReader* surfaces_;
    Textures textures_;
    shading::Falloff falloff_;
    std::vector<NearLight> lights_;
    std::vector<std::uint32_t> shapes_;  ///< of lights_
    DistantLights distant_;
    LightTree tree_;
    ShapeTree shape_tree_;
    std::vector<std::vector<std::uint32_t>> light_of_triangle_;  ///< of each part; empty where nothing emits
};

}  // namespace candela::truth
