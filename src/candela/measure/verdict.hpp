#pragma once

#include <optional>
#include <span>
#include <string>

#include "candela/measure/comparison.hpp"
#include "candela/measure/light_paths.hpp"

namespace candela::measure {

/// What a comparison comes to, for people.
struct VerdictInput {
    std::string picture;
    std::string reference;
    Metrics metrics;
    std::optional<Metrics> noise;            ///< of the reference alone
    std::optional<double> brightness_ratio;  ///< mean luminance over the reference's
    std::span<const PathError> paths;        ///< may be empty
};

/// One or two sentences: how close by FLIP (up to 1.2 times the reference's own noise "within its noise",
/// below 0.02 "very close", 0.05 "close", 0.1 "visibly different", else "clearly different": our words for
/// it), how much brighter or darker, and which light path most of the difference is in.
[[nodiscard]] std::string verdict(const VerdictInput& input);

}  // namespace candela::measure
