#pragma once

namespace candela::scene {

/// Half floats end here.
inline constexpr float kLargestHalf = 65504.0f;

/// Up to which light is stored as half floats; the rest is room for what interpolation overshoots.
inline constexpr float kLargestHalfUnits = 60000.0f;

/// What numbers up to `peak` are divided by to be kept as half floats: 1 unless the brightest would not fit.
[[nodiscard]] constexpr float unit_for_half(float peak) {
    return peak > kLargestHalfUnits ? peak / kLargestHalfUnits : 1.0f;
}

}  // namespace candela::scene
