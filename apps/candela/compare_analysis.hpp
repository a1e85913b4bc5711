#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "candela/measure/light_paths.hpp"
#include "compare_pictures.hpp"

namespace candela::app {

/// What the pictures' differences are made of, beside the metrics.
struct Analysis {
    std::optional<measure::Metrics> noise;               ///< of the reference alone
    std::vector<std::vector<measure::PathError>> paths;  ///< one list a picture; may be empty
    std::vector<std::string> verdicts;                   ///< one a picture; empty for the reference
};

/// `comparisons` are those of the pictures with the reference, in their order.
[[nodiscard]] Analysis analyse(const std::vector<NamedPicture>& pictures, std::size_t reference,
                               const measure::ComparisonOptions& options,
                               const std::vector<measure::Comparison>& comparisons);

[[nodiscard]] nlohmann::json paths_json(const std::vector<measure::PathError>& paths);

/// As it was typed, quoted for a shell where it has to be: from the kernel, because the parser keeps only
/// values.
[[nodiscard]] std::string command_line();

}  // namespace candela::app
