#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "candela/io/placed_warnings.hpp"

namespace candela::io {

/// Parses JSON of at most `max_depth` nested levels; throws Error (Fault::input) with line and column at
/// `where`. A key that appears twice in one object is an error, or with `duplicate_keys` a warning: the later
/// one counts.
[[nodiscard]] nlohmann::json parse_json(std::span<const std::byte> bytes, const std::string& where,
                                        bool comments, int max_depth = 64,
                                        PlacedWarnings* duplicate_keys = nullptr);

/// Whether there are bytes that no text has: a line number would say nothing of a picture or a program.
[[nodiscard]] bool is_binary(std::span<const std::byte> bytes);

/// The known name that is nearest to a misspelt one, or the known names that go on where it ends ("power_lm"
/// for "power"), up to three joined by "or"; empty when none is near. Dashes before a name do not count.
[[nodiscard]] std::string nearest_name(const std::string& name, std::span<const std::string> known);

}  // namespace candela::io
