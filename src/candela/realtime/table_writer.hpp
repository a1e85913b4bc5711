#pragma once

#include <bit>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace candela::realtime {

/// Four words, as the shaders read them at once.
struct Quad {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t z = 0;
    std::uint32_t w = 0;
};

[[nodiscard]] inline std::uint32_t word(float value) {
    return std::bit_cast<std::uint32_t>(value);
}
[[nodiscard]] inline Quad quad(const glm::vec3& v, std::uint32_t w) {
    return {word(v.x), word(v.y), word(v.z), w};
}
[[nodiscard]] inline Quad quad(const glm::vec2& a, const glm::vec2& b) {
    return {word(a.x), word(a.y), word(b.x), word(b.y)};
}

/// "None" where a record may name another.
inline constexpr std::uint32_t kNoRecord = 0xffffffffu;

}  // namespace candela::realtime
