#include "candela/measure/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace candela::measure {
namespace {

std::string text_of(const char* format, double value) {
    char text[48];
    std::snprintf(text, sizeof(text), format, value);
    return text;
}

std::string closeness(double flip, const std::optional<Metrics>& noise, const std::string& reference) {
    if (flip == 0.0) return "looks the same as " + reference;
    if (noise && flip <= 1.2 * noise->flip) return "cannot be told from " + reference + " within its noise";
    if (flip < 0.02) return "is very close to " + reference;
    if (flip < 0.05) return "is close to " + reference;
    return std::string(flip < 0.1 ? "is visibly" : "is clearly") + " different from " + reference;
}

std::string brightness(double ratio) {
    const double percent = 100.0 * std::abs(ratio - 1.0);
    if (!std::isfinite(percent)) return {};
    if (percent < 0.5) return "; it is as bright";
    return "; it is " + text_of("%.1f", percent) + " % " + (ratio > 1.0 ? "brighter" : "darker") +
           " on average";
}

}  // namespace

std::string verdict(const VerdictInput& input) {
    const double flip = input.metrics.flip;
    std::string out = input.picture + " " + closeness(flip, input.noise, input.reference) + ": mean FLIP " +
                      text_of("%.3f", flip);
    if (input.noise)
        out += ", where " + input.reference + "'s own noise makes " + text_of("%.3f", input.noise->flip);
    if (input.brightness_ratio) out += brightness(*input.brightness_ratio);
    out += ".";
    const auto most =
        std::max_element(input.paths.begin(), input.paths.end(),
                         [](const PathError& a, const PathError& b) { return a.share < b.share; });
    if (most != input.paths.end() && most->share > 0.0)
        out += (most->share > 0.5 ? " Most of the difference is in "
                                  : " The largest part of the difference is in ") +
               most->path + " light (" + text_of("%.0f", 100.0 * most->share) + " %).";
    return out;
}

}  // namespace candela::measure
