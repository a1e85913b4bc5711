#pragma once

#include <string>

#include "candela/measure/comparison.hpp"

namespace candela::app {

/// LDR-FLIP in the colours of magma. Throws Error.
void write_map_png(const std::string& file, const measure::ErrorMap& map);

/// |x - r| in R, G and B, the FLIP maps as layers; NaN where a pixel is left out. Throws Error.
void write_map_exr(const std::string& file, const measure::Picture& x, const measure::Picture& r,
                   const measure::Comparison& comparison);

}  // namespace candela::app
