#include "exposure_advice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "candela/realtime/exposure_meter.hpp"
#include "shading/language.glsl"

namespace candela::app {
namespace {

constexpr double kNearlyAll = 0.99;
constexpr float kBlack = 0.01f;
/// A stop above white: an evenly white wall is no mistake.
constexpr float kClipped = 2.0f;

}  // namespace

void advise_exposure(Job& job, const realtime::Still& still) {
    if (job.exposure.automatic()) return;
    const std::vector<glm::vec4> lit = realtime::lit_nit(still);
    const std::optional<float> right = realtime::metered_ev100(std::span<const glm::vec4>(lit));
    if (!right) return;
    std::size_t seen = 0;
    std::size_t black = 0;
    std::size_t clipped = 0;
    for (const glm::vec4& p : lit) {
        const float exposed = shading::luminance(glm::vec3(p)) * still.exposure;
        if (!(exposed > 0.0f)) continue;
        ++seen;
        black += exposed < kBlack ? 1u : 0u;
        clipped += exposed > kClipped ? 1u : 0u;
    }
    const double limit = kNearlyAll * static_cast<double>(seen);
    const bool too_dark = static_cast<double>(black) > limit;
    if (!too_dark && !(static_cast<double>(clipped) > limit)) return;
    char text[240];
    std::snprintf(
        text, sizeof(text),
        "the exposure EV100 %.1f %s: it is %.1f stops too %s, EV100 %.1f would be right (--ev100 %.1f, or "
        "--auto-exposure)",
        double(still.ev100),
        too_dark ? "leaves nearly all of the picture under 1 % of white" : "clips nearly all of the picture",
        std::abs(double(still.ev100 - *right)), too_dark ? "dark" : "bright", double(*right), double(*right));
    job.diagnostics.warn(text);
}

}  // namespace candela::app
