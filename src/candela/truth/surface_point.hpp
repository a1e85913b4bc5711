#pragma once

#include <array>

#include "candela/truth/geometry.hpp"
#include "candela/truth/textures.hpp"
#include "shading/bsdf.glsl"

namespace candela::truth {

/// A hit with its material evaluated: what realtime/shaders/material.glsl puts into the G-buffer, in full
/// precision. Normals are on the side of the ray's origin.
struct SurfacePoint {
    glm::vec3 position{0.0f};
    /// Where rays to lights start from: the smooth surface that the vertex normals speak of, never inside it.
    /// Keeps coarse meshes free of the facets' own shadows (Hanika 2021, "Hacking the Shadow Terminator").
    glm::vec3 smooth_position{0.0f};
    glm::vec3 geometric_normal{0.0f, 1.0f, 0.0f};
    glm::vec3 surface_normal{0.0f, 1.0f, 0.0f};  ///< interpolated from the vertices, without normal maps
    glm::vec3 normal{0.0f, 1.0f, 0.0f};
    glm::vec3 tangent{1.0f, 0.0f, 0.0f};
    glm::vec3 bitangent{0.0f, 0.0f, 1.0f};
    glm::vec3 coat_normal{0.0f, 1.0f, 0.0f};
    glm::vec3 emissive_nit{0.0f};
    glm::vec3 unlit_color{0.0f};  ///< display-referred, where `unlit`
    shading::Surface surface{};
    bool layered = false;  ///< has more lobes than metal and dielectric
    bool unlit = false;
    bool front = true;  ///< the ray came from the front of the triangle
};

/// Evaluates materials at hits. Scene and geometry must outlive it; may be used from several threads at once.
class SurfaceReader {
  public:
    /// fully_rough: the profile's.
    SurfaceReader(const scene::Scene& scene, const Geometry& geometry,
                  scene::FullyRoughRule fully_rough = scene::FullyRoughRule::none)
        : scene_(&scene), geometry_(&geometry), textures_(scene), fully_rough_(fully_rough) {}

    /// What of the light passes this hit unseen: 1 - alpha of blended surfaces, 0 or 1 of masked ones, 0 of
    /// others.
    [[nodiscard]] float transparency(const Hit& hit) const;
    /// Whether a camera ray goes through: back faces that the frame culls.
    [[nodiscard]] bool culled(const Ray& ray, const Hit& hit) const;
    [[nodiscard]] SurfacePoint read(const Ray& ray, const Hit& hit) const;
    /// Emission of a triangle's front at barycentric (u, v), cd/m^2.
    [[nodiscard]] glm::vec3 emissive_nit(std::uint32_t part, std::uint32_t triangle, float u, float v) const;
    [[nodiscard]] const scene::Material& material(std::uint32_t part) const {
        return scene_->materials[geometry_->parts()[part].material];
    }
    /// Any surface that rays may pass through.
    [[nodiscard]] bool any_transparency() const;

  private:
    struct Corners;
    [[nodiscard]] glm::vec4 base_color(const Corners& at, const scene::Material& m) const;
    void read_normals(const Corners& at, const std::array<glm::vec3, 3>& normals, const scene::Material& m,
                      float facing, SurfacePoint& out) const;
    void read_base(const Corners& at, const scene::Material& m, const glm::vec4& base,
                   shading::Surface& s) const;
    void read_layers(const Corners& at, const scene::Material& m, SurfacePoint& out) const;

    const scene::Scene* scene_;
    const Geometry* geometry_;
    Textures textures_;
    scene::FullyRoughRule fully_rough_;
};

}  // namespace candela::truth
