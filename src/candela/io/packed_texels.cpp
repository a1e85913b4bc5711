#include "candela/io/packed_texels.hpp"

#include <half.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "candela/scene/half_range.hpp"

namespace candela::io::detail {
namespace {

constexpr int kMantissaBits = 9;
constexpr int kExponentBias = 15;

float clean(float value, float largest) {
    return value > 0.0f ? std::min(value, largest) : 0.0f;
}

/// A positive half without its sign and its lowest bits is a float of fewer digits: the same exponent.
std::uint32_t to_small_float(float value, int mantissa_bits, float largest) {
    const int dropped = 10 - mantissa_bits;
    const std::uint32_t half = to_half(clean(value, largest));
    const std::uint32_t rounded = half + (1u << (dropped - 1)) - 1u + ((half >> dropped) & 1u);
    return rounded >> dropped;
}

float from_small_float(std::uint32_t bits, int mantissa_bits) {
    return from_half(static_cast<std::uint16_t>(bits << (10 - mantissa_bits)));
}

}  // namespace

std::uint16_t to_half(float value) noexcept {
    if (std::isnan(value)) return 0;
    return Imath::half(std::clamp(value, -scene::kLargestHalf, scene::kLargestHalf)).bits();
}

float from_half(std::uint16_t bits) noexcept {
    Imath::half value;
    value.setBits(bits);
    return value;
}

// Khronos Data Format Specification 1.3, "RGB Shared Exponent"; Vulkan 1.3, "RGB to Shared Exponent
// Conversion".
std::uint32_t to_rgb9e5(const glm::vec3& rgb) noexcept {
    const glm::vec3 c(clean(rgb.x, max_rgb9e5), clean(rgb.y, max_rgb9e5), clean(rgb.z, max_rgb9e5));
    const float largest = std::max(c.x, std::max(c.y, c.z));
    int exponent = 0;  // of the shared scale: largest < 2^(exponent - bias)
    if (largest > 0.0f) exponent = std::max(-kExponentBias - 1, std::ilogb(largest)) + 1 + kExponentBias;
    const auto digits = [&](float value) {
        return static_cast<std::uint32_t>(
            std::floor(std::ldexp(value, kExponentBias + kMantissaBits - exponent) + 0.5f));
    };
    if (digits(largest) == 1u << kMantissaBits) ++exponent;
    return digits(c.x) | digits(c.y) << 9 | digits(c.z) << 18 | static_cast<std::uint32_t>(exponent) << 27;
}

glm::vec3 from_rgb9e5(std::uint32_t bits) noexcept {
    const float scale = std::ldexp(1.0f, static_cast<int>(bits >> 27) - kExponentBias - kMantissaBits);
    return glm::vec3(bits & 0x1ffu, bits >> 9 & 0x1ffu, bits >> 18 & 0x1ffu) * scale;
}

std::uint32_t to_b10g11r11(const glm::vec3& rgb) noexcept {
    return to_small_float(rgb.x, 6, 65024.0f) | to_small_float(rgb.y, 6, 65024.0f) << 11 |
           to_small_float(rgb.z, 5, max_b10g11r11) << 22;
}

glm::vec3 from_b10g11r11(std::uint32_t bits) noexcept {
    return {from_small_float(bits & 0x7ffu, 6), from_small_float(bits >> 11 & 0x7ffu, 6),
            from_small_float(bits >> 22, 5)};
}

}  // namespace candela::io::detail
