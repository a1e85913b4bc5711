#include "candela/io/gltf.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "candela/io/gltf_lights.hpp"
#include "candela/io/gltf_material.hpp"
#include "candela/io/image_read.hpp"
#include "candela/io/tangents.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;
/// Instances of the same mesh cost little in the file; this bounds what they may cost in memory and time.
constexpr std::uint64_t kMaxTriangles = std::uint64_t{1} << 26;

const std::set<std::string>& supported_extensions() {
    static const std::set<std::string> names{"KHR_lights_punctual",
                                             "EXT_lights_ies",
                                             "EXT_lights_area",
                                             "KHR_texture_transform",
                                             "KHR_materials_emissive_strength",
                                             "KHR_materials_unlit",
                                             "KHR_materials_ior",
                                             "KHR_materials_specular",
                                             "KHR_materials_clearcoat",
                                             "KHR_materials_sheen",
                                             "KHR_materials_anisotropy",
                                             "KHR_materials_pbrSpecularGlossiness",
                                             "KHR_mesh_quantization",
                                             "EXT_meshopt_compression",
                                             "KHR_draco_mesh_compression",
                                             "EXT_texture_webp"};
    return names;
}

void check_extensions(const GltfDocument& document, Diagnostics& diagnostics) {
    const JsonView list = document.array("extensionsRequired");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string name = list[i].string_or("");
        if (!supported_extensions().contains(name))
            list[i].fail("the scene requires " + name + ", which is not supported");
    }
    constexpr std::size_t most_named = 16;
    std::set<std::string> unknown;
    const JsonView used = document.array("extensionsUsed");
    for (std::size_t i = 0; i < used.size(); ++i) {
        const std::string name = used[i].string_or("");
        if (supported_extensions().contains(name) || !unknown.insert(name).second) continue;
        if (unknown.size() <= most_named)
            diagnostics.warn("extension " + name + " is not supported: ignored");
    }
    if (unknown.size() > most_named)
        diagnostics.warn(std::to_string(unknown.size() - most_named) + " more extensions are not supported");
}

/// A posed primitive with everything that scene::Primitive promises.
scene::Primitive finish(const SourcePrimitive& source, scene::Primitive p, scene::Scene& scene) {
    if (p.material == scene::no_index) {
        // glTF's default material, once, at the end of the list.
        if (scene.materials.empty() || scene.materials.back().name != "glTF default") {
            scene::Material m;
            m.name = "glTF default";
            scene.materials.push_back(m);
        }
        p.material = static_cast<std::uint32_t>(scene.materials.size() - 1);
    }
    if (!source.had_normals) add_flat_normals(p);
    const scene::Material& m = scene.materials[p.material];
    const bool wants_tangents =
        m.normal_texture || m.clearcoat.normal_texture || m.anisotropy.strength > 0.0f;
    const std::uint32_t set = m.normal_texture ? m.normal_texture.uv_set : m.clearcoat.normal_texture.uv_set;
    if (wants_tangents && p.tangents.empty() && !p.uv[set].empty()) add_tangents(p, set);
    for (const glm::vec3& x : p.positions) p.bounds.extend(x);
    return p;
}

struct Poser {
    const GltfDocument& document;
    const std::vector<Node>& nodes;
    scene::Scene& scene;
    Diagnostics& diagnostics;
    std::map<std::uint32_t, SourceMesh> sources;
    std::map<std::uint32_t, std::uint32_t>
        rigid;  // glTF mesh to Scene::meshes, for meshes that look alike everywhere
    std::uint64_t triangles = 0;
    std::map<std::uint32_t, std::vector<glm::mat4>> skins;

    const std::vector<glm::mat4>& joints_of(std::uint32_t skin) {
        const auto found = skins.find(skin);
        if (found != skins.end()) return found->second;
        return skins.emplace(skin, joint_matrices(document, skin, nodes)).first->second;
    }

