#include "candela/measure/numerics.hpp"
#include "shading/microfacet.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

/// G1(l) G1(v) of both over a grid of cosines at this alpha.
void add_errors(float alpha, float k, ErrorStatistics& errors) {
    for (const double v : linspace(0.01, 1.0, 100)) {
        for (const double l : linspace(0.01, 1.0, 100)) {
            errors.add(double(G1_Schlick(float(v), k) * G1_Schlick(float(l), k)) -
                       double(G1_SmithGGX(float(v), alpha) * G1_SmithGGX(float(l), alpha)));
        }
    }
}

Plot curves() {
    Plot plot{"Masking G1 of one direction",
              "Solid: Smith for GGX. Dashed: Schlick with k = alpha/2. Dotted: Schlick with Karis's remapped "
              "k for point lights.",
              {"cosine of the angle to the normal", 0.0, 1.0},
              {"G1", 0.0, 1.0},
              {}};
    int color = 0;
    for (const double alpha : {0.1, 0.5, 0.9}) {
        const auto x = linspace(0.0, 1.0, 201);
        const float a = float(alpha);
        const std::string name = "alpha " + number(alpha);
        plot.series.push_back(curve(
            name, x, [&](double c) { return G1_SmithGGX(float(c), a); }, Stroke::solid, color));
        plot.series.push_back(curve(
            "", x, [&](double c) { return G1_Schlick(float(c), k_image_based(a)); }, Stroke::dashed, color));
        plot.series.push_back(curve(
            "", x, [&](double c) { return G1_Schlick(float(c), k_analytic(std::sqrt(a))); }, Stroke::dotted,
            color));
        ++color;
    }
    return plot;
}

Plot differences() {
    Plot plot{"Difference of G1, Schlick with k = alpha/2 minus Smith",
              "",
              {"cosine of the angle to the normal", 0.0, 1.0},
              {"difference of G1"},
              {}};
    for (const double alpha : {0.05, 0.1, 0.3, 0.5, 0.9, 1.0}) {
        const float a = float(alpha);
        plot.series.push_back(curve("alpha " + number(alpha), linspace(0.0, 1.0, 201), [&](double c) {
            return double(G1_Schlick(float(c), k_image_based(a))) - double(G1_SmithGGX(float(c), a));
        }));
    }
    return plot;
}

Findings run() {
    ErrorStatistics fit;
    ErrorStatistics remapped;
    ErrorStatistics alpha_one;
    ErrorStatistics g1;
    for (const double alpha : linspace(0.01, 1.0, 50)) {
        const float a = float(alpha);
        add_errors(a, k_image_based(a), fit);
        add_errors(a, k_analytic(std::sqrt(a)), remapped);
        for (const double c : linspace(0.001, 1.0, 500))
            g1.add(double(G1_Schlick(float(c), k_image_based(a))) - double(G1_SmithGGX(float(c), a)));
    }
    add_errors(1.0f, k_image_based(1.0f), alpha_one);
    Findings out;
    out.text =
        "At alpha = 1 both are the same function, as the paper says. Elsewhere Schlick's form is off by at "
        "most " +
        number(g1.max(), 3) + " in G1 and, for light and view together, by " + number(fit.mean(), 2) +
        " on average and " + number(fit.max(), 2) +
        " at worst, at grazing angles of smooth surfaces, where it masks too much. The remapped k for point "
        "lights, "
        "which is meant to differ, is off by up to " +
        number(remapped.max(), 2) + ".";
    out.measured = {at_most("G(l,v) at alpha = 1, largest difference", alpha_one.max(), 1e-6),
                    at_most("G1 over alpha and angle, largest difference", g1.max(), 0.165),
                    at_most("G(l,v) over alpha and angles, mean difference", fit.mean(), 0.06),
                    at_most("G(l,v) over alpha and angles, largest difference", fit.max(), 0.26)};
    out.plots = {curves(), differences()};
    const std::string truth = "G(l,v) of V_SmithGGXUncorrelated, alpha 0.01 to 1, cosines 0.01 to 1";
    out.techniques = {
        {"V_SchlickSmith, k_image_based", "Karis 2013, Specular G",
         "Smith masking and shadowing without roots", truth, "", fit.mean(), fit.max(),
         [] { return cost_ns([](const vec4& u) { return V_SchlickSmith(u.x, u.y, k_image_based(u.z)); }); }},
        {"V_SchlickSmith, k_analytic", "Karis 2013, equation 4", "Smith, less hot for point lights", truth,
         "", remapped.mean(), remapped.max(),
         [] { return cost_ns([](const vec4& u) { return V_SchlickSmith(u.x, u.y, k_analytic(u.z)); }); }}};
    return out;
}

}  // namespace

Experiment karis2013_figure2() {
    return {"Karis 2013", "Figure 2", "Schlick's masking with k = alpha/2 against Smith's",
            "Both masking functions over angle and alpha, for one direction and for light and view together.",
            run};
}

}  // namespace candela::measure::experiments
