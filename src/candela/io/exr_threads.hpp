#pragma once

#include <cstdint>

namespace candela::io::detail {

/// How many threads OpenEXR should use for a picture of so many texels: none for small ones, because its
/// pool is started at first use and costs more than it gives.
[[nodiscard]] int exr_threads(std::uint64_t texels);

}  // namespace candela::io::detail
