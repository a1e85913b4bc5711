#include "candela/scene/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace candela {

void PaceEstimate::add(double elapsed_s, double fraction) {
    if (!reports_.empty()) {
        elapsed_s = std::max(elapsed_s, reports_.back().elapsed_s);
        fraction = std::max(fraction, reports_.back().fraction);
    }
    // As many reports as there are steps on a screen are enough: fewer are kept where they come in thousands.
    constexpr std::size_t most = 4096;
    if (reports_.size() >= most) {
        for (std::size_t i = 0; 2 * i < reports_.size(); ++i) reports_[i] = reports_[2 * i];
        reports_.resize((reports_.size() + 1) / 2);
    }
    reports_.push_back({elapsed_s, std::min(fraction, 1.0)});
}

std::optional<double> PaceEstimate::seconds_left(double elapsed_s) const {
    if (reports_.empty() || !(reports_.back().fraction > 0.0)) return std::nullopt;
    const Report& last = reports_.back();
    // The latest report of the earlier half of the time: from the start on, before there is one.
    Report from;
    double steps = 0.0;
    for (const Report& report : reports_) {
        if (report.elapsed_s > 0.5 * last.elapsed_s) {
            steps += 1.0;
        } else {
            from = report;
        }
    }
    const double gained = last.fraction - from.fraction;
    if (!(gained > 0.0)) return std::nullopt;
    const double seconds = last.elapsed_s - from.elapsed_s;
    const double waited_s = std::max(elapsed_s - last.elapsed_s, 0.0);
    // A report that is overdue makes the pace slower; until then the time counts down.
    const double counted_s = std::min(waited_s, seconds / steps);
    return std::max((1.0 - last.fraction) * (seconds + waited_s - counted_s) / gained - counted_s, 0.0);
}

std::string duration_text(double seconds) {
    const long whole = std::lround(std::clamp(seconds, 0.0, 1e9));
    char text[48];
    if (whole < 60)
        std::snprintf(text, sizeof(text), "%ld s", whole);
    else if (whole < 3600)
        std::snprintf(text, sizeof(text), "%ld min %02ld s", whole / 60, whole % 60);
    else
        std::snprintf(text, sizeof(text), "%ld h %02ld min", whole / 3600, whole / 60 % 60);
    return text;
}

}  // namespace candela
