#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <memory>
#include <vector>

#include "candela/scene/scene.hpp"
#include "shading/ray_origin.glsl"

namespace candela::truth {

struct Ray {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f, 0.0f, -1.0f};  ///< unit length
    float t_max = std::numeric_limits<float>::infinity();
};

struct Hit {
    std::uint32_t part = 0;      ///< index into Geometry::parts()
    std::uint32_t triangle = 0;  ///< of the part
    float u = 0.0f;              ///< barycentric coordinates of the second and third corner
    float v = 0.0f;
    float t = 0.0f;  ///< m along the ray
};

/// One primitive of one instance in world space.
struct Part {
    const scene::Primitive* primitive = nullptr;
    std::uint32_t material = 0;
    std::uint32_t instance = 0;
    bool mirrored = false;  ///< winding is turned around
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;   ///< unit length
    std::vector<glm::vec4> tangents;  ///< as scene::Primitive; empty where nothing needs them
};

/// A scene's triangles in world space, and rays through them (Embree). Instances are copied out: a ray then
/// meets one tree and no transforms. The scene must outlive this. Rays may be traced from several threads at
/// once.
class Geometry {
  public:
    /// Throws Error (Fault::machine) when Embree fails or memory runs out.
    explicit Geometry(const scene::Scene& scene);
    ~Geometry();
    Geometry(const Geometry&) = delete;
    Geometry& operator=(const Geometry&) = delete;

    [[nodiscard]] const std::vector<Part>& parts() const noexcept { return parts_; }

    /// Nearest triangle between t_min = 0 and ray.t_max.
    [[nodiscard]] bool intersect(const Ray& ray, Hit& hit) const;
    /// Whether anything is in the way.
    [[nodiscard]] bool occluded(const Ray& ray) const;

    /// Corners of a triangle in world space, counter-clockwise seen from its front.
    void corners(std::uint32_t part, std::uint32_t triangle, glm::vec3 (&out)[3]) const;

  private:
    struct Embree;
    std::vector<Part> parts_;
    std::unique_ptr<Embree> embree_;
};

using shading::offset_from_surface;

}  // namespace candela::truth
