#include "candela/realtime/exposure_meter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "candela/scene/half_range.hpp"
#include "shading/exposure.glsl"

namespace candela::realtime {
namespace {

constexpr double kHighlightFraction = 0.99;
constexpr double kHighlightBelowMean_stops = 4.0;
constexpr double kFaint_stops = 10.0;
constexpr double kFullWeight_stops = 7.0;
constexpr double kLowFraction = 0.10;
constexpr double kHighFraction = 0.95;
/// Readings this far from grey are taken again at the exposure that they suggest.
constexpr float kTrusted_stops = 6.0f;
constexpr float kLargestStep_stops = 16.0f;
constexpr int kMaxReadings = 10;
constexpr int kMaxBlackReadings = 4;

double center_of_bin(std::size_t i) {
    return double{kMeterFirstStop} + (static_cast<double>(i) + 0.5) / double{kMeterBinsPerStop};
}

/// Log2 luminance of the highlights; total > 0.
double highlight_stops(std::span<const std::uint32_t> bins, double total) {
    double mean = 0.0;
    double seen = 0.0;
    double percentile = center_of_bin(0);
    for (std::size_t i = 0; i < bins.size(); ++i) {
        if (bins[i] == 0) continue;
        mean += bins[i] / total * std::exp2(center_of_bin(i));
        if (seen < kHighlightFraction * total) percentile = center_of_bin(i);
        seen += bins[i];
    }
    return std::max(percentile, std::log2(mean) - kHighlightBelowMean_stops);
}

std::size_t bin_of(float units) {
    const float largest = std::min(units, scene::kLargestHalf);
    const float bin = (std::log2(largest) - kMeterFirstStop) * kMeterBinsPerStop;
    return static_cast<std::size_t>(std::clamp(bin, 0.0f, static_cast<float>(kMeterBins - 1)));
}

/// Of luminances in cd/m^2 that are positive and finite.
std::optional<float> meter_luminances(std::span<const float> nit) {
    if (nit.empty()) return std::nullopt;
    double sum = 0.0;
    for (const float y : nit) sum += std::log2(double{y});
    const auto guess_nit = static_cast<float>(std::exp2(sum / static_cast<double>(nit.size())));
    std::array<std::uint32_t, kMeterBins> bins{};
    return meter_ev100(shading::ev100_from_luminance(std::max(guess_nit, 1e-30f)),
                       [&](float units_per_nit) -> std::span<const std::uint32_t> {
                           bins.fill(0);
                           for (const float y : nit) ++bins[bin_of(y * units_per_nit)];
                           return bins;
                       });
}

}  // namespace

std::optional<MeterReading> read_meter(std::span<const std::uint32_t> bins) {
    double total = 0.0;
    for (const std::uint32_t count : bins) total += count;
    if (total == 0.0) return std::nullopt;
    const double highlights = highlight_stops(bins, total);
    std::vector<double> counts(bins.size());
    double counted = 0.0;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        const double above_faint = center_of_bin(i) - (highlights - kFaint_stops);
        const double weight = std::clamp(above_faint / (kFaint_stops - kFullWeight_stops), 0.0, 1.0);
        counts[i] = weight * bins[i];
        counted += counts[i];
    }
    double seen = 0.0;
    double sum = 0.0;
    double within = 0.0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double from = std::max(seen, kLowFraction * counted);
        seen += counts[i];
        const double inside = std::max(0.0, std::min(seen, kHighFraction * counted) - from);
        sum += inside * center_of_bin(i);
        within += inside;
    }
    MeterReading out;
    out.stops = static_cast<float>(sum / within);
    out.clipped = highlights > std::log2(double{scene::kLargestHalf}) - 0.1;
    return out;
}

std::optional<float> meter_ev100(float guess_ev100, const TakeHistogram& take) {
    const float grey_stops = std::log2(shading::kMeteredGrey);
    float ev100 = guess_ev100;
    std::optional<float> found;
    int black = 0;
    for (int i = 0; i < kMaxReadings; ++i) {
        const float units_per_nit = shading::standard_output_exposure(ev100);
        const std::optional<MeterReading> reading = read_meter(take(units_per_nit));
        if (!reading) {
            // Black, or fainter than half floats hold at this exposure.
            if (found || ++black == kMaxBlackReadings) break;
            ev100 -= kLargestStep_stops;
            continue;
        }
        if (reading->clipped) {
            ev100 += kLargestStep_stops;
            continue;
        }
        const float off_stops = reading->stops - grey_stops;
        ev100 += off_stops;
        found = ev100;
        if (std::abs(off_stops) < kTrusted_stops) break;
    }
    return found;
}

std::optional<float> metered_ev100(std::span<const glm::vec4> light_nit) {
    std::vector<float> nit;
    nit.reserve(light_nit.size());
    for (const glm::vec4& p : light_nit) {
        const float y = shading::luminance(glm::vec3(p)) / std::max(p.a, 0.5f);
        if (p.a >= 0.5f && y > 0.0f && std::isfinite(y)) nit.push_back(y);
    }
    return meter_luminances(nit);
}

std::optional<float> metered_ev100(std::span<const glm::vec3> light_nit) {
    std::vector<float> nit;
    nit.reserve(light_nit.size());
    for (const glm::vec3& p : light_nit) {
        const float y = shading::luminance(p);
        if (y > 0.0f && std::isfinite(y)) nit.push_back(y);
    }
    return meter_luminances(nit);
}

}  // namespace candela::realtime
