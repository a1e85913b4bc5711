#pragma once

#include <string>
#include <string_view>

namespace candela {

/// Text of a file for a terminal: control characters and bytes that are no UTF-8 as '?', at most some 400
/// bytes.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace candela
