#include "gltf_document.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "candela/scene/scene.hpp"
#include "shading/color_temperature.glsl"

namespace candela::scenes {
namespace {

using nlohmann::json;

json to_json(const glm::quat& q) {
    return {q.x, q.y, q.z, q.w};
}

/// The rotation that makes -Z look from `from` at `at`.
glm::quat looking(const glm::vec3& from, const glm::vec3& at) {
    return glm::quat_cast(glm::mat3(scene::look_at(from, at, 1.0f).world));
}

}  // namespace

json to_json(const glm::vec3& v) {
    return io::to_json(v);
}

glm::vec3 light_color(float kelvin) {
    return shading::rec709_from_temperature(kelvin);
}

json simple_material(const std::string& name, const glm::vec3& base_color, float metallic, float roughness) {
    return {{"name", name},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {base_color.x, base_color.y, base_color.z, 1.0f}},
              {"metallicFactor", metallic},
              {"roughnessFactor", roughness}}}};
}

json emissive_material(const std::string& name, float luminance_nit, float kelvin) {
    const glm::vec3 color = light_color(kelvin);
    const float largest = std::max({color.x, color.y, color.z});  // factors must stay within 1
    json material = simple_material(name, glm::vec3(0.0f), 0.0f, 1.0f);
    material["emissiveFactor"] = to_json(color / largest);
    material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = luminance_nit * largest;
    return material;
}

GltfDocument::GltfDocument(const std::string& name) : file_("candela-scenes") {
    file_.document["scenes"][0] = {{"name", name}, {"nodes", json::array()}};
}

int GltfDocument::material(json material) {
    if (material.contains("extensions"))
        for (const auto& extension : material["extensions"].items()) file_.declare(extension.key());
    return static_cast<int>(file_.push("materials", std::move(material)));
}

int GltfDocument::texture(const std::string& picture_file) {
    file_.document["samplers"] = json::array({json::object()});
    const std::size_t image = file_.push("images", {{"uri", picture_file}});
    return static_cast<int>(file_.push("textures", {{"sampler", 0}, {"source", image}}));
}

int GltfDocument::mesh(const std::string& name, const Shape& shape, int material) {
    json attributes{{"POSITION", file_.add_positions(shape.positions)}};
    const auto attribute = [&](const char* semantic, const auto& values) {
        if (values.empty()) return;
        constexpr std::size_t columns = sizeof values[0] / sizeof(float);
        attributes[semantic] = file_.add_vertices({&values[0].x, values.size() * columns}, columns);
    };
    attribute("NORMAL", shape.normals);
    attribute("TEXCOORD_0", shape.uv);
    attribute("COLOR_0", shape.colors);
    const std::size_t indices = file_.add_indices(shape.indices);
    mesh_triangles_.push_back(shape.triangles());
    return static_cast<int>(file_.push(
        "meshes",
        {{"name", name},
         {"primitives",
          json::array({{{"attributes", attributes}, {"indices", indices}, {"material", material}}})}}));
}

void GltfDocument::node(const std::string& name, int mesh, const Placement& placement) {
    json node = {{"name", name}, {"mesh", mesh}, {"translation", to_json(placement.at_m)}};
    if (placement.rotation_rad != 0.0f)
        node["rotation"] = to_json(glm::angleAxis(placement.rotation_rad, placement.axis));
    triangles_ += mesh_triangles_[static_cast<std::size_t>(mesh)];
    file_.add_root(std::move(node));
}

void GltfDocument::place(const std::string& name, const Shape& shape, int material,
                         const Placement& placement) {
    node(name, mesh(name, shape, material), placement);
}

void GltfDocument::light(const LightSource& source) {
    file_.declare("KHR_lights_punctual");
    // glTF's colours stay within 1, so the largest channel moves into the intensity; their product is what
    // shines.
    const glm::vec3 color = light_color(source.kelvin);
    const float largest = std::max({color.x, color.y, color.z});
    json light = {{"name", source.name},
                  {"type", source.type},
                  {"color", to_json(color / largest)},
                  {"intensity", source.intensity * largest}};
    if (source.range_m > 0.0f) light["range"] = source.range_m;
    if (source.type == "spot")
        light["spot"] = {{"innerConeAngle", source.inner_cone_rad},
                         {"outerConeAngle", source.outer_cone_rad}};
    json& lights = file_.document["extensions"]["KHR_lights_punctual"]["lights"];
    lights.push_back(std::move(light));
    json node = {{"name", source.name},
                 {"translation", to_json(source.at_m)},
                 {"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}};
    if (source.type != "point") node["rotation"] = to_json(looking(source.at_m, source.towards_m));
    file_.add_root(std::move(node));
}

void GltfDocument::camera(const std::string& name, const glm::vec3& from_m, const glm::vec3& at_m,
                          float focal_mm) {
    const std::size_t camera = file_.push(
        "cameras",
        {{"name", name},
         {"type", "perspective"},
         {"perspective",
          {{"aspectRatio", 16.0 / 9.0}, {"yfov", scene::yfov_from_focal_mm(focal_mm)}, {"znear", 0.01}}}});
    file_.add_root({{"name", name},
                    {"camera", camera},
                    {"translation", to_json(from_m)},
                    {"rotation", to_json(looking(from_m, at_m))}});
}

void GltfDocument::meter(const glm::vec3& at_m, const glm::vec3& normal, float illuminance_lx) {
    file_.document["asset"]["extras"]["meters"].push_back(
        {{"at", to_json(at_m)}, {"normal", to_json(normal)}, {"illuminance_lx", illuminance_lx}});
}

void GltfDocument::save(const std::filesystem::path& file) const {
    file_.save(file);
}

}  // namespace candela::scenes
