#pragma once

#include <string>
#include <string_view>

namespace candela::io {

/// RFC 3986, section 2.1; a percent sign that no two hexadecimal digits follow stands for itself.
[[nodiscard]] std::string percent_decoded(std::string_view uri);

}  // namespace candela::io
