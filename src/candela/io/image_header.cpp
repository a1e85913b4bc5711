#include <webp/decode.h>

#include <cstring>
#include <optional>
#include <string_view>

#include "candela/io/image_read.hpp"

namespace candela::io {
namespace {

using Bytes = std::span<const std::byte>;

struct Size {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

std::uint32_t big_endian(Bytes bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
        value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
    return value;
}

bool starts_with(Bytes bytes, std::string_view magic) {
    return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

/// The first start of a frame; segments before it state their length.
std::optional<Size> jpeg_size(Bytes bytes) {
    std::size_t at = 2;
    while (at + 9 <= bytes.size()) {
        const auto marker = big_endian(bytes, at, 2);
        if (marker == 0xffff) {
            ++at;
            continue;
        }
        const std::uint32_t kind = marker & 0xff;
        const bool frame =
            marker >= 0xffc0 && marker <= 0xffcf && kind != 0xc4 && kind != 0xc8 && kind != 0xcc;
        if (frame) return Size{big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2)};
        if (marker < 0xff01 || marker == 0xffda || marker == 0xffd9) return std::nullopt;
        at += 2 + std::size_t{big_endian(bytes, at + 2, 2)};
    }
    return std::nullopt;
}

std::optional<Size> size_of(Bytes bytes) {
    if (starts_with(bytes, "\x89PNG\r\n\x1a\n") && bytes.size() >= 24)
        return Size{big_endian(bytes, 16, 4), big_endian(bytes, 20, 4)};
    if (starts_with(bytes, "\xff\xd8\xff")) return jpeg_size(bytes);
    int width = 0, height = 0;
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    if (WebPGetInfo(data, bytes.size(), &width, &height) == 0) return std::nullopt;
    return Size{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

}  // namespace

std::uint64_t decoded_bytes(Bytes bytes) {
    const std::optional<Size> size = size_of(bytes);
    constexpr std::uint64_t largest_side = 16384;  // beyond it decode_image refuses with its own words
    if (!size || size->width > largest_side || size->height > largest_side) return 0;
    return std::uint64_t{size->width} * size->height * 4;
}

}  // namespace candela::io
