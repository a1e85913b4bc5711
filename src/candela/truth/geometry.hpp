#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <memory>
#include <vector>

#include "candela/scene/scene.hpp"
#include "candela/scene/shared_primitives.hpp"
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

/// One primitive of one instance. Its vertices are transformed to the scene's space when they are asked for,
/// as realtime/shaders/mesh.vert.glsl does.
struct Part {
    const scene::Primitive* primitive = nullptr;
    std::uint32_t material = 0;
    std::uint32_t instance = 0;
    bool mirrored = false;  ///< winding is turned around
    glm::mat4 world{1.0f};
    glm::mat3 to_normal{1.0f};  ///< cofactors of `world`, with the sign that keeps normals outside

    [[nodiscard]] glm::vec3 position(std::uint32_t vertex) const {
        return glm::vec3(world * glm::vec4(primitive->positions[vertex], 1.0f));
    }
    [[nodiscard]] glm::vec3 normal(std::uint32_t vertex) const;   ///< unit length
    [[nodiscard]] glm::vec4 tangent(std::uint32_t vertex) const;  ///< as scene::Primitive::tangents
    [[nodiscard]] bool has_tangents() const noexcept { return !primitive->tangents.empty(); }
};

/// A scene's triangles in the scene's space, and rays through them (Embree). Instances are copied out, so
/// that a ray meets one tree and no transforms, but for primitives whose copies would be many triangles:
/// those share one tree. The scene must outlive this. Rays may be traced from several threads at once.
class Geometry {
  public:
    /// Throws Error (Fault::machine) when Embree fails or memory runs out.
    explicit Geometry(const scene::Scene& scene,
                      std::size_t max_copied_triangles = scene::kMaxCopiedTriangles);
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
