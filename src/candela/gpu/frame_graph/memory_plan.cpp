#include "candela/gpu/frame_graph/memory_plan.hpp"

#include <algorithm>
#include <numeric>

namespace candela::gpu {

MemoryPlan plan_memory(std::span<const Lifetime> resources) {
    MemoryPlan plan;
    plan.offsets.resize(resources.size());
    plan.shares.resize(resources.size());
    std::vector<std::size_t> order(resources.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return resources[a].bytes > resources[b].bytes; });
    std::vector<std::size_t> placed;  // by offset
    for (const std::size_t i : order) {
        const Lifetime& r = resources[i];
        std::uint64_t offset = 0;
        for (const std::size_t j : placed) {
            const Lifetime& other = resources[j];
            const bool together = r.first <= other.last && other.first <= r.last;
            if (!together || plan.offsets[j] + other.bytes <= offset) continue;
            if (offset + r.bytes <= plan.offsets[j]) break;
            offset = (plan.offsets[j] + other.bytes + r.alignment - 1) & ~(r.alignment - 1);
        }
        plan.offsets[i] = offset;
        plan.bytes = std::max(plan.bytes, offset + r.bytes);
        for (const std::size_t j : placed) {
            if (offset < plan.offsets[j] + resources[j].bytes && plan.offsets[j] < offset + r.bytes)
                plan.shares[i] = plan.shares[j] = true;
        }
        placed.insert(std::upper_bound(placed.begin(), placed.end(), offset,
                                       [&](std::uint64_t o, std::size_t j) { return o < plan.offsets[j]; }),
                      i);
    }
    return plan;
}

}  // namespace candela::gpu
