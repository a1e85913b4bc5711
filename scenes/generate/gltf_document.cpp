#include "gltf_document.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "candela/io/image_write.hpp"
#include "candela/scene/scene.hpp"
#include "shading/color_temperature.glsl"

namespace candela::scenes {
namespace {

using nlohmann::json;

constexpr int float_component = 5126, uint_component = 5125;
constexpr int vertex_target = 34962, index_target = 34963;

template <typename T>
void append_value(std::vector<std::byte>& out, T value) {
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    out.insert(out.end(), bytes, bytes + sizeof value);
}

void append_chunk(std::vector<std::byte>& out, std::uint32_t type, const void* data, std::size_t size,
                  char padding) {
    const std::size_t padded = (size + 3) / 4 * 4;
    append_value(out, static_cast<std::uint32_t>(padded));
    append_value(out, type);
    const auto* bytes = static_cast<const std::byte*>(data);
    out.insert(out.end(), bytes, bytes + size);
    out.insert(out.end(), padded - size, static_cast<std::byte>(padding));
}

json to_json(const glm::quat& q) {
    return {q.x, q.y, q.z, q.w};
}

/// The rotation that makes -Z look from `from` at `at`.
glm::quat looking(const glm::vec3& from, const glm::vec3& at) {
    return glm::quat_cast(glm::mat3(scene::look_at(from, at, 1.0f).world));
}

}  // namespace

json to_json(const glm::vec3& v) {
    return {v.x, v.y, v.z};
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

GltfDocument::GltfDocument(const std::string& name) {
    document_["asset"] = {{"version", "2.0"}, {"generator", "candela-scenes"}};
    document_["scene"] = 0;
    document_["scenes"] = json::array({{{"name", name}, {"nodes", json::array()}}});
}

void GltfDocument::declare(const std::string& extension) {
    json& used = document_["extensionsUsed"];
    if (std::find(used.begin(), used.end(), extension) == used.end()) used.push_back(extension);
}

int GltfDocument::material(json material) {
    if (material.contains("extensions"))
        for (const auto& extension : material["extensions"].items()) declare(extension.key());
    document_["materials"].push_back(std::move(material));
    return static_cast<int>(document_["materials"].size()) - 1;
}

int GltfDocument::texture(const std::string& picture_file) {
    document_["samplers"] = json::array({json::object()});
    document_["images"].push_back({{"uri", picture_file}});
    document_["textures"].push_back({{"sampler", 0}, {"source", document_["images"].size() - 1}});
    return static_cast<int>(document_["textures"].size()) - 1;
}

int GltfDocument::add_accessor(const void* data, std::size_t bytes, int component_type, const char* type,
                               std::size_t count, int target) {
    const std::size_t offset = binary_.size();
    binary_.resize(offset + bytes);
    std::memcpy(binary_.data() + offset, data, bytes);
    document_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}, {"target", target}});
    document_["accessors"].push_back({{"bufferView", document_["bufferViews"].size() - 1},
                                      {"componentType", component_type},
                                      {"type", type},
                                      {"count", count}});
    return static_cast<int>(document_["accessors"].size()) - 1;
}

int GltfDocument::mesh(const std::string& name, const Shape& shape, int material) {
    const std::size_t count = shape.positions.size();
    json attributes;
    const auto attribute = [&](const char* semantic, const auto& values, const char* type) {
        if (values.empty()) return;
        attributes[semantic] = add_accessor(values.data(), count * sizeof values[0], float_component, type,
                                            count, vertex_target);
    };
    attribute("POSITION", shape.positions, "VEC3");
    glm::vec3 low = shape.positions.front(), high = low;
    for (const glm::vec3& p : shape.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    document_["accessors"].back()["min"] = to_json(low);
    document_["accessors"].back()["max"] = to_json(high);
    attribute("NORMAL", shape.normals, "VEC3");
    attribute("TEXCOORD_0", shape.uv, "VEC2");
    attribute("COLOR_0", shape.colors, "VEC4");
    const int indices = add_accessor(shape.indices.data(), shape.indices.size() * sizeof shape.indices[0],
                                     uint_component, "SCALAR", shape.indices.size(), index_target);
    document_["meshes"].push_back(
        {{"name", name},
         {"primitives",
          json::array({{{"attributes", attributes}, {"indices", indices}, {"material", material}}})}});
    mesh_triangles_.push_back(shape.triangles());
    return static_cast<int>(document_["meshes"].size()) - 1;
}

void GltfDocument::add_node(json node) {
    document_["nodes"].push_back(std::move(node));
    document_["scenes"][0]["nodes"].push_back(document_["nodes"].size() - 1);
}

void GltfDocument::node(const std::string& name, int mesh, const Placement& placement) {
    json node = {{"name", name}, {"mesh", mesh}, {"translation", to_json(placement.at_m)}};
    if (placement.rotation_rad != 0.0f)
        node["rotation"] = to_json(glm::angleAxis(placement.rotation_rad, placement.axis));
    triangles_ += mesh_triangles_[static_cast<std::size_t>(mesh)];
    add_node(std::move(node));
}

void GltfDocument::place(const std::string& name, const Shape& shape, int material,
                         const Placement& placement) {
    node(name, mesh(name, shape, material), placement);
}

void GltfDocument::light(const LightSource& source) {
    declare("KHR_lights_punctual");
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
    json& lights = document_["extensions"]["KHR_lights_punctual"]["lights"];
    lights.push_back(std::move(light));
    json node = {{"name", source.name},
                 {"translation", to_json(source.at_m)},
                 {"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}};
    if (source.type != "point") node["rotation"] = to_json(looking(source.at_m, source.towards_m));
    add_node(std::move(node));
}

void GltfDocument::camera(const std::string& name, const glm::vec3& from_m, const glm::vec3& at_m,
                          float focal_mm) {
    document_["cameras"].push_back(
        {{"name", name},
         {"type", "perspective"},
         {"perspective",
          {{"aspectRatio", 16.0 / 9.0}, {"yfov", scene::yfov_from_focal_mm(focal_mm)}, {"znear", 0.01}}}});
    add_node({{"name", name},
              {"camera", document_["cameras"].size() - 1},
              {"translation", to_json(from_m)},
              {"rotation", to_json(looking(from_m, at_m))}});
}

void GltfDocument::meter(const glm::vec3& at_m, const glm::vec3& normal, float illuminance_lx) {
    document_["asset"]["extras"]["meters"].push_back(
        {{"at", to_json(at_m)}, {"normal", to_json(normal)}, {"illuminance_lx", illuminance_lx}});
}

void GltfDocument::save(const std::filesystem::path& file) const {
    json document = document_;
    document["buffers"] = json::array({{{"byteLength", binary_.size()}}});
    const std::string text = document.dump();

    std::vector<std::byte> chunks;
    append_chunk(chunks, 0x4E4F534A, text.data(), text.size(), ' ');      // "JSON"
    append_chunk(chunks, 0x004E4942, binary_.data(), binary_.size(), 0);  // "BIN"
    std::vector<std::byte> out;
    append_value(out, std::uint32_t{0x46546C67});  // "glTF"
    append_value(out, std::uint32_t{2});
    append_value(out, static_cast<std::uint32_t>(12 + chunks.size()));
    out.insert(out.end(), chunks.begin(), chunks.end());
    io::write_file(file, out);
}

}  // namespace candela::scenes
