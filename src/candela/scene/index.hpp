#pragma once

#include <cstdint>

namespace candela::scene {

/// Stands where an index into one of the scene's lists may be absent.
inline constexpr std::uint32_t no_index = 0xffffffffu;

}  // namespace candela::scene
