#include "candela/truth/light_tree.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "shading/lights/emission_cone.glsl"

namespace candela::truth {
namespace {

shading::EmissionCone cone_of(const LightBounds& b) {
    return {b.axis, b.cos_normals, b.cos_emission, b.two_sided};
}

LightBounds unite(const LightBounds& a, const LightBounds& b) {
    if (a.power <= 0.0f) return b;
    if (b.power <= 0.0f) return a;
    LightBounds out;
    out.box = a.box;
    out.box.extend(b.box);
    const shading::EmissionCone cone = shading::unite_cones(cone_of(a), cone_of(b));
    out.axis = cone.axis;
    out.cos_normals = cone.cos_normals;
    out.cos_emission = cone.cos_emission;
    out.two_sided = cone.two_sided;
    out.power = a.power + b.power;
    out.reach = a.reach;
    out.reach.extend(b.reach);
    return out;
}

bool within(const scene::Aabb& box, const glm::vec3& p) {
    return p.x >= box.min.x && p.y >= box.min.y && p.z >= box.min.z && p.x <= box.max.x && p.y <= box.max.y &&
           p.z <= box.max.z;
}

/// 0 only where nothing can arrive: outside of what the lights' ranges reach, too.
float importance(const LightBounds& b, const glm::vec3& point, const glm::vec3& normal) {
    if (!within(b.reach, point)) return 0.0f;
    const glm::vec3 center = 0.5f * (b.box.min + b.box.max);
    return shading::emission_importance(cone_of(b), b.power, std::numeric_limits<float>::infinity(),
                                        b.box.max - center, point - center, normal);
}

}  // namespace

LightTree::LightTree(const std::vector<LightBounds>& lights) : leaf_of_(lights.size(), 0) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        if (lights[i].power > 0.0f && !lights[i].box.empty()) order.push_back(i);
    }
    if (order.empty()) return;
    nodes_.reserve(2 * order.size());
    build(order, 0, order.size(), 0, lights);
}

std::uint32_t LightTree::build(std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end,
                               std::uint32_t parent, const std::vector<LightBounds>& lights) {
    const auto self = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    nodes_[self].parent = parent;
    if (end - begin == 1) {
        nodes_[self].bounds = lights[order[begin]];
        nodes_[self].light = order[begin];
        leaf_of_[order[begin]] = self;
        return self;
    }
    scene::Aabb centers;
    for (std::size_t i = begin; i < end; ++i) {
        centers.extend(0.5f * (lights[order[i]].box.min + lights[order[i]].box.max));
    }
    const glm::vec3 extent = centers.max - centers.min;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto key = [&](std::uint32_t i) { return lights[i].box.min[axis] + lights[i].box.max[axis]; };
    // Ties go by index, so that the tree is the same everywhere.
    std::nth_element(
        order.begin() + static_cast<std::ptrdiff_t>(begin),
        order.begin() + static_cast<std::ptrdiff_t>(middle), order.begin() + static_cast<std::ptrdiff_t>(end),
        [&](std::uint32_t a, std::uint32_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
    const std::uint32_t first = build(order, begin, middle, self, lights);
    const std::uint32_t second = build(order, middle, end, self, lights);
    nodes_[self].second_child = second;
    nodes_[self].bounds = unite(nodes_[first].bounds, nodes_[second].bounds);
    return self;
}

LightTree::Choice LightTree::sample(const glm::vec3& point, const glm::vec3& normal, float& u) const {
    if (nodes_.empty()) return {};
    std::uint32_t at = 0;
    float probability = 1.0f;
    if (nodes_.size() == 1 && importance(nodes_[0].bounds, point, normal) <= 0.0f) return {};
    while (nodes_[at].second_child != 0) {
        const float a = importance(nodes_[at + 1].bounds, point, normal);
        const float b = importance(nodes_[nodes_[at].second_child].bounds, point, normal);
        if (a + b <= 0.0f) return {};
        const float first = a / (a + b);
        if (u < first) {
            u = std::min(u / first, 0.99999994f);
            probability *= first;
            at = at + 1;
        } else {
            u = std::clamp((u - first) / (1.0f - first), 0.0f, 0.99999994f);
            probability *= 1.0f - first;
            at = nodes_[at].second_child;
        }
    }
    return {nodes_[at].light, probability};
}

float LightTree::probability(const glm::vec3& point, const glm::vec3& normal, std::uint32_t light) const {
    if (nodes_.empty()) return 0.0f;
    std::uint32_t at = leaf_of_[light];
    if (nodes_[at].light != light || nodes_[at].second_child != 0) return 0.0f;
    if (nodes_.size() == 1) return importance(nodes_[0].bounds, point, normal) > 0.0f ? 1.0f : 0.0f;
    float probability = 1.0f;
    while (at != 0) {
        const std::uint32_t up = nodes_[at].parent;
        const std::uint32_t first = up + 1;
        const float a = importance(nodes_[first].bounds, point, normal);
        const float b = importance(nodes_[nodes_[up].second_child].bounds, point, normal);
        if (a + b <= 0.0f) return 0.0f;
        const float share = a / (a + b);
        probability *= at == first ? share : 1.0f - share;
        at = up;
    }
    return probability;
}

}  // namespace candela::truth
