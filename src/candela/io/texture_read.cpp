#include "candela/io/texture_read.hpp"

#include <bit>
#include <cstring>

#include "candela/io/packed_texels.hpp"

namespace candela::io::detail {
namespace {

std::uint32_t number(const std::byte* bytes, int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i) value |= std::to_integer<std::uint32_t>(bytes[i]) << 8 * i;
    return value;
}

float float_at(const std::byte* bytes) {
    return std::bit_cast<float>(number(bytes, 4));
}

float half_at(const std::byte* bytes) {
    return from_half(static_cast<std::uint16_t>(number(bytes, 2)));
}

glm::vec3 texel_at(const std::byte* bytes, LightFormat format) {
    switch (format) {
        case LightFormat::rgba16f:
            return {half_at(bytes), half_at(bytes + 2), half_at(bytes + 4)};
        case LightFormat::rgb9e5:
            return from_rgb9e5(number(bytes, 4));
        case LightFormat::b10g11r11:
            return from_b10g11r11(number(bytes, 4));
        default:
            return {float_at(bytes), float_at(bytes + 4), float_at(bytes + 8)};
    }
}

}  // namespace

std::uint32_t texel_bytes(LightFormat format) noexcept {
    switch (format) {
        case LightFormat::rgba16f:
            return 8;
        case LightFormat::rgba32f:
            return 16;
        case LightFormat::rgb32f:
            return 12;
        default:
            return 4;
    }
}

void append_texels(std::span<const std::byte> bytes, LightFormat format, std::vector<glm::vec3>& texels) {
    const std::size_t step = texel_bytes(format);
    for (std::size_t at = 0; at < bytes.size(); at += step) texels.push_back(texel_at(&bytes[at], format));
}

}  // namespace candela::io::detail
