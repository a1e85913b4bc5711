#pragma once

#include <string>
#include <string_view>

namespace candela::io {

[[nodiscard]] bool is_utf8(std::string_view text);

/// The text as UTF-8: what is no UTF-8 in it is taken for Latin-1, letter by letter.
[[nodiscard]] std::string repaired_utf8(std::string_view text);

/// ISO 8859-1 as UTF-8.
[[nodiscard]] std::string from_latin1(std::string_view text);
/// The other way; empty when a letter has no place there.
[[nodiscard]] std::string to_latin1(std::string_view utf8);

}  // namespace candela::io
