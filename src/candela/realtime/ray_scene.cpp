#include "candela/realtime/ray_scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/packing.hpp>
#include <map>

#include "candela/realtime/box_tree.hpp"
#include "shading/octahedral.glsl"

namespace candela::realtime {
namespace {

/// Of a leaf; its count must fit the low bits of a node's last word.
constexpr std::uint32_t kLeafTriangles = 4;
constexpr std::uint32_t kLeafCountBits = 3;
/// In place of a leaf's count: what it holds is one instance.
constexpr std::uint32_t kInstanceLeaf = 7;

glm::vec3 unit(const glm::vec3& v) {
    return v * (1.0f / std::sqrt(std::max(glm::dot(v, v), 1e-30f)));
}

std::uint32_t packed(const glm::vec3& normal) {
    return glm::packSnorm2x16(shading::octahedral_encode(normal));
}

void append_instance(const scene::Instance& instance, const scene::Primitive& p,
                     std::vector<WorldTriangle>& out) {
    const glm::mat3 linear(instance.world);
    const bool mirrored = glm::determinant(linear) < 0.0f;
    // As shaders/mesh.vert.glsl: normals by cofactors, which keep their sign when the matrix mirrors.
    const float sign = mirrored ? -1.0f : 1.0f;
    const glm::mat3 cofactors{sign * glm::cross(linear[1], linear[2]),
                              sign * glm::cross(linear[2], linear[0]),
                              sign * glm::cross(linear[0], linear[1])};
    for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
        WorldTriangle t;
        t.primitive = &p;
        t.index = {p.indices[i], p.indices[i + (mirrored ? 2 : 1)], p.indices[i + (mirrored ? 1 : 2)]};
        for (std::size_t c = 0; c < 3; ++c) {
            t.corners[c] = glm::vec3(instance.world * glm::vec4(p.positions[t.index[c]], 1.0f));
            t.normals[c] = unit(cofactors * p.normals[t.index[c]]);
        }
        out.push_back(t);
    }
}

}  // namespace

std::vector<WorldTriangle> world_triangles(const scene::Scene& scene,
                                           bool (*wanted)(const scene::Material&)) {
    std::vector<WorldTriangle> out;
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& p : scene.meshes[instance.mesh].primitives) {
            if (wanted(scene.materials[p.material])) append_instance(instance, p, out);
        }
    }
    return out;
}

std::array<glm::vec2, 3> corner_uv(const WorldTriangle& triangle, const scene::TextureRef& ref) {
    std::array<glm::vec2, 3> out{};
    const auto& set = triangle.primitive->uv[ref.uv_set < 2 ? ref.uv_set : 0];
    for (std::size_t c = 0; c < 3; ++c) {
        out[c] = transformed_uv(ref, set.empty() ? glm::vec2(0.0f) : set[triangle.index[c]]);
    }
    return out;
}

std::uint32_t AlphaRecords::record_of(const WorldTriangle& triangle) {
    const scene::Material& m = scene_->materials[triangle.primitive->material];
    if (m.alpha_mode == scene::AlphaMode::opaque) return kNoRecord;
    const auto record = static_cast<std::uint32_t>(quads_.size() / 3);
    const auto uv = corner_uv(triangle, m.base_color_texture);
    std::array<float, 3> alpha{};
    for (std::size_t c = 0; c < 3; ++c) {
        const auto& colors = triangle.primitive->colors;
        alpha[c] = m.base_color.a * (colors.empty() ? 1.0f : colors[triangle.index[c]].a);
    }
    const float cutoff = m.alpha_mode == scene::AlphaMode::mask ? m.alpha_cutoff : -1.0f;
    quads_.push_back(quad(uv[0], uv[1]));
    quads_.push_back(
        {word(uv[2].x), word(uv[2].y), textures_->record_of(m.base_color_texture), word(cutoff)});
    quads_.push_back({word(alpha[0]), word(alpha[1]), word(alpha[2]), 0});
    return record;
}

namespace {

/// Appends trees one after the other into the buffers of a RayScene.
class TreeWriter {
  public:
    TreeWriter(RayScene& out, AlphaRecords& alphas) : out_(&out), alphas_(&alphas) {}

