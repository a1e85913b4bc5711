#include "candela/measure/numerics.hpp"
#include "shading/dfg.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

constexpr uint kSamples = 2048;

struct Grid {
    ErrorStatistics scale;
    ErrorStatistics bias;
    ErrorStatistics metal;       ///< F0 = 1
    ErrorStatistics dielectric;  ///< F0 = 0.04
    double lowest_bias = 1.0;
    Series worst_metal{"F0 = 1", {}, {}};
    Series worst_dielectric{"F0 = 0.04", {}, {}, Stroke::dashed};
};

Grid grid() {
    Grid out;
    for (const double roughness : linspace(0.02, 1.0, 50)) {
        double worst_metal = 0.0;
        double worst_dielectric = 0.0;
        for (const double NoV : linspace(0.02, 1.0, 50)) {
            const vec2 truth = integrate_ggx_albedo_ue4(float(NoV), float(roughness), kSamples);
            const vec2 fit = env_brdf_approx(float(roughness), float(NoV));
            const vec2 error = fit - truth;
            const double metal = double(error.x + error.y);
            const double dielectric = double(0.04f * error.x + error.y);
            out.scale.add(double(error.x));
            out.bias.add(double(error.y));
            out.metal.add(metal);
            out.dielectric.add(dielectric);
            out.lowest_bias = std::min(out.lowest_bias, double(fit.y));
            worst_metal = std::max(worst_metal, std::abs(metal));
            worst_dielectric = std::max(worst_dielectric, std::abs(dielectric));
        }
        for (Series* s : {&out.worst_metal, &out.worst_dielectric}) s->x.push_back(roughness);
        out.worst_metal.y.push_back(worst_metal);
        out.worst_dielectric.y.push_back(worst_dielectric);
    }
    return out;
}

Plot curves(const char* title, const char* label, int channel) {
    Plot plot{title, "Solid: the integral. Dashed: EnvBRDFApprox.", {"n.v", 0.0, 1.0}, {label}, {}};
    int color = 0;
    for (const float roughness : {0.1f, 0.4f, 0.7f, 1.0f}) {
        const auto x = linspace(0.01, 1.0, 100);
        plot.series.push_back(curve(
            "roughness " + number(double(roughness)), x,
            [&](double NoV) { return integrate_ggx_albedo_ue4(float(NoV), roughness, kSamples)[channel]; },
            Stroke::solid, color));
        plot.series.push_back(curve(
            "", x, [&](double NoV) { return env_brdf_approx(roughness, float(NoV))[channel]; },
            Stroke::dashed, color));
        ++color;
    }
    return plot;
}

Findings run() {
    const Grid g = grid();
    Findings out;
    out.text =
        "Reflectance of the approximation against the integral of Karis's model (Schlick-Smith, k = "
        "alpha/2): for F0 = 1 it "
        "is off by " +
        number(g.metal.mean(), 2) + " on average and " + number(g.metal.max(), 2) +
        " at worst, for F0 = 0.04 by " + number(g.dielectric.mean(), 2) + " and " +
        number(g.dielectric.max(), 2) +
        ". The worst is at grazing angles, where one exponential follows the rise of the bias too early. The "
        "bias goes down to " +
        number(g.lowest_bias, 2) + ", so black can become slightly negative.";
    out.measured = {at_most("reflectance for F0 = 1, mean error", g.metal.mean(), 0.065),
                    at_most("reflectance for F0 = 1, largest error", g.metal.max(), 0.3),
                    at_most("reflectance for F0 = 0.04, mean error", g.dielectric.mean(), 0.015),
                    at_most("reflectance for F0 = 0.04, largest error", g.dielectric.max(), 0.2),
                    at_most("scale, mean error", g.scale.mean(), 0.06),
                    at_most("scale, largest error", g.scale.max(), 0.19),
                    at_most("bias, mean error", g.bias.mean(), 0.015),
                    at_most("bias, largest error", g.bias.max(), 0.2),
                    at_least("bias, lowest value", g.lowest_bias, -0.0025)};
    out.plots = {curves("Scale of F0", "scale", 0),
                 curves("Bias", "bias", 1),
                 {"Largest error of the reflectance over all angles",
                  "",
                  {"perceptual roughness", 0.0, 1.0},
                  {"reflectance"},
                  {g.worst_metal, g.worst_dielectric}}};
    out.techniques = {
        {"env_brdf_approx", "Karis 2014, Environment BRDF", "the DFG table",
         "reflectance for F0 = 1, 2048 points; roughness and n.v 0.02 to 1", "", g.metal.mean(),
         g.metal.max(), [] { return cost_ns([](const vec4& u) { return env_brdf_approx(u.x, u.y).x; }); }},
        {"EnvBRDFApprox, F0 = 0.04", "Karis 2014, Environment BRDF", "the DFG table",
         "reflectance for F0 = 0.04, as above", "", g.dielectric.mean(), g.dielectric.max(),
         [] { return cost_ns([](const vec4& u) { return EnvBRDFApprox(vec3(0.04f), u.x, u.y).x; }); }}};
    return out;
}

}  // namespace

Experiment karis2014_env_brdf_approx() {
    return {"Karis 2014", "EnvBRDFApprox", "The environment BRDF without a table",
            "The approximation against the integral over roughness and angle, and the reflectance it gives "
            "metal and dielectric.",
            run};
}

}  // namespace candela::measure::experiments
