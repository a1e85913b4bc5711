#include "candela/truth/light_tree.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

namespace candela::truth {
namespace {

constexpr float kPi = 3.14159265f;

float sine(float cosine) {
    return std::sqrt(std::max(1.0f - cosine * cosine, 0.0f));
}

/// cos(max(a - b, 0)) for angles in [0, pi] given by their cosines and sines.
float cos_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}
float sin_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a > cos_b ? 0.0f : sin_a * cos_b - cos_a * sin_b;
}

glm::vec3 rotate(const glm::vec3& v, const glm::vec3& unit_axis, float angle_rad) {
    const float c = std::cos(angle_rad);
    const float s = std::sin(angle_rad);
    return v * c + glm::cross(unit_axis, v) * s + unit_axis * (glm::dot(unit_axis, v) * (1.0f - c));
}

/// Smallest cone about two cones: Conty Estevez & Kulla 2018, algorithm 1.
void unite_cones(const LightBounds& a, const LightBounds& b, LightBounds& out) {
    const LightBounds& wide = a.cos_normals <= b.cos_normals ? a : b;
    const LightBounds& thin = a.cos_normals <= b.cos_normals ? b : a;
    const float wide_rad = std::acos(std::clamp(wide.cos_normals, -1.0f, 1.0f));
    const float thin_rad = std::acos(std::clamp(thin.cos_normals, -1.0f, 1.0f));
    const float between_rad = std::acos(std::clamp(glm::dot(wide.axis, thin.axis), -1.0f, 1.0f));
    out.axis = wide.axis;
    out.cos_normals = wide.cos_normals;
    if (std::min(between_rad + thin_rad, kPi) <= wide_rad) return;
    const float united_rad = 0.5f * (wide_rad + between_rad + thin_rad);
    const glm::vec3 about = glm::cross(wide.axis, thin.axis);
    if (united_rad >= kPi || glm::dot(about, about) < 1e-12f) {
        out.cos_normals = -1.0f;
        return;
    }
    out.axis = glm::normalize(rotate(wide.axis, glm::normalize(about), united_rad - wide_rad));
    out.cos_normals = std::cos(united_rad);
}

LightBounds unite(const LightBounds& a, const LightBounds& b) {
    if (a.power <= 0.0f) return b;
    if (b.power <= 0.0f) return a;
    LightBounds out;
    out.box = a.box;
    out.box.extend(b.box);
    unite_cones(a, b, out);
    out.cos_emission = std::min(a.cos_emission, b.cos_emission);
    out.power = a.power + b.power;
    out.two_sided = a.two_sided || b.two_sided;
    out.reach = a.reach;
    out.reach.extend(b.reach);
    return out;
}

bool within(const scene::Aabb& box, const glm::vec3& p) {
    return p.x >= box.min.x && p.y >= box.min.y && p.z >= box.min.z && p.x <= box.max.x && p.y <= box.max.y &&
           p.z <= box.max.z;
}

/// Estimate of what a node gives at a point: power over squared distance, times the best cosine at the node
/// and at the receiver that its bounds allow. 0 only where nothing can arrive.
float importance(const LightBounds& b, const glm::vec3& point, const glm::vec3& normal) {
    if (!within(b.reach, point)) return 0.0f;
    const glm::vec3 center = 0.5f * (b.box.min + b.box.max);
    const glm::vec3 half = b.box.max - center;
    const glm::vec3 to_point = point - center;
    const float distance2 = glm::dot(to_point, to_point);
    const float radius2 = glm::dot(half, half);
    const float clamped2 = std::max(distance2, std::max(0.25f * radius2, 1e-10f));
    if (distance2 <= radius2) return b.power / clamped2;
    const glm::vec3 direction = to_point / std::sqrt(distance2);
    const float sin_box2 = radius2 / distance2;
    const float sin_box = std::sqrt(sin_box2);
    const float cos_box = std::sqrt(1.0f - sin_box2);

    float cos_axis = glm::dot(b.axis, direction);
    if (b.two_sided) cos_axis = std::abs(cos_axis);
    const float sin_axis = sine(cos_axis);
    const float sin_normals = sine(b.cos_normals);
    const float cos_x = cos_difference(sin_axis, cos_axis, sin_normals, b.cos_normals);
    const float sin_x = sin_difference(sin_axis, cos_axis, sin_normals, b.cos_normals);
    const float cos_at_light = cos_difference(sin_x, cos_x, sin_box, cos_box);
    if (cos_at_light <= b.cos_emission - 1e-4f) return 0.0f;

    const float cos_receiver = -glm::dot(direction, normal);
    const float best_receiver = cos_difference(sine(cos_receiver), cos_receiver, sin_box, cos_box);
    if (best_receiver <= 0.0f) return 0.0f;
    // The floor: a light seen edge-on must not become so rare that its weight explodes.
    return b.power * std::max(cos_at_light, 0.02f) * best_receiver / clamped2;
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
