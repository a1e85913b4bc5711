#include "candela/io/gltf.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "candela/io/gltf_camera.hpp"
#include "candela/io/gltf_extensions.hpp"
#include "candela/io/gltf_instances.hpp"
#include "candela/io/gltf_lights.hpp"
#include "candela/io/gltf_material.hpp"
#include "candela/io/gltf_origin.hpp"
#include "candela/io/image_read.hpp"
#include "candela/io/tangents.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

/// What the header of a .glb can state.
constexpr std::size_t kMaxFileBytes = (std::size_t{1} << 32) - 1;
/// Instances of the same mesh cost little in the file and in memory; this bounds what they may cost in time.
constexpr std::uint64_t kMaxTriangles = std::uint64_t{1} << 30;

/// glTF's default material, once.
std::uint32_t default_material(scene::Scene& scene) {
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].name == "glTF default") return i;
    scene::Material m;
    m.name = "glTF default";
    scene.materials.push_back(m);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

/// Points and lines without normals show the sum of base colour and emission, unlit (glTF 2.0, 3.9.6 "Point
/// and line materials"); those with normals have no normal maps.
std::uint32_t stroke_material(std::uint32_t index, bool lit, scene::Scene& scene) {
    scene::Material m = scene.materials[index];
    // By index: materials need not have names, nor different ones.
    m.name += (lit ? " (lines of material " : " (unlit lines of material ") + std::to_string(index) + ")";
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].name == m.name) return i;
    m.normal_texture = {};
    m.clearcoat.normal_texture = {};
    m.anisotropy.strength = 0.0f;
    m.double_sided = true;
    if (!lit) {
        m.unlit = true;
        for (int c = 0; c < 3; ++c) m.base_color[c] = std::min(m.base_color[c] + m.emissive_nit[c], 1.0f);
        m.emissive_nit = glm::vec3(0.0f);
    }
    scene.materials.push_back(m);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

scene::Stroke finish_stroke(const SourcePrimitive& source, scene::Primitive p, scene::Scene& scene) {
    if (p.material == scene::no_index) p.material = default_material(scene);
    if (!source.had_normals) p.normals.clear();
    p.tangents.clear();
    p.material = stroke_material(p.material, source.had_normals, scene);
    p.bounds = {};
    p.bounds = {};
    for (const glm::vec3& x : p.positions) p.bounds.extend(x);
    return {*source.stroke, std::move(p)};
}

/// A posed primitive with everything that scene::Primitive promises.
scene::Primitive finish(const SourcePrimitive& source, scene::Primitive p, scene::Scene& scene) {
    if (p.material == scene::no_index) p.material = default_material(scene);
    if (!source.had_normals) add_flat_normals(p);
    const scene::Material& m = scene.materials[p.material];
    const bool wants_tangents =
        m.normal_texture || m.clearcoat.normal_texture || m.anisotropy.strength > 0.0f;
    const std::uint32_t set = m.normal_texture ? m.normal_texture.uv_set : m.clearcoat.normal_texture.uv_set;
    if (wants_tangents && p.tangents.empty() && !p.uv[set].empty()) add_tangents(p, set);
    p.bounds = {};
    for (const glm::vec3& x : p.positions) p.bounds.extend(x);
    return p;
}

bool finite(const glm::mat4& m) {
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            if (!std::isfinite(m[c][r])) return false;
        }
    }
    return true;
}

/// A mesh of the scene, and how its vertices were brought to a middling size.
struct Placed {
    std::uint32_t mesh = scene::no_index;
    MeshFrame frame;
};

/// What a node shows: where, and posed by which joints.
struct Shown {
    std::uint32_t mesh = 0;  // of the file
    std::vector<glm::dmat4> joints;
    std::vector<glm::dmat4> places;
};

struct Poser {
    const GltfDocument& document;
    const std::vector<Node>& nodes;
    scene::Scene& scene;
    Diagnostics& diagnostics;
    GltfMaterials materials{document, scene};
    AccessorCache accessors{document};
    std::map<std::uint32_t, SourceMesh> sources;
    std::map<std::uint32_t, Placed> rigid;  // by glTF mesh, for meshes that look alike everywhere
    std::uint64_t triangles = 0;
    std::map<std::uint32_t, std::vector<glm::dmat4>> skins;

    const std::vector<glm::dmat4>& joints_of(std::uint32_t skin) {
        const auto found = skins.find(skin);
        if (found != skins.end()) return found->second;
        return skins.emplace(skin, joint_matrices(document, skin, nodes)).first->second;
    }

