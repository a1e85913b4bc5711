#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

/// Light in 16 bits a channel or 32 a texel, as Vulkan, Direct3D, KTX and DDS store it.
namespace candela::io::detail {

/// Largest finite values.
inline constexpr float max_rgb9e5 = 65408.0f;
inline constexpr float max_b10g11r11 = 64512.0f;  ///< of its ten-bit blue; red and green reach 65024

/// Nearest half; beyond its range the largest finite. NaN becomes 0.
[[nodiscard]] std::uint16_t to_half(float value) noexcept;
[[nodiscard]] float from_half(std::uint16_t bits) noexcept;

/// VK_FORMAT_E5B9G9R9_UFLOAT_PACK32. Negative and NaN become 0, too large the largest.
[[nodiscard]] std::uint32_t to_rgb9e5(const glm::vec3& rgb) noexcept;
[[nodiscard]] glm::vec3 from_rgb9e5(std::uint32_t bits) noexcept;

/// VK_FORMAT_B10G11R11_UFLOAT_PACK32. Negative and NaN become 0, too large the largest.
[[nodiscard]] std::uint32_t to_b10g11r11(const glm::vec3& rgb) noexcept;
/// May be infinite or NaN, as the bits say.
[[nodiscard]] glm::vec3 from_b10g11r11(std::uint32_t bits) noexcept;

}  // namespace candela::io::detail
