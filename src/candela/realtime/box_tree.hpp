#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::realtime {

/// A binary tree of boxes about items, in the order in which a ray without a stack visits it: after a box
/// that it misses it goes on at `skip`, else at the next node.
struct BoxTree {
    struct Node {
        scene::Aabb box;
        std::uint32_t skip = 0;   ///< the node after this one's subtree
        std::uint32_t first = 0;  ///< into `order`: a leaf's items, or the first item of the second child
        std::uint32_t count = 0;  ///< items of a leaf; 0: not a leaf
    };
    std::vector<Node> nodes;
    std::vector<std::uint32_t> order;  ///< indices of the items, leaf by leaf
};

/// Splits where the surface area heuristic is least among 16 planes an axis; leaves hold at most
/// `leaf_items`. Boxes that are empty or not finite are left out.
[[nodiscard]] BoxTree build_box_tree(std::span<const scene::Aabb> boxes, std::uint32_t leaf_items);

}  // namespace candela::realtime
