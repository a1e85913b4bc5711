#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "candela/scene/error.hpp"

namespace candela::io {

struct TextPosition {
    std::size_t line = 1;
    std::size_t column = 1;  ///< in characters of UTF-8
};

/// Of a byte.
[[nodiscard]] TextPosition position_of_byte(std::string_view text, std::size_t byte);

/// Where the value of a JSON pointer such as "/lights/0/power_lm" stands in valid JSON (comments allowed): at
/// its key, or at the value of an array's element. Nothing when there is none. Keys are compared as they are
/// written, without escapes.
[[nodiscard]] std::optional<TextPosition> position_in_json(std::string_view text, std::string_view pointer);

/// An error about `file`, whose place is "FILE: /POINTER" and maybe more, with "FILE:LINE:COLUMN: /POINTER"
/// in its place; any other error as it is.
[[nodiscard]] Error with_position(const Error& error, const std::string& file, std::string_view text);

}  // namespace candela::io
