#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace candela::measure {

/// width * height linear or encoded RGB values, row 0 on top. What the numbers are (luminance in cd/m^2, or
/// display values in [0,1]) is said by the function that takes them.
struct Picture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::vec3> pixels;
};

/// One number a pixel, row 0 on top.
struct ErrorMap {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> values;
};

/// 1 where a pixel counts, 0 where it is left out. Empty: every pixel counts.
using Mask = std::vector<std::uint8_t>;

}  // namespace candela::measure
