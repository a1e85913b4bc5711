#pragma once

#include <string>

#include "candela/measure/experiment.hpp"

namespace candela::measure {

/// A line plot as one <svg> element with ticks, grid, axis labels and a legend below. Colours are Okabe and
/// Ito's, which colour-blind readers can tell apart; strokes differ too. Points that are not finite break the
/// line.
[[nodiscard]] std::string svg_plot(const Plot& plot);

/// Text with the five characters escaped that XML reserves.
[[nodiscard]] std::string xml_escaped(const std::string& text);

/// Positions of ticks from low to high: multiples of `step`, or, when it is 0, about `count` multiples of 1,
/// 2 or 5 times a power of ten.
[[nodiscard]] std::vector<double> linear_ticks(double low, double high, int count, double step = 0.0);

}  // namespace candela::measure