    const SourceMesh& source_of(std::uint32_t mesh) {
        const auto found = sources.find(mesh);
        if (found != sources.end()) return found->second;
        return sources.emplace(mesh, read_mesh(document, mesh, diagnostics)).first->second;
    }

    std::uint32_t add_mesh(const SourceMesh& source, const std::vector<float>& weights,
                           const std::vector<glm::mat4>& joints, const JsonView& where) {
        scene::Mesh mesh;
        mesh.name = source.name;
        for (const SourcePrimitive& primitive : source.primitives) {
            if (!joints.empty()) check_joints(primitive, joints.size(), where);
            document.charge(bytes_of(primitive.primitive), where);
            scene::Primitive p = pose(primitive, weights, joints);
            const bool finite = std::all_of(p.positions.begin(), p.positions.end(), [](const glm::vec3& x) {
                return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
            });
            if (!finite) {
                diagnostics.warn("a primitive whose pose is not finite: skipped");
                continue;
            }
            mesh.primitives.push_back(finish(primitive, std::move(p), scene));
        }
        scene.meshes.push_back(std::move(mesh));
        return static_cast<std::uint32_t>(scene.meshes.size() - 1);
    }

    static std::uint64_t bytes_of(const scene::Primitive& p) {
        constexpr std::uint64_t vertex_bytes = 84;  // every attribute that a vertex may end up with
        return p.positions.size() * vertex_bytes + p.indices.size() * sizeof(std::uint32_t);
    }

    static void check_joints(const SourcePrimitive& p, std::size_t joints, const JsonView& node) {
        for (std::size_t i = 0; i < p.joints.size(); ++i) {
            for (std::size_t c = 0; c < 4; ++c) {
                if (p.joints[i][c] < joints || p.weights[i][static_cast<int>(c)] == 0.0f) continue;
                node["skin"].fail("has " + std::to_string(joints) + " joints, its mesh refers to joint " +
                                  std::to_string(p.joints[i][c]));
            }
        }
    }

    void add_instance(std::uint32_t node_index) {
        const Node& node = nodes[node_index];
        const JsonView json_node = document.element("nodes", node_index);
        const auto mesh = json_node["mesh"].index_below(document.count("meshes"));
        if (!mesh) return;
        const SourceMesh& source = source_of(*mesh);
        std::vector<glm::mat4> joints;
        if (const auto skin = json_node["skin"].index_below(document.count("skins"))) {
            joints = joints_of(*skin);
        }
        const bool skinned =
            !joints.empty() && std::any_of(source.primitives.begin(), source.primitives.end(),
                                           [](const SourcePrimitive& p) { return !p.joints.empty(); });
        scene::Instance instance;
        instance.name = node.name;
        // A skin places its vertices in the world by itself; the node's own transform is ignored
        // (glTF 2.0, 3.7.3.3).
        if (!skinned) instance.world = node.world;
        if (skinned || !node.weights.empty()) {
            instance.mesh = add_mesh(source, node.weights.empty() ? source.weights : node.weights,
                                     skinned ? joints : std::vector<glm::mat4>{}, json_node);
        } else {
            const auto [entry, fresh] = rigid.try_emplace(*mesh, 0u);
            if (fresh) entry->second = add_mesh(source, source.weights, {}, json_node);
            instance.mesh = entry->second;
        }
        for (const scene::Primitive& p : scene.meshes[instance.mesh].primitives)
            triangles += p.indices.size() / 3;
        if (triangles > kMaxTriangles) json_node.fail("the scene has more than 67 million triangles");
        scene.instances.push_back(instance);
    }
};

bool finite(const glm::mat4& m) {
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            if (!std::isfinite(m[c][r])) return false;
        }
    }
    return true;
}

