#pragma once

#include <cstdint>

#include "image_files.hpp"

/// Encoders by the codecs' own libraries, for kinds of pictures that Candela reads and never writes.
namespace candela::tests {

struct PngKind {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    int bits = 8;
    int color_type = 0;  ///< PNG_COLOR_TYPE_*
    bool interlaced = false;
    std::vector<std::uint8_t> palette;       ///< RGB triples
    std::vector<std::uint8_t> transparency;  ///< palette alphas, or the grey value that is clear
};
/// `rows` as PNG stores them: packed, 16 bit big-endian.
[[nodiscard]] Bytes encode_png(const PngKind& kind, const std::vector<std::uint8_t>& rows);

/// components: 1 grey, 3 RGB, 4 CMYK with Adobe's marker (inverted) or without.
struct JpegKind {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    int components = 3;
    bool adobe = true;
    bool progressive = false;
};
[[nodiscard]] Bytes encode_jpeg(const JpegKind& kind, const std::vector<std::uint8_t>& texels);

[[nodiscard]] Bytes encode_webp(std::uint32_t width, std::uint32_t height,
                                const std::vector<std::uint8_t>& rgba);

}  // namespace candela::tests
