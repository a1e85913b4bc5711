#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "candela/scene/scene.hpp"

/// The codecs behind decode_image, one per file. Each checks the header (image_read_limits.hpp) before it
/// takes memory and throws Error (Fault::input) for truncated or corrupt data.
namespace candela::io::detail {

/// Deflate holds at most 1032 bytes in one, so more raw rows than that are refused.
[[nodiscard]] scene::Image decode_png(std::span<const std::byte> bytes, const std::string& where);

/// A PNG picture of 16 bits a channel as stored, RGB; nothing for one of other depths and for other files.
struct Png16 {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint16_t> rgb;
};
[[nodiscard]] std::optional<Png16> decode_png_16(std::span<const std::byte> bytes, const std::string& where);

/// A Huffman-coded block of 64 texels takes at least one bit, so more than 512 texels a byte are refused, as
/// are arithmetic coding, more than 256 scans and more than 512 MiB of coefficients (progressive files).
[[nodiscard]] scene::Image decode_jpeg(std::span<const std::byte> bytes, const std::string& where);

/// Lossless WebP holds a flat picture of any size in some 30 bytes, so there is no honest ratio: more than
/// 2^24 texels must come with a byte for every 2^14.
[[nodiscard]] scene::Image decode_webp(std::span<const std::byte> bytes, const std::string& where);

}  // namespace candela::io::detail
