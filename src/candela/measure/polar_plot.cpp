#include "candela/measure/polar_plot.hpp"

#include <algorithm>
#include <cmath>

#include "candela/measure/numerics.hpp"
#include "candela/measure/svg_plot.hpp"

namespace candela::measure {
namespace {

constexpr double kDegree = kPi / 180.0;
constexpr double kWidth = 600.0;
constexpr double kMargin = 56.0;  ///< labels around the rings
constexpr double kTitle = 40.0;
constexpr double kFooter = 70.0;
constexpr double kRadius = 0.5 * kWidth - kMargin;
constexpr std::uint32_t kGrid = 0xc8c8c8, kAxis = 0x707070;
constexpr std::uint32_t kC0 = 0xd55e00, kC90 = 0x0072b2;  ///< Okabe and Ito's vermilion and blue

/// Which halves have light worth drawing.
struct Halves {
    bool lower = false;
    bool upper = false;
};

Halves halves_of(const scene::PhotometricProfile& p, double largest) {
    constexpr double visible = 0.005;  // of the peak: a line's width
    Halves out;
    for (std::size_t h = 0; h < p.horizontal_deg.size(); ++h) {
        for (std::size_t v = 0; v < p.vertical_deg.size(); ++v) {
            if (double{p.candela[h * p.vertical_deg.size() + v]} <= visible * largest) continue;
            out.lower = out.lower || p.vertical_deg[v] <= 90.0;
            out.upper = out.upper || p.vertical_deg[v] > 90.0;
        }
    }
    if (!out.lower && !out.upper) out.lower = true;
    return out;
}

/// Where things are: the rings' centre, the largest ring, the angles that are drawn.
struct Layout {
    glm::dvec2 center;
    double from_deg;
    double to_deg;
    double height;
    double full_scale;

    [[nodiscard]] glm::dvec2 at(double gamma_deg, double radius) const {
        return center + radius * glm::dvec2(std::sin(gamma_deg * kDegree), std::cos(gamma_deg * kDegree));
    }
};

Layout layout_of(const Halves& halves, double full_scale) {
    Layout out{};
    const double above = halves.upper ? kRadius : 8.0, below = halves.lower ? kRadius : 8.0;
    out.center = {0.5 * kWidth, kTitle + 24.0 + above};
    out.from_deg = halves.lower ? 0.0 : 90.0;
    out.to_deg = halves.upper ? 180.0 : 90.0;
    out.height = out.center.y + below + 24.0 + kFooter;
    out.full_scale = full_scale;
    return out;
}

std::vector<double> range(double from, double to, double step) {
    std::vector<double> out;
    for (int i = 0; from + i * step <= to + 1e-9; ++i) out.push_back(from + i * step);
    return out;
}

/// Signed angles in the order of a pen that goes once through the part that is drawn, from the left to the
/// right: over the aim, or, where only the upper half is drawn, over the zenith. `gammas` ascend from
/// layout.from_deg to to_deg.
std::vector<double> sweep(const Layout& layout, const std::vector<double>& gammas) {
    std::vector<double> out;
    const bool over_zenith = layout.from_deg > 0.0;
    for (const double gamma : gammas) out.push_back(-gamma);
    if (!over_zenith) std::reverse(out.begin(), out.end());
    if (over_zenith) {
        out.insert(out.end(), gammas.rbegin(), gammas.rend());
    } else {
        out.insert(out.end(), gammas.begin(), gammas.end());
    }
    return out;
}

void draw_rings(const Layout& layout, const std::vector<double>& values, Drawing& drawing) {
    for (const double value : values) {
        const double radius = kRadius * value / layout.full_scale;
        DrawnLine ring;
        ring.color = kGrid;
        for (const double gamma : sweep(layout, range(layout.from_deg, layout.to_deg, 1.0)))
            ring.points.push_back(layout.at(gamma, radius));
        drawing.lines.push_back(ring);
        const double label_gamma = layout.from_deg > 0.0 ? 180.0 : 0.0;
        const glm::dvec2 at = layout.at(label_gamma, radius);
        drawing.texts.push_back({at + glm::dvec2(4.0, label_gamma > 0.0 ? 14.0 : -4.0), number(value, 6),
                                 Anchor::start, 11.0, kAxis, true});
    }
}

void draw_spokes(const Layout& layout, Drawing& drawing) {
    constexpr double step_deg = 15.0, label_away = 16.0;
    for (const double gamma : range(layout.from_deg, layout.to_deg, step_deg)) {
        const bool axis = gamma == 0.0 || gamma == 90.0 || gamma == 180.0;
        for (const double side : {-1.0, 1.0}) {
            if (side < 0.0 && (gamma == 0.0 || gamma == 180.0)) continue;
            drawing.lines.push_back(
                {{layout.center, layout.at(side * gamma, kRadius)}, axis ? kAxis : kGrid, 1.0, 0.0});
            const glm::dvec2 at = layout.at(side * gamma, kRadius + label_away);
            const Anchor anchor = std::abs(at.x - layout.center.x) < 30.0 ? Anchor::middle
                                  : side > 0.0                            ? Anchor::start
                                                                          : Anchor::end;
            const double inwards = anchor == Anchor::middle ? 0.0 : -8.0 * side;
            drawing.texts.push_back({at + glm::dvec2(inwards, 4.0), number(gamma) + "\u00b0", anchor, 12.0});
        }
    }
}

DrawnLine curve_of(const scene::PhotometricProfile& p, double c_deg, const Layout& layout, double scale) {
    std::vector<double> gammas = range(layout.from_deg, layout.to_deg, 0.5);
    for (const double v : p.vertical_deg) {
        if (v >= layout.from_deg && v <= layout.to_deg) gammas.push_back(v);
    }
    std::sort(gammas.begin(), gammas.end());
    DrawnLine out;
    out.width = 2.2;
    const std::vector<double> signed_gammas = sweep(layout, gammas);
    for (std::size_t i = 0; i < signed_gammas.size(); ++i) {
        const bool left = i < gammas.size();
        const double value =
            scale * scene::intensity_cd(p, left ? c_deg + 180.0 : c_deg, std::abs(signed_gammas[i]));
        out.points.push_back(layout.at(signed_gammas[i], kRadius * value / layout.full_scale));
    }
    return out;
}

void draw_legend(const Layout& layout, bool axial, const std::string& unit, Drawing& drawing) {
    const double y = layout.height - kFooter + 24.0;
    const auto sample = [&](double x, std::uint32_t color, double dash, const std::string& name) {
        drawing.lines.push_back({{{x, y - 4.0}, {x + 34.0, y - 4.0}}, color, 2.2, dash});
        drawing.texts.push_back({{x + 42.0, y}, name, Anchor::start, 12.0});
    };
    if (axial) {
        sample(kMargin, kC0, 0.0, "all half-planes C");
    } else {
        sample(kMargin, kC0, 0.0, "C180 - C0");
        sample(kMargin + 150.0, kC90, 7.0, "C270 - C90");
    }
    drawing.texts.push_back({{kWidth - kMargin, y}, unit, Anchor::end, 12.0});
}

std::string spread_text(const char* name, const scene::PhotometricSpread& spread, bool axial) {
    const auto text = [](const std::optional<double>& angle) {
        return angle ? fixed(*angle, 1) + "\u00b0" : std::string("none");
    };
    return std::string(name) + " " + text(spread.c0_c180_deg) +
           (axial ? std::string() : " x " + text(spread.c90_c270_deg));
}

std::string shortened(const std::string& text, std::size_t longest) {
    if (text.size() <= longest) return text;
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80)
        --end;  // not inside a character
    return text.substr(0, end) + "...";
}

}  // namespace