    /// Returns the first and the end of the tree's nodes.
    std::pair<std::uint32_t, std::uint32_t> append(const std::vector<WorldTriangle>& triangles) {
        std::vector<scene::Aabb> boxes(triangles.size());
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            for (const glm::vec3& corner : triangles[i].corners) boxes[i].extend(corner);
        }
        const BoxTree tree = build_box_tree(boxes, kLeafTriangles);
        const auto first_triangle = static_cast<std::uint32_t>(out_->triangles.size() / 4);
        const auto range = append_nodes(tree, [&](const BoxTree::Node& node) {
            return (first_triangle + node.first) << kLeafCountBits | node.count;
        });
        for (const std::uint32_t i : tree.order) {
            const WorldTriangle& t = triangles[i];
            out_->triangles.push_back(quad(t.corners[0], alphas_->record_of(t)));
            out_->triangles.push_back(quad(t.corners[1], 0));
            out_->triangles.push_back(quad(t.corners[2], 0));
            out_->triangles.push_back({packed(t.normals[0]), packed(t.normals[1]), packed(t.normals[2]), 0});
        }
        return range;
    }

    /// One instance a leaf.
    void append_instances(const std::vector<scene::Aabb>& boxes) {
        const BoxTree tree = build_box_tree(boxes, 1);
        append_nodes(tree, [&](const BoxTree::Node& node) {
            return tree.order[node.first] << kLeafCountBits | kInstanceLeaf;
        });
    }

  private:
    template <class Leaf>
    std::pair<std::uint32_t, std::uint32_t> append_nodes(const BoxTree& tree, const Leaf& leaf) {
        const auto first = static_cast<std::uint32_t>(out_->nodes.size() / 2);
        for (const BoxTree::Node& node : tree.nodes) {
            out_->nodes.push_back(quad(node.box.min, first + node.skip));
            out_->nodes.push_back(quad(node.box.max, node.count == 0 ? 0u : leaf(node)));
        }
        return {first, static_cast<std::uint32_t>(out_->nodes.size() / 2)};
    }

    RayScene* out_;
    AlphaRecords* alphas_;
};

void append_rows(const glm::mat4& m, std::vector<Quad>& out) {
    for (int row = 0; row < 3; ++row)
        out.push_back({word(m[0][row]), word(m[1][row]), word(m[2][row]), word(m[3][row])});
}

}  // namespace

RayScene build_ray_scene(const scene::Scene& scene, AlphaRecords& alphas,
                         const std::set<const scene::Primitive*>& shared) {
    RayScene out;
    TreeWriter writer(out, alphas);
    struct Shown {
        const scene::Primitive* primitive;
        const scene::Instance* instance;
    };
    std::vector<WorldTriangle> copied;
    std::vector<Shown> shown;
    std::vector<scene::Aabb> boxes;
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& p : scene.meshes[instance.mesh].primitives) {
            if (!shared.contains(&p)) {
                append_instance(instance, p, copied);
                continue;
            }
            shown.push_back({&p, &instance});
            boxes.push_back(transformed(p.bounds, instance.world));
        }
    }
    writer.append(copied);
    copied = {};
    writer.append_instances(boxes);
    out.top_nodes = static_cast<std::uint32_t>(out.nodes.size() / 2);
    std::map<const scene::Primitive*, std::pair<std::uint32_t, std::uint32_t>> trees;
    for (const scene::Primitive* p : shared) {
        std::vector<WorldTriangle> own;
        append_instance({}, *p, own);
        trees[p] = writer.append(own);
    }
    for (const Shown& s : shown) {
        const glm::mat4& world = s.instance->world;
        append_rows(glm::mat4(glm::inverse(glm::dmat4(world))), out.instances);
        append_rows(world, out.instances);
        const auto [first, end] = trees[s.primitive];
        const bool mirrored = glm::determinant(glm::mat3(world)) < 0.0f;
        out.instances.push_back({first, end, word(mirrored ? -1.0f : 1.0f), 0});
    }
    return out;
}

}  // namespace candela::realtime
