#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

namespace candela::io {

/// Parses JSON of at most `max_depth` nested levels; throws Error (Fault::input) with line and column at
/// `where`.
[[nodiscard]] nlohmann::json parse_json(std::span<const std::byte> bytes, const std::string& where,
                                        bool comments, int max_depth = 64);

/// The known name that is nearest to a misspelt one, or empty when none is near.
[[nodiscard]] std::string nearest_name(const std::string& name, std::span<const std::string> known);

}  // namespace candela::io
