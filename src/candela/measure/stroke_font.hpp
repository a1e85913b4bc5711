#pragma once

#include <glm/vec2.hpp>
#include <string_view>
#include <vector>

namespace candela::measure {

/// What a pen draws for a text: polylines; a line of one point is a dot. Units of the grid: capitals are 6
/// high, the baseline is y = 0, y down, the text starts at x = 0.
struct StrokedText {
    std::vector<std::vector<glm::dvec2>> lines;
    double width = 0.0;
};

constexpr double kStrokeCapHeight = 6.0;

/// ASCII and what lighting needs besides (degree sign, middle dot, gamma, dashes); other letters of Latin-1
/// lose their accents, and all else is a question mark.
[[nodiscard]] StrokedText stroked(std::string_view utf8);

}  // namespace candela::measure
