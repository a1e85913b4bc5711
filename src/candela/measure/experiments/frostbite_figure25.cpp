#include "candela/measure/numerics.hpp"
#include "shading/lights/falloff_windows.glsl"
#include "shading/lights/punctual.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

using Attenuation = double (*)(double distance_m, double range_m);  ///< over the inverse square

double window1(double d, double range) {
    return double(window_attenuation(float(d), float(range)));
}
double window2(double d, double range) {
    return double(window_attenuation_cutoff(float(d), float(range)));
}
double window3(double d, double range) {
    return double(window_attenuation_smoothstep(float(d), float(range)));
}
double scale_bias(double d, double range) {
    return double(distance_attenuation_scale_bias(float(d), float(range))) * d * d;
}

struct Model {
    const char* label;
    const char* name;
    const char* source;
    Attenuation attenuation;
};

constexpr std::array<Model, 4> kModels{
    Model{"Window1, n = 4", "window_attenuation", "Frostbite equation 26", window1},
    Model{"Window2", "window_attenuation_cutoff", "Frostbite equation 23", window2},
    Model{"Window3, smoothstep", "window_attenuation_smoothstep", "Frostbite Figure 25", window3},
    Model{"scale and bias", "distance_attenuation_scale_bias", "Frostbite equation 25", scale_bias}};

/// Slope in the distance over the range just before the range.
double end_slope(Attenuation f) {
    return (f(10.0, 10.0) - f(9.99, 10.0)) / 0.001;
}

Plot windows() {
    Plot plot{"The windows alone", "", {"distance over range", 0.0, 1.2}, {"factor", 0.0, 1.05}, {}};
    const auto x = linspace(0.001, 1.2, 241);
    for (std::size_t i = 0; i < 3; ++i)
        plot.series.push_back(
            curve(kModels[i].label, x, [&](double d) { return kModels[i].attenuation(10.0 * d, 10.0); }));
    return plot;
}

Plot falloffs(double range_m) {
    Plot plot{"Illuminance of 1 cd with a range of " + number(range_m) + " m",
              "",
              {"distance, m", 1.0, 1.1 * range_m},
              {"illuminance, lx", 1e-2 / (range_m * range_m), 1.0, Scale::logarithmic},
              {}};
    const auto x = linspace(1.0, 1.1 * range_m, 400);
    plot.series.push_back(curve(
        "inverse square", x, [](double d) { return 1.0 / (d * d); }, Stroke::dashed));
    for (const Model& m : kModels)
        plot.series.push_back(curve(m.label, x, [&](double d) {
            const double e = m.attenuation(d, range_m) / (d * d);
            return e > 0.0 ? e : std::nan("");
        }));
    return plot;
}

Findings run() {
    Findings out;
    std::array<ErrorStatistics, kModels.size()> lost;
    for (std::size_t i = 0; i < kModels.size(); ++i) {
        for (const double d : linspace(0.01, 1.0, 400))
            lost[i].add(1.0 - kModels[i].attenuation(10.0 * d, 10.0));
        const Model& m = kModels[i];
        out.techniques.push_back(
            {m.name, m.source, "the inverse square, ended at a range",
             "inverse square within the range, relative", "", lost[i].mean(), lost[i].max(),
             [f = m.attenuation] {
                 return cost_ns([f](const vec4& u) { return float(f(double(u.x), double(u.y) + 0.1)); });
             }});
    }
    out.measured = {
        at_most("Window1: slope at the range, its size", std::abs(end_slope(window1)), 0.02),
        at_least("Window2: slope at the range, its size", std::abs(end_slope(window2)), 19.0),
        at_least("scale and bias: slope at the range, its size", std::abs(end_slope(scale_bias)), 1.9),
        at_most("Window3: slope at the range, its size", std::abs(end_slope(window3)), 0.02),
        at_most("Window1: taken off within the range, mean", lost[0].mean(), 0.3),
        at_most("Window2: taken off within the range over that of Window1", lost[1].mean() / lost[0].mean(),
                0.2),
        at_least("Window3: taken off within the range over that of Window1", lost[2].mean() / lost[0].mean(),
                 1.5),
        at_most("Window1: taken off at half of the range", 1.0 - window1(5.0, 10.0), 0.13)};
    out.text = "Window1 takes " + number(100.0 * lost[0].mean(), 3) +
               " % off the inverse square over the whole range (the others " +
               number(100.0 * lost[1].mean(), 3) + ", " + number(100.0 * lost[2].mean(), 3) + " and " +
               number(100.0 * lost[3].mean(), 3) +
               " %) and reaches the range without slope. Window2, the 20th power, leaves most as it is and "
               "pays for it in the "
               "last tenth, where it falls at 20 times the slope of a straight line; the scaled and biased "
               "falloff reaches the range "
               "at an angle, too: both show as an edge. In relation to the illuminance near the light the "
               "difference shrinks "
               "with the "
               "range, as the paper's second and third graph show.";
    out.plots = {windows(), falloffs(10.0), falloffs(40.0)};
    return out;
}

}  // namespace

Experiment frostbite_figure25() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 25", "Windows on the inverse square",
            "The windowing functions and the falloffs they make for ranges of 10 m and 40 m.", run};
}

}  // namespace candela::measure::experiments
