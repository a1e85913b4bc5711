#include "candela/measure/numerics.hpp"
#include "shading/microfacet.glsl"
#include "shading/remapping.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

Findings run() {
    const auto x = linspace(0.0, 1.0, 201);
    ErrorStatistics ryse;
    ErrorStatistics burley;
    for (const double s : x) {
        ryse.add(double(alpha_from_smoothness_fourth(float(s)) - alpha_from_smoothness_ryse(float(s))));
        if (s < 0.95)
            burley.add(
                double(alpha_from_smoothness(float(s)) - alpha_from_perceptual_roughness(float(1.0 - s))));
    }
    Findings out;
    out.text =
        "The square of 1 - smoothness is Burley's square of the perceptual roughness, to rounding. The "
        "fourth power, which the paper shows in place of Ryse's curve, is within " +
        number(ryse.max(), 2) + " of it (" + number(ryse.mean(), 2) +
        " on average): a very close match, as stated.";
    out.measured = {
        at_most("(1 - s)^2 against Burley's remapping, largest difference in alpha", burley.max(), 1e-6),
        at_most("(1 - s)^4 against (1 - 0.7 s)^6, largest difference in alpha", ryse.max(), 0.02),
        at_most("(1 - s)^4 against (1 - 0.7 s)^6, mean difference in alpha", ryse.mean(), 0.01)};
    out.plots = {{"Smoothness remapping",
                  "",
                  {"smoothness", 0.0, 1.0},
                  {"alpha", 0.0, 1.0},
                  {curve("1 - s", x, [](double s) { return 1.0 - s; }),
                   curve("(1 - s)^2, Frostbite", x, [](double s) { return alpha_from_smoothness(float(s)); }),
                   curve(
                       "(1 - s)^4", x, [](double s) { return alpha_from_smoothness_fourth(float(s)); },
                       Stroke::dashed),
                   curve(
                       "(1 - 0.7 s)^6, Ryse", x,
                       [](double s) { return alpha_from_smoothness_ryse(float(s)); }, Stroke::dotted)}}};
    out.techniques = {{"alpha_from_smoothness_fourth", "Frostbite Figure 12", "Ryse's remapping",
                       "(1 - 0.7 s)^6, s 0 to 1", "", ryse.mean(), ryse.max(), [] {
                           return cost_ns([](const vec4& u) { return alpha_from_smoothness_fourth(u.x); });
                       }}};
    return out;
}

}  // namespace

Experiment frostbite_figure12() {
    return {
        "Lagarde & de Rousiers 2014 (Frostbite)", "Figure 12", "Remapping smoothness",
        "The remapping functions of the figure over smoothness, and how close the fourth power is to Ryse's.",
        run};
}

}  // namespace candela::measure::experiments