    const SourceMesh& source_of(std::uint32_t mesh) {
        const auto found = sources.find(mesh);
        if (found != sources.end()) return found->second;
        return sources.emplace(mesh, read_mesh(document, accessors, materials, mesh, diagnostics))
            .first->second;
    }

    Placed add_mesh(const SourceMesh& source, const std::vector<float>& weights,
                    const std::vector<glm::dmat4>& joints, const JsonView& where) {
        std::vector<const SourcePrimitive*> from;
        std::vector<scene::Primitive> posed;
        scene::Aabb bounds;
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
            for (const glm::vec3& x : p.positions) bounds.extend(x);
            from.push_back(&primitive);
            posed.push_back(std::move(p));
        }
        Placed out{static_cast<std::uint32_t>(scene.meshes.size()), choose_mesh_frame(bounds)};
        scene::Mesh mesh;
        mesh.name = source.name;
        for (std::size_t i = 0; i < posed.size(); ++i) {
            apply(out.frame, posed[i]);
            if (from[i]->stroke) {
                mesh.strokes.push_back(finish_stroke(*from[i], std::move(posed[i]), scene));
            } else {
                mesh.primitives.push_back(finish(*from[i], std::move(posed[i]), scene));
            }
        }
        scene.meshes.push_back(std::move(mesh));
        return out;
    }

    static std::uint64_t bytes_of(const scene::Primitive& p) {
        constexpr std::uint64_t vertex_bytes = 84;  // every attribute that a vertex may end up with
        return p.positions.size() * vertex_bytes + p.indices.size() * sizeof(std::uint32_t);
    }

    static void check_joints(const SourcePrimitive& p, std::size_t joints, const JsonView& node) {
        for (const SourcePrimitive::Influences& set : p.influences) {
            for (std::size_t i = 0; i < set.joints.size(); ++i) {
                for (std::size_t c = 0; c < 4; ++c) {
                    if (set.joints[i][c] < joints || set.weights[i][static_cast<int>(c)] == 0.0f) continue;
                    node["skin"].repaired(
                        "its mesh refers to joints that the skin does not have: they move nothing");
                    return;
                }
            }
        }
    }

    /// nullopt for a node without a mesh.
    std::optional<Shown> shown_by(std::uint32_t node_index) {
        const Node& node = nodes[node_index];
        const JsonView json_node = document.element("nodes", node_index);
        const auto mesh = json_node["mesh"].index_below(document.count("meshes"));
        if (!mesh) return std::nullopt;
        const SourceMesh& source = source_of(*mesh);
        Shown out;
        out.mesh = *mesh;
        if (const auto skin = json_node["skin"].index_below(document.count("skins"))) {
            std::vector<glm::dmat4> joints;
            document.try_to_read(json_node["skin"], "drawn without the skin",
                                 [&] { joints = joints_of(*skin); });
            if (std::any_of(source.primitives.begin(), source.primitives.end(),
                            [](const SourcePrimitive& p) { return !p.influences.empty(); }))
                out.joints = joints;
        }
        const auto instances = read_gpu_instances(document, json_node, diagnostics);
        if (!out.joints.empty()) {
            // A skin places its vertices in the world by itself; the node's own transform is ignored
            // (glTF 2.0, 3.7.3.3).
            out.places = {glm::dmat4(1.0)};
            if (instances) diagnostics.warn("instances of a mesh with a skin: drawn once");
        } else if (instances) {
            for (const glm::dmat4& instance : *instances) out.places.push_back(node.placed * instance);
        } else {
            out.places = {node.placed};
        }
        return out;
    }

    /// In the world, of everything that the node shows.
    WorldBox bounds_of(const Shown& shown) {
        WorldBox box;
        const auto& through = shown.joints.empty() ? shown.places : shown.joints;
        for (const SourcePrimitive& p : source_of(shown.mesh).primitives) {
            for (const glm::dmat4& m : through) box.extend(transformed(p.primitive.bounds, m));
        }
        return box;
    }

    /// What each node shows, by its index; sets the scene's origin.
    std::map<std::uint32_t, Shown> place() {
        std::map<std::uint32_t, Shown> out;
        std::vector<WorldBox> boxes;
        std::optional<glm::dvec3> camera;
        for (std::uint32_t i = 0; i < nodes.size(); ++i) {
            if (!nodes[i].reachable || !finite(nodes[i].world)) continue;
            if (!camera && document.element("nodes", i)["camera"].exists())
                camera = glm::dvec3(nodes[i].placed[3]);
            if (auto shown = shown_by(i)) {
                boxes.push_back(bounds_of(*shown));
                out.emplace(i, std::move(*shown));
            }
        }
        scene.frame.origin_m = choose_origin(boxes, camera);
        return out;
    }

    void add_instances(std::uint32_t node_index, const Shown& shown) {
        const Node& node = nodes[node_index];
        const JsonView json_node = document.element("nodes", node_index);
        const SourceMesh& source = source_of(shown.mesh);
        const bool skinned = !shown.joints.empty();
        Placed placed;
        if (skinned || !node.weights.empty()) {
            std::vector<glm::dmat4> joints = shown.joints;
            for (glm::dmat4& joint : joints)
                joint = glm::translate(glm::dmat4(1.0), -scene.frame.origin_m) * joint;
            placed =
                add_mesh(source, node.weights.empty() ? source.weights : node.weights, joints, json_node);
        } else {
            const auto [entry, fresh] = rigid.try_emplace(shown.mesh);
            if (fresh) entry->second = add_mesh(source, source.weights, {}, json_node);
            placed = entry->second;
        }
        scene::Instance instance;
        instance.name = node.name;
        instance.mesh = placed.mesh;
        std::uint64_t of_mesh = 0;
        for (const scene::Primitive& p : scene.meshes[placed.mesh].primitives)
            of_mesh += p.indices.size() / 3;
        triangles += of_mesh * shown.places.size();
        if (triangles > kMaxTriangles) json_node.fail("the scene draws more than 2^30 triangles");
        for (const glm::dmat4& place : shown.places) {
            const glm::dmat4 to_world = place * placed.frame.matrix();
            instance.world = skinned ? glm::mat4(to_world) : scene.frame.to_own(to_world);
            scene.instances.push_back(instance);
        }
    }
};

