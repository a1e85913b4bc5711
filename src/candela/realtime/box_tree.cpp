#include "candela/realtime/box_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

namespace candela::realtime {
namespace {

constexpr std::size_t kPlanes = 16;
/// Of looking into a box, where testing an item costs 1.
constexpr float kBoxCost = 0.6f;

float half_area(const scene::Aabb& box) {
    if (box.empty()) return 0.0f;
    const glm::vec3 d = box.max - box.min;
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

bool finite(const scene::Aabb& box) {
    for (int c = 0; c < 3; ++c) {
        if (!std::isfinite(box.min[c]) || !std::isfinite(box.max[c])) return false;
    }
    return !box.empty();
}

struct Item {
    scene::Aabb box;
    glm::vec3 center{0.0f};
    std::uint32_t index = 0;
};
using Items = std::span<Item>;

struct Bin {
    scene::Aabb box;
    std::size_t count = 0;
};

struct Split {
    int axis = -1;
    std::size_t plane = 0;
    float cost = 0.0f;
};

std::size_t bin_of(float center, float low, float scale) {
    return std::min(static_cast<std::size_t>(std::max((center - low) * scale, 0.0f)), kPlanes - 1);
}

/// Wald 2007 ("On fast Construction of SAH-based Bounding Volume Hierarchies"): items counted in bins by
/// their centres, the planes between bins tried.
void try_axis(Items items, const scene::Aabb& centers, int axis, Split& best) {
    const float extent = centers.max[axis] - centers.min[axis];
    if (!(extent > 0.0f)) return;
    const float scale = static_cast<float>(kPlanes) / extent;
    std::array<Bin, kPlanes> bins;
    for (const Item& item : items) {
        Bin& bin = bins[bin_of(item.center[axis], centers.min[axis], scale)];
        bin.box.extend(item.box);
        ++bin.count;
    }
    std::array<float, kPlanes> below{};
    Bin sum;
    for (std::size_t i = 0; i + 1 < kPlanes; ++i) {
        if (bins[i].count) sum.box.extend(bins[i].box);
        sum.count += bins[i].count;
        below[i] = half_area(sum.box) * static_cast<float>(sum.count);
    }
    sum = {};
    for (std::size_t i = kPlanes - 1; i > 0; --i) {
        if (bins[i].count) sum.box.extend(bins[i].box);
        sum.count += bins[i].count;
        if (sum.count == 0 || sum.count == items.size()) continue;
        const float cost = below[i - 1] + half_area(sum.box) * static_cast<float>(sum.count);
        if (best.axis < 0 || cost < best.cost) best = {axis, i, cost};
    }
}

class Builder {
  public:
    Builder(BoxTree& tree, std::uint32_t leaf_items) : tree_(&tree), leaf_items_(leaf_items) {}

    void build(Items items) {
        const std::size_t self = tree_->nodes.size();
        tree_->nodes.emplace_back();
        scene::Aabb box;
        scene::Aabb centers;
        for (const Item& item : items) {
            box.extend(item.box);
            centers.extend(item.center);
        }
        const std::size_t middle = split(items, box, centers);
        std::uint32_t first = static_cast<std::uint32_t>(tree_->order.size());
        std::uint32_t count = 0;
        if (middle == 0) {
            count = static_cast<std::uint32_t>(items.size());
            for (const Item& item : items) tree_->order.push_back(item.index);
        } else {
            build(items.first(middle));
            first = static_cast<std::uint32_t>(tree_->order.size());
            build(items.subspan(middle));
        }
        tree_->nodes[self] = {box, static_cast<std::uint32_t>(tree_->nodes.size()), first, count};
    }

  private:
    /// Sorts the items into those below and above the best plane; 0: a leaf is better.
    [[nodiscard]] std::size_t split(Items items, const scene::Aabb& box, const scene::Aabb& centers) const {
        if (items.size() == 1) return 0;
        Split best;
        for (int axis = 0; axis < 3; ++axis) try_axis(items, centers, axis, best);
        const bool fits = items.size() <= leaf_items_;
        const float leaf_cost = half_area(box) * (static_cast<float>(items.size()) - kBoxCost);
        if (fits && (best.axis < 0 || best.cost >= leaf_cost)) return 0;
        if (best.axis < 0) return items.size() / 2;
        const float low = centers.min[best.axis];
        const float scale = static_cast<float>(kPlanes) / (centers.max[best.axis] - low);
        const auto above = std::stable_partition(items.begin(), items.end(), [&](const Item& item) {
            return bin_of(item.center[best.axis], low, scale) < best.plane;
        });
        return static_cast<std::size_t>(above - items.begin());
    }

    BoxTree* tree_;
    std::size_t leaf_items_;
};

}  // namespace

BoxTree build_box_tree(std::span<const scene::Aabb> boxes, std::uint32_t leaf_items) {
    std::vector<Item> items;
    items.reserve(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (finite(boxes[i])) items.push_back({boxes[i], 0.5f * (boxes[i].min + boxes[i].max), i});
    }
    BoxTree tree;
    if (items.empty()) return tree;
    tree.nodes.reserve(2 * items.size());
    tree.order.reserve(items.size());
    Builder(tree, leaf_items).build(items);
    return tree;
}

}  // namespace candela::realtime
