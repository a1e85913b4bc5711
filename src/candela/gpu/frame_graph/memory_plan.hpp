#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace candela::gpu {

/// A resource that lives for a part of the frame.
struct Lifetime {
    std::uint64_t bytes = 0;
    std::uint64_t alignment = 1;  ///< a power of two
    std::uint32_t first = 0;      ///< place in the order of the first pass that uses it
    std::uint32_t last = 0;       ///< and of the last one
};

struct MemoryPlan {
    std::vector<std::uint64_t> offsets;  ///< one a resource
    std::uint64_t bytes = 0;             ///< of the block that holds them all
    std::vector<bool> shares;            ///< whether the resource's bytes are also another one's
};

/// Places for all in one block: what lives at the same time does not overlap. The largest ones first, each at
/// the lowest place that is free as long as it lives.
[[nodiscard]] MemoryPlan plan_memory(std::span<const Lifetime> resources);

}  // namespace candela::gpu
