#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "candela/measure/picture.hpp"

/// How a report carries its pixels: planes of bytes in which neighbours are alike, row by row differences,
/// zlib, base64. report/decode.js reads it back.
namespace candela::measure::detail {

/// The power of two by which luminance is multiplied before it becomes half float: near `exposure`, so that
/// exposed values are of order 1, and small enough for the brightest finite value.
[[nodiscard]] float half_scale(const std::vector<const Picture*>& pictures, float exposure);

/// Six planes of width * height bytes: the high bytes of R, G, B, then the low ones. Infinities and NaN stay.
[[nodiscard]] std::string pack_halves(const Picture& picture, float scale);

/// One plane: 0 to 254 for [0,1], 255 for NaN.
[[nodiscard]] std::string pack_errors(const ErrorMap& map);

[[nodiscard]] std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace candela::measure::detail
