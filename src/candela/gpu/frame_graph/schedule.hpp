#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace candela::gpu {

/// What a resource holds after `version` writes. Version 0 is what it held before the frame.
struct Contents {
    std::uint32_t resource = 0;
    std::uint32_t version = 0;
    bool operator==(const Contents&) const = default;
};

/// How a pass touches the contents of a resource. A write makes version + 1 of them; without `reads` of
/// nothing, else of what was there.
struct Access {
    Contents contents;
    bool reads = false;
    bool writes = false;
};

/// A pass as far as its order goes.
struct PassAccesses {
    std::string name;
    std::vector<Access> accesses;
};

/// A resource as far as the order of passes goes.
struct ResourceFacts {
    std::string name;
    bool held_before = false;  ///< version 0 is worth reading: it was made outside, or in the frame before
};

/// The passes that lead to the wanted contents, in an order in which contents are written before they are
/// read and read before they are written over; of passes that do not matter to each other the first declared
/// comes first. The others are left out. Throws std::logic_error, one line, when contents that a pass reads
/// are written by none, when two passes write over the same contents, and when passes wait for each other.
[[nodiscard]] std::vector<std::uint32_t> schedule(std::span<const PassAccesses> passes,
                                                  std::span<const ResourceFacts> resources,
                                                  std::span<const Contents> wanted);

}  // namespace candela::gpu
