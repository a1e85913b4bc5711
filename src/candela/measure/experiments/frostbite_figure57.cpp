#include <cmath>

#include "candela/measure/experiment.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/environment_filter.glsl"

namespace candela::measure::experiments {
namespace {

constexpr int kLevels = 9;

float alpha_of(int level, double exponent) {
    const double roughness = std::pow(double(level) / (kLevels - 1), exponent);
    return shading::alpha_from_perceptual_roughness(static_cast<float>(roughness));
}

double weight(double angle_rad, float alpha) {
    return double(shading::ld_weight(static_cast<float>(std::pow(std::sin(0.5 * angle_rad), 2)), alpha));
}

/// Angle in degrees at which the lobe has fallen to half.
double half_width_deg(float alpha) {
    double low = 0.0;
    double high = 0.5 * kPi;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (weight(middle, alpha) > 0.5 * weight(0.0, alpha) ? low : high) = middle;
    }
    return low * 180.0 / kPi;
}

Findings run() {
    Findings out;
    Table table{"Half width of the lobe of each level in degrees", {"exponent"}, {}};
    for (int level = 1; level < kLevels; ++level) table.columns.push_back(std::to_string(level));
    for (const double exponent : {1.0, 1.5, 2.0}) {
        Plot plot{"Exponent " + number(exponent, 2),
                  "One curve a level, by its peak.",
                  {"angle to the mirror direction, degrees", 0.0, 90.0},
                  {"weight", 0.0, 1.0},
                  {}};
        table.rows.push_back({number(exponent, 2)});
        double narrow = 0.0;
        for (int level = 1; level < kLevels; ++level) {
            const float alpha = alpha_of(level, exponent);
            plot.series.push_back(curve("", linspace(0.0, 90.0, 181), [&](double degrees) {
                return weight(degrees * kPi / 180.0, alpha) / weight(0.0, alpha);
            }));
            const double width = half_width_deg(alpha);
            table.rows.back().push_back(fixed(width, 1));
            narrow += width < 10.0 ? 1.0 : 0.0;
        }
        out.plots.push_back(std::move(plot));
        out.measured.push_back(within("Exponent " + number(exponent, 2) + ": levels narrower than 10 degrees",
                                      narrow, exponent, 2.0 * exponent + 1.0));
    }
    out.tables.push_back(std::move(table));
    out.text = "The larger the exponent, the more levels go to smooth surfaces, as printed.";
    return out;
}

}  // namespace

Experiment frostbite_figure57() {
    return {
        "Lagarde & de Rousiers 2014 (Frostbite)", "Figure 57", "Mappings between roughness and mip level",
        "The LD weight of the nine levels of a 256² cube where the perceptual roughness is the level's share "
        "to the power of 1, 1.5 and 2 (equation 63).",
        run};
}

}  // namespace candela::measure::experiments
