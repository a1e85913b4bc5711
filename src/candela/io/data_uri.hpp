#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "candela/io/placed_warnings.hpp"

namespace candela::io {

/// The bytes of a URI "data:..." (RFC 2397), in base64 or percent-encoded. Line breaks, blanks and the
/// URL-safe alphabet of base64 are read with a warning. Throws Error (Fault::input) at `where` for what is
/// broken or cut off.
[[nodiscard]] std::vector<std::byte> decode_data_uri(std::string_view uri, const std::string& where,
                                                     PlacedWarnings& warnings);

}  // namespace candela::io
