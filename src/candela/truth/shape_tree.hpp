#pragma once

#include <array>
#include <vector>

#include "candela/truth/shape_light.hpp"

namespace candela::truth {

/// Finds the lights of a size that a ray passes through: a binary tree of boxes. Not Embree's, whose order of
/// visits may change with the number of threads that built it, and with it the last digit of a sum.
class ShapeTree {
  public:
    ShapeTree() = default;
    /// The lights must outlive this.
    explicit ShapeTree(std::vector<const scene::Light*> lights);

    [[nodiscard]] bool empty() const noexcept { return nodes_.empty(); }

    /// Calls visit(index of the light, distance in m) for each light that the ray enters from its bright
    /// side, in an order of its own. ray.t_max is not heeded.
    template <class Visit>
    void each_entry(const Ray& ray, const Visit& visit) const;

  private:
    struct Node {
        scene::Aabb box;
        std::uint32_t second_child = 0;  ///< the first one follows its parent; 0: a leaf
        std::uint32_t light = 0;
    };
    void build(std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end);
    [[nodiscard]] static bool meets(const scene::Aabb& box, const Ray& ray, const glm::vec3& inverse);

    std::vector<const scene::Light*> lights_;
    std::vector<Node> nodes_;
};

template <class Visit>
void ShapeTree::each_entry(const Ray& ray, const Visit& visit) const {
    if (nodes_.empty()) return;
    const glm::vec3 inverse = 1.0f / ray.direction;
    // Halves by count: no deeper than the bits of an index.
    std::array<std::uint32_t, 64> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const std::uint32_t at = stack[--size];
        const Node& node = nodes_[at];
        if (!meets(node.box, ray, inverse)) continue;
        if (node.second_child != 0) {
            stack[size++] = node.second_child;
            stack[size++] = at + 1;
            continue;
        }
        const float t = enter_shape(*lights_[node.light], ray);
        if (t > 0.0f) visit(node.light, t);
    }
}

}  // namespace candela::truth
