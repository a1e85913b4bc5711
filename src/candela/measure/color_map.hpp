#pragma once

#include <array>
#include <cstdint>

namespace candela::measure {

using Rgb8 = std::array<std::uint8_t, 3>;

/// Error in [0,1] to a display colour from black over red to pale yellow, of evenly rising lightness: magma
/// (Smith & van der Walt 2015, in the public domain), which the FLIP papers use. Sampled at every 15th of its
/// 256 entries and interpolated: within 2/255 of it. NaN is green, a colour that the map does not have.
[[nodiscard]] Rgb8 magma(float error);

}  // namespace candela::measure