scene::Scene build(const GltfDocument& document, const GltfOptions& options, Diagnostics& diagnostics) {
    check_extensions(document, diagnostics);
    scene::Scene scene;
    scene.name = document.name();
    if (options.time_s != 0.0f && document.count("animations") == 0)
        diagnostics.warn("the time has no effect: the scene has no animation");
    std::vector<Node> nodes = read_posed_nodes(document, options);
    GltfLights lights(document, options, diagnostics);
    Poser poser{document, nodes, scene, diagnostics};
    const std::map<std::uint32_t, Shown> shown = poser.place();
    for (Node& node : nodes) node.world = scene.frame.to_own(node.placed);
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        if (options.progress) options.progress("meshes", double(i) / double(nodes.size()));
        if (!nodes[i].reachable) continue;
        if (!finite(nodes[i].world)) {
            diagnostics.warn("a node whose transform is not finite: skipped");
            continue;
        }
        const JsonView node = document.element("nodes", i);
        if (!nodes[i].name.empty()) scene.nodes.push_back({nodes[i].name, nodes[i].world});
        if (const auto found = shown.find(i); found != shown.end()) poser.add_instances(i, found->second);
        if (const auto camera = node["camera"].index_below(document.count("cameras"))) {
            if (const auto read = read_camera(document.element("cameras", *camera), nodes[i]))
                scene.cameras.push_back(*read);
        }
        lights.add(node, nodes[i], scene);
    }
    read_images(document, options.progress, scene);
    document.warnings().raise(diagnostics);
    if (scene.instances.empty()) diagnostics.warn("the scene is empty: nothing to draw");
    return scene;
}

}  // namespace

scene::Scene load_gltf(const std::filesystem::path& file, const GltfOptions& options,
                       Diagnostics& diagnostics) {
    const scene::MemoryBudget memory = options.memory.value_or(scene::available_memory());
    std::error_code ignored;
    if (const std::uintmax_t size = std::filesystem::file_size(file, ignored); !ignored)
        memory.require(size, "the file takes", file.string());
    const std::vector<std::byte> bytes = read_file(file, kMaxFileBytes);
    const std::filesystem::path folder = file.parent_path().empty() ? "." : file.parent_path();
    return build(GltfDocument(bytes, file.string(), folder, memory), options, diagnostics);
}

scene::Scene load_gltf_from_memory(std::span<const std::byte> bytes, const std::string& name,
                                   const GltfOptions& options, Diagnostics& diagnostics) {
    return build(GltfDocument(bytes, name, std::nullopt, options.memory.value_or(scene::available_memory())),
                 options, diagnostics);
}

}  // namespace candela::io
