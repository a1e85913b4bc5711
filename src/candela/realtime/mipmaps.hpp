#pragma once

#include <cstdint>
#include <vector>

#include "candela/scene/material.hpp"

namespace candela::realtime {

/// Box-filtered mip chain, level 0 first, each level tightly packed RGBA8. With `srgb`, RGB is averaged in
/// linear light (alpha always is linear).
[[nodiscard]] std::vector<std::vector<std::uint8_t>> mip_chain(const scene::Image& image, bool srgb);

}  // namespace candela::realtime
