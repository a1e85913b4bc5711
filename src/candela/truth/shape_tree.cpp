#include "candela/truth/shape_tree.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>

namespace candela::truth {
namespace {

/// Flat boxes and rounding: a little more is searched than is there.
scene::Aabb padded(const scene::Aabb& box) {
    const glm::vec3 pad = 1e-6f * (glm::max(glm::abs(box.min), glm::abs(box.max))) + 1e-6f;
    return {box.min - pad, box.max + pad};
}

}  // namespace

ShapeTree::ShapeTree(std::vector<const scene::Light*> lights) : lights_(std::move(lights)) {
    if (lights_.empty()) return;
    std::vector<std::uint32_t> order(lights_.size());
    std::iota(order.begin(), order.end(), 0u);
    nodes_.reserve(2 * order.size());
    build(order, 0, order.size());
}

void ShapeTree::build(std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end) {
    const std::size_t self = nodes_.size();
    nodes_.emplace_back();
    scene::Aabb box;
    scene::Aabb centers;
    for (std::size_t i = begin; i < end; ++i) {
        box.extend(padded(shape_box(*lights_[order[i]])));
        centers.extend(lights_[order[i]]->position);
    }
    nodes_[self].box = box;
    if (end - begin == 1) {
        nodes_[self].light = order[begin];
        return;
    }
    const glm::vec3 extent = centers.max - centers.min;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto key = [&](std::uint32_t i) { return std::pair(lights_[i]->position[axis], i); };
    std::nth_element(order.begin() + static_cast<std::ptrdiff_t>(begin),
                     order.begin() + static_cast<std::ptrdiff_t>(middle),
                     order.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    build(order, begin, middle);
    nodes_[self].second_child = static_cast<std::uint32_t>(nodes_.size());
    build(order, middle, end);
}

bool ShapeTree::meets(const scene::Aabb& box, const Ray& ray, const glm::vec3& inverse) {
    float enter = 0.0f;
    float leave = std::numeric_limits<float>::infinity();
    for (int c = 0; c < 3; ++c) {
        const float a = (box.min[c] - ray.origin[c]) * inverse[c];
        const float b = (box.max[c] - ray.origin[c]) * inverse[c];
        // A ray along a side of the box gives a NaN, which these leave out.
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave * 1.00001f;
}

}  // namespace candela::truth
