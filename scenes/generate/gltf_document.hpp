#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "candela/io/gltf_file.hpp"
#include "shapes.hpp"

namespace candela::scenes {

/// Where a node stands: turned by `rotation_rad` about `axis` (unit), then moved.
struct Placement {
    glm::vec3 at_m{0.0f};
    glm::vec3 axis{0.0f, 1.0f, 0.0f};
    float rotation_rad = 0.0f;
};

struct LightSource {
    std::string name;
    std::string type = "point";  ///< point, spot, directional
    float intensity = 1.0f;      ///< cd, or lx at normal incidence for directional; as photometric luminance
    float kelvin = 6504.0f;      ///< colour: black body under 4000 K, daylight above
    glm::vec3 at_m{0.0f};
    glm::vec3 towards_m{0.0f, -1.0f, 0.0f};  ///< a place that a spot or directional light shines at from at_m
    float range_m = 0.0f;                    ///< 0: none
    float inner_cone_rad = 0.0f;
    float outer_cone_rad = 0.6f;
};

/// Collects a scene and writes it as one .glb.
class GltfDocument {
  public:
    explicit GltfDocument(const std::string& name);

    /// `material` is glTF's material object; extensions it uses are declared by themselves. Returns its
    /// index.
    int material(nlohmann::json material);

    /// A repeating texture whose picture lies beside the .glb.
    int texture(const std::string& picture_file);

    int mesh(const std::string& name, const Shape& shape, int material);
    void node(const std::string& name, int mesh, const Placement& placement = {});
    void place(const std::string& name, const Shape& shape, int material, const Placement& placement = {});
    void light(const LightSource& source);
    void camera(const std::string& name, const glm::vec3& from_m, const glm::vec3& at_m, float focal_mm);

    /// What a meter must read, kept in the asset's extras for checks.
    void meter(const glm::vec3& at_m, const glm::vec3& normal, float illuminance_lx);

    [[nodiscard]] std::size_t triangles() const noexcept { return triangles_; }

    /// Throws Error when the folder is missing or the disk is full.
    void save(const std::filesystem::path& file) const;

  private:
    io::GltfFile file_;
    std::vector<std::size_t> mesh_triangles_;
    std::size_t triangles_ = 0;
};

/// Colour of this temperature and luminance 1.
[[nodiscard]] glm::vec3 light_color(float kelvin);

[[nodiscard]] nlohmann::json to_json(const glm::vec3& v);

/// glTF's pbrMetallicRoughness of an opaque material.
[[nodiscard]] nlohmann::json simple_material(const std::string& name, const glm::vec3& base_color,
                                             float metallic, float roughness);

/// A surface that shines with `luminance_nit` in the colour of `kelvin`.
[[nodiscard]] nlohmann::json emissive_material(const std::string& name, float luminance_nit, float kelvin);

}  // namespace candela::scenes
