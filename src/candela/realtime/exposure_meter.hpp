#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>

/// The automatic exposure, one for every mode: a frame on the device, a finished picture of the path tracer
/// or a file (docs/exposure.md).
namespace candela::realtime {

/// A histogram of log2 luminance: bins of 1/24 stop from 2^-24 up, the range of half floats. The unit is the
/// light buffer's. GLSL: shaders/histogram.comp.glsl.
inline constexpr std::uint32_t kMeterBins = 1024;
inline constexpr float kMeterFirstStop = -24.0f;
inline constexpr float kMeterBinsPerStop = 24.0f;

struct MeterReading {
    float stops = 0.0f;    ///< log2 of the metered luminance in the histogram's unit
    bool clipped = false;  ///< the highlights are beyond the histogram: the reading is too low
};

/// The luminance that the exposure follows: the mean logarithm of what is no extreme. In this order:
/// 1. Highlights stand at the 99th percentile, or at 1/16 of the mean luminance where that is more.
/// 2. What is over 10 stops below them is the faint rest, which no exposure shows beside them, and does not
///    count; within 7 stops all counts.
/// 3. Of what counts the darkest tenth and the brightest twentieth are left out.
/// Nothing for an empty histogram.
[[nodiscard]] std::optional<MeterReading> read_meter(std::span<const std::uint32_t> bins);

/// Takes the histogram of a picture in units of 1 / units_per_nit cd/m^2; kMeterBins counts.
using TakeHistogram = std::function<std::span<const std::uint32_t>(float units_per_nit)>;

/// EV100 by a reflected-light meter (Frostbite equation 69), from any first guess: the histogram is taken
/// again until what it shows lies within its range. Nothing when all is black.
[[nodiscard]] std::optional<float> meter_ev100(float guess_ev100, const TakeHistogram& take);

/// Of a finished picture: luminance in cd/m^2, a the fraction of the pixel that is metered (unlit surfaces
/// are not). Black and non-finite pixels are not metered.
[[nodiscard]] std::optional<float> metered_ev100(std::span<const glm::vec4> light_nit);
[[nodiscard]] std::optional<float> metered_ev100(std::span<const glm::vec3> light_nit);

}  // namespace candela::realtime
