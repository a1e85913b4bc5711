#include "candela/io/gltf_write.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "candela/io/gltf_write_parts.hpp"

namespace candela::io {
namespace {

using nlohmann::json;

json primitive_json(const scene::Primitive& p, GltfFile& file) {
    json attributes{{"POSITION", file.add_positions(p.positions)}};
    const auto attribute = [&](const char* semantic, const auto& values) {
        if (values.empty()) return;
        constexpr std::size_t columns = sizeof(values[0]) / sizeof(float);
        attributes[semantic] = file.add_vertices({&values[0].x, values.size() * columns}, columns);
    };
    attribute("NORMAL", p.normals);
    attribute("TANGENT", p.tangents);
    attribute("TEXCOORD_0", p.uv[0]);
    attribute("TEXCOORD_1", p.uv[1]);
    attribute("COLOR_0", p.colors);
    return {{"attributes", attributes}, {"indices", file.add_indices(p.indices)}, {"material", p.material}};
}

json stroke_json(const scene::Stroke& stroke, GltfFile& file) {
    json out = primitive_json(stroke.geometry, file);
    out["mode"] = stroke.kind == scene::StrokeKind::points ? 0 : 1;
    return out;
}

/// By index of the scene to index of the file: a mesh that nothing is left of is not written.
std::map<std::uint32_t, std::size_t> write_meshes(const scene::Scene& scene, GltfFile& file) {
    std::map<std::uint32_t, std::size_t> out;
    for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) {
        const scene::Mesh& mesh = scene.meshes[i];
        json primitives = json::array();
        for (const scene::Primitive& p : mesh.primitives) {
            if (!p.positions.empty() && !p.indices.empty()) primitives.push_back(primitive_json(p, file));
        }
        for (const scene::Stroke& stroke : mesh.strokes) primitives.push_back(stroke_json(stroke, file));
        if (primitives.empty()) continue;
        json entry{{"primitives", std::move(primitives)}};
        if (!mesh.name.empty()) entry["name"] = mesh.name;
        out.emplace(i, file.push("meshes", std::move(entry)));
    }
    return out;
}

/// A node's matrix has to come from translation, rotation and scale; several of them in a row can shear.
bool shears(const glm::mat4& m) {
    const glm::vec3 x(m[0]), y(m[1]), z(m[2]);
    const auto skew = [](const glm::vec3& a, const glm::vec3& b) {
        const float lengths = glm::length(a) * glm::length(b);
        return lengths > 0.0f && std::abs(glm::dot(a, b)) > 1e-4f * lengths;
    };
    return skew(x, y) || skew(y, z) || skew(x, z);
}

json camera_json(const scene::Camera& camera) {
    json out = json::object();
    if (!camera.name.empty()) out["name"] = camera.name;
    if (camera.projection == scene::Projection::perspective) {
        json p{{"yfov", camera.yfov_rad}, {"znear", camera.znear_m}};
        if (camera.aspect > 0.0f) p["aspectRatio"] = camera.aspect;
        if (std::isfinite(camera.zfar_m)) p["zfar"] = camera.zfar_m;
        out["type"] = "perspective";
        out["perspective"] = p;
    } else {
        out["type"] = "orthographic";
        out["orthographic"] = {{"xmag", camera.xmag_m},
                               {"ymag", camera.ymag_m},
                               {"znear", camera.znear_m},
                               {"zfar", camera.zfar_m}};
    }
    return out;
}

void write_instances(const scene::Scene& scene, GltfFile& file, Diagnostics& diagnostics) {
    const std::map<std::uint32_t, std::size_t> meshes = write_meshes(scene, file);
    for (const scene::Instance& instance : scene.instances) {
        json node = node_json(instance.name, scene.frame.to_world(instance.world));
        if (const auto mesh = meshes.find(instance.mesh); mesh != meshes.end()) node["mesh"] = mesh->second;
        if (shears(instance.world))
            diagnostics.warn("glTF cannot carry a transform that shears: written as a matrix all the same");
        file.add_root(std::move(node));
    }
}

/// What a stage may refer to by name: nodes that carry nothing else.
void write_other_nodes(const scene::Scene& scene, GltfFile& file) {
    std::set<std::string> there;
    if (file.document.contains("nodes")) {
        for (const json& node : file.document["nodes"]) there.insert(node.value("name", ""));
    }
    for (const scene::Node& node : scene.nodes) {
        if (there.insert(node.name).second)
            file.add_root(node_json(node.name, scene.frame.to_world(node.world)));
    }
}

}  // namespace

json node_json(const std::string& name, const glm::dmat4& world) {
    json node = json::object();
    if (!name.empty()) node["name"] = name;
    if (world != glm::dmat4(1.0)) node["matrix"] = to_json(world);
    return node;
}

void write_gltf(const std::filesystem::path& file, const scene::Scene& scene, Diagnostics& diagnostics) {
    GltfFile out("candela");
    GltfTextureWriter textures(scene, out);
    for (const scene::Material& m : scene.materials)
        out.push("materials", material_to_gltf(m, textures, out));
    write_instances(scene, out, diagnostics);
    for (const scene::Camera& camera : scene.cameras) {
        json node = node_json(camera.name, scene.frame.to_world(camera.world));
        node["camera"] = out.push("cameras", camera_json(camera));
        out.add_root(std::move(node));
    }
    write_lights(scene, out, diagnostics);
    write_other_nodes(scene, out);
    if (scene.environment) diagnostics.warn("glTF cannot carry an environment: " + scene.environment->name);
    out.save(file);
}

}  // namespace candela::io
