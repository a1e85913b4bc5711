#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "candela/io/placed_warnings.hpp"

namespace candela::io {

struct GlbChunks {
    std::span<const std::byte> json;
    std::span<const std::byte> binary;
};

/// Whether the bytes begin as a .glb does.
[[nodiscard]] bool is_glb(std::span<const std::byte> bytes);

/// The chunks of a .glb. A length in the header that is not the file's, and chunks that are not padded to 4
/// bytes, are read as they are meant, with a warning. Throws Error (Fault::input) where data is cut off.
[[nodiscard]] GlbChunks split_glb(std::span<const std::byte> bytes, const std::string& name,
                                  PlacedWarnings& warnings);

}  // namespace candela::io