Drawing polar_plot(const scene::PhotometricProfile& profile, bool per_klm) {
    const double total_lm = scene::integrated_lm(profile);
    const double flux_lm = profile.lamp_sets.at(profile.lamp_set).flux_lm.value_or(total_lm);
    const double scale = per_klm && flux_lm > 0.0 ? 1000.0 / flux_lm : 1.0;
    const scene::PhotometricPeak top = scene::peak(profile);
    const double largest = scale * top.candela;
    std::vector<double> rings = linear_ticks(0.0, largest > 0.0 ? 1.02 * largest : 1.0, 5);
    if (rings.size() < 2) rings = {0.0, 1.0};
    const double step = rings[1] - rings[0];
    if (rings.back() < largest) rings.push_back(rings.back() + step);
    rings.erase(rings.begin());

    const bool axial = profile.horizontal_deg.size() == 2;
    const Layout layout = layout_of(halves_of(profile, top.candela), rings.back());
    Drawing out;
    out.title = "Polar diagram of " + profile.name;
    out.width = kWidth;
    out.height = layout.height;
    draw_rings(layout, rings, out);
    draw_spokes(layout, out);
    DrawnLine c90 = curve_of(profile, 90.0, layout, scale), c0 = curve_of(profile, 0.0, layout, scale);
    c0.color = kC0;
    c90.color = kC90;
    c90.dash = 7.0;
    out.lines.push_back(c0);
    if (!axial) out.lines.push_back(c90);
    draw_legend(layout, axial, per_klm ? "cd per 1000 lm" : "cd", out);
    out.texts.push_back({{0.5 * kWidth, 26.0}, shortened(profile.name, 60), Anchor::middle, 16.0});
    const std::string summary = readable(total_lm) + " lm, peak " + readable(top.candela) + " cd, " +
                                spread_text("beam", scene::beam_angle(profile), axial) + ", " +
                                spread_text("field", scene::field_angle(profile), axial);
    out.texts.push_back({{0.5 * kWidth, layout.height - 18.0}, summary, Anchor::middle, 12.0});
    return out;
}

}  // namespace candela::measure
