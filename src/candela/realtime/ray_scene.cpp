#include "candela/realtime/ray_scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/packing.hpp>

#include "candela/realtime/box_tree.hpp"
#include "shading/octahedral.glsl"

namespace candela::realtime {
namespace {

/// Of a leaf; its count must fit the low bits of a node's last word.
constexpr std::uint32_t kLeafTriangles = 4;
constexpr std::uint32_t kLeafCountBits = 3;

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

Quad second_quad(const BoxTree::Node& node) {
    return quad(node.box.max, node.count == 0 ? 0u : node.first << kLeafCountBits | node.count);
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

RayScene build_ray_scene(const scene::Scene& scene, AlphaRecords& alphas) {
    const std::vector<WorldTriangle> triangles =
        world_triangles(scene, [](const scene::Material&) { return true; });
    std::vector<scene::Aabb> boxes(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (const glm::vec3& corner : triangles[i].corners) boxes[i].extend(corner);
    }
    const BoxTree tree = build_box_tree(boxes, kLeafTriangles);
    RayScene out;
    out.nodes.reserve(2 * tree.nodes.size());
    out.triangles.reserve(4 * tree.order.size());
    for (const BoxTree::Node& node : tree.nodes) {
        out.nodes.push_back(quad(node.box.min, node.skip));
        out.nodes.push_back(second_quad(node));
    }
    for (const std::uint32_t i : tree.order) {
        const WorldTriangle& t = triangles[i];
        out.triangles.push_back(quad(t.corners[0], alphas.record_of(t)));
        out.triangles.push_back(quad(t.corners[1], 0));
        out.triangles.push_back(quad(t.corners[2], 0));
        out.triangles.push_back({packed(t.normals[0]), packed(t.normals[1]), packed(t.normals[2]), 0});
    }
    return out;
}

}  // namespace candela::realtime
