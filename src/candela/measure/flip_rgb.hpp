#pragma once

#include <cstdint>
#include <span>

namespace candela::measure {

/// Mean FLIP (flip.hpp) of two pictures in sRGB, 3 bytes a pixel, at 67 pixels a degree. For experiments,
/// whose panels are such bytes.
[[nodiscard]] double mean_flip_of_srgb(std::span<const std::uint8_t> x,
                                       std::span<const std::uint8_t> reference, std::uint32_t width,
                                       std::uint32_t height);

}  // namespace candela::measure
