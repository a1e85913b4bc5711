#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "candela/measure/comparison.hpp"
#include "candela/measure/light_paths.hpp"

/// One self-contained page (no network, works from file://) in which a person looks at pictures beside each
/// other. docs/compare.md says how to read it.
namespace candela::measure {

struct ReportPicture {
    std::string name;
    Picture picture;
    std::vector<std::pair<std::string, std::string>> settings;  ///< key and value, in the order shown
    Comparison comparison;         ///< against the reference; ignored for the reference itself
    std::string verdict;           ///< a sentence; may be empty
    std::vector<PathError> paths;  ///< the difference by light path; may be empty
};

struct Report {
    std::string title;
    std::vector<ReportPicture> pictures;  ///< all of one size, at least two
    std::size_t reference = 0;            ///< index into pictures
    ComparisonOptions options;            ///< with which the comparisons were made
    float ev100 = 0.0f;                   ///< of options.exposure
    std::string version;                  ///< of the program
    std::string command;                  ///< that made it; may be empty
    std::optional<Metrics> noise;         ///< of the reference alone
};

/// The page. Pixels are half floats (luminance scaled by a power of two that keeps the brightest finite value
/// in range), losslessly compressed. Throws std::invalid_argument when the sizes differ or fewer than two
/// pictures are given.
[[nodiscard]] std::string report_html(const Report& report);

}  // namespace candela::measure