void add_camera(const JsonView& source, const Node& node, scene::Scene& scene) {
    scene::Camera camera;
    const std::string own_name = source["name"].string_or("");
    camera.name = node.name.empty() ? own_name : node.name;
    camera.world = scene::rigid_part(node.world);
    const std::string type = source["type"].string_or("");
    const auto positive = [](const JsonView& value, float fallback) {
        const float x = value.float_or(fallback);
        if (!(x > 0.0f)) value.fail("must be greater than 0");
        return x;
    };
    if (type == "perspective") {
        const JsonView p = source["perspective"];
        camera.yfov_rad = positive(p["yfov"], 0.7f);
        if (camera.yfov_rad >= 3.1f) p["yfov"].fail("must be less than pi");
        camera.aspect = p["aspectRatio"].exists() ? positive(p["aspectRatio"], 1.0f) : 0.0f;
        camera.znear_m = positive(p["znear"], 0.01f);
        if (p["zfar"].exists()) camera.zfar_m = positive(p["zfar"], 1.0f);
        if (camera.zfar_m <= camera.znear_m) p["zfar"].fail("must be greater than znear");
    } else if (type == "orthographic") {
        const JsonView o = source["orthographic"];
        camera.projection = scene::Projection::orthographic;
        camera.ymag_m = positive(o["ymag"], 1.0f);
        camera.xmag_m = positive(o["xmag"], 1.0f);
        camera.znear_m = std::max(o["znear"].float_or(0.0f), 0.0f);
        camera.zfar_m = positive(o["zfar"], 100.0f);
        if (camera.zfar_m <= camera.znear_m) o["zfar"].fail("must be greater than znear");
    } else {
        source["type"].fail("must be perspective or orthographic");
    }
    scene.cameras.push_back(camera);
}

scene::Scene build(const GltfDocument& document, const GltfOptions& options, Diagnostics& diagnostics) {
    check_extensions(document, diagnostics);
    scene::Scene scene;
    scene.name = document.name();
    read_textures(document, scene);
    for (std::uint32_t i = 0; i < document.count("materials"); ++i) {
        scene.materials.push_back(read_material(document, i, diagnostics));
    }
    if (options.time_s != 0.0f && document.count("animations") == 0)
        diagnostics.warn("the time has no effect: the scene has no animation");
    const std::vector<Node> nodes = read_posed_nodes(document, options.time_s, diagnostics);
    GltfLights lights(document, options, diagnostics);
    Poser poser{document, nodes, scene, diagnostics, {}, {}, 0, {}};
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        if (options.progress) options.progress("meshes", double(i) / double(nodes.size()));
        if (!nodes[i].reachable) continue;
        if (!finite(nodes[i].world)) {
            diagnostics.warn("a node whose transform is not finite: skipped");
            continue;
        }
        const JsonView node = document.element("nodes", i);
        if (!nodes[i].name.empty()) scene.nodes.push_back({nodes[i].name, nodes[i].world});
        poser.add_instance(i);
        if (const auto camera = node["camera"].index_below(document.count("cameras"))) {
            add_camera(document.element("cameras", *camera), nodes[i], scene);
        }
        lights.add(node, nodes[i], scene);
    }
    read_images(document, options.progress, scene);
    if (scene.instances.empty()) diagnostics.warn("the scene is empty: nothing to draw");
    return scene;
}

}  // namespace

scene::Scene load_gltf(const std::filesystem::path& file, const GltfOptions& options,
                       Diagnostics& diagnostics) {
    const std::vector<std::byte> bytes = read_file(file, kMaxFileBytes);
    const std::filesystem::path folder = file.parent_path().empty() ? "." : file.parent_path();
    return build(GltfDocument(bytes, file.string(), folder), options, diagnostics);
}

scene::Scene load_gltf_from_memory(std::span<const std::byte> bytes, const std::string& name,
                                   const GltfOptions& options, Diagnostics& diagnostics) {
    return build(GltfDocument(bytes, name, std::nullopt), options, diagnostics);
}

}  // namespace candela::io
