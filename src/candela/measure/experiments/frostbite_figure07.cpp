#include "candela/measure/numerics.hpp"
#include "candela/measure/spheres.hpp"
#include "shading/fresnel.glsl"
#include "shading/microfacet.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

constexpr const char* kPaper = "Lagarde & de Rousiers 2014 (Frostbite)";

float visibility(bool correlated, float NoV, float NoL, float alpha) {
    return correlated ? V_SmithGGXCorrelated(NoV, NoL, alpha) : V_SmithGGXUncorrelated(NoV, NoL, alpha);
}

/// Directional albedo for F = 1.
double albedo(bool correlated, double NoV, float alpha) {
    const vec3 v = at_cosine(float(NoV));
    return integrate_hemisphere(v, alpha, 96, [&](const vec3& l) {
        return D_GGX(vec3(0, 0, 1), normalize(v + l), alpha) * visibility(correlated, v.z, l.z, alpha);
    });
}

Panel spheres() {
    const vec3 light = normalize(vec3(0.5f, 0.45f, 0.75f));
    const vec3 v(0, 0, 1);
    const auto shade = [&](int row, int column, const vec3& n) {
        const float alpha = alpha_from_perceptual_roughness(0.25f + 0.15f * float(column));
        const float NoL = dot(n, light);
        if (NoL <= 0.0f) return vec3(0.0f);
        const vec3 h = normalize(v + light);
        const vec3 f0 = row < 2 ? vec3(0.04f) : vec3(0.95f);
        const vec3 lobe = D_GGX(n, h, alpha) * visibility(row % 2 == 1, n.z, NoL, alpha) *
                          F_Schlick(f0, vec3(1.0f), dot(v, h));
        return lobe * NoL * (row < 2 ? 20.0f : 2.5f);
    };
    Panel out = sphere_grid(4, 6, 72, shade);
    out.zoom = 1;
    out.title = "One light from the upper right; roughness 0.25 to 1";
    out.caption =
        "Top to bottom: black dielectric uncorrelated, correlated; chrome uncorrelated, correlated.";
    return out;
}

Findings run() {
    ErrorStatistics value;
    double lowest_gain = 1e9;
    double largest_ratio = 0.0;
    for (const double alpha : linspace(0.02, 1.0, 50)) {
        for (const double v : linspace(0.02, 1.0, 50)) {
            for (const double l : linspace(0.02, 1.0, 50)) {
                const double correlated = double(visibility(true, float(v), float(l), float(alpha)));
                const double uncorrelated = double(visibility(false, float(v), float(l), float(alpha)));
                lowest_gain = std::min(lowest_gain, correlated / uncorrelated);
                largest_ratio = std::max(largest_ratio, correlated / uncorrelated);
                value.add(4.0 * v * l * (correlated - uncorrelated));
            }
        }
    }
    Plot albedos{"Directional albedo, F = 1",
                 "Solid: height-correlated. Dashed: uncorrelated.",
                 {"n.v", 0.0, 1.0},
                 {"albedo", 0.0, 1.0},
                 {}};
    Plot gain{"Energy that the correlated form brings back", "", {"n.v", 0.0, 1.0}, {"gain in albedo"}, {}};
    int color = 0;
    for (const float alpha : {0.1f, 0.3f, 0.6f, 1.0f}) {
        const auto x = linspace(0.03, 1.0, 40);
        albedos.series.push_back(curve(
            "alpha " + number(double(alpha)), x, [&](double c) { return albedo(true, c, alpha); },
            Stroke::solid, color));
        albedos.series.push_back(curve(
            "", x, [&](double c) { return albedo(false, c, alpha); }, Stroke::dashed, color));
        gain.series.push_back(curve(
            "alpha " + number(double(alpha)), x,
            [&](double c) { return albedo(true, c, alpha) - albedo(false, c, alpha); }, Stroke::solid,
            color));
        ++color;
    }
    const auto mean_gain = [](float alpha) {
        return 2.0 *
               integrate([&](double c) { return c * (albedo(true, c, alpha) - albedo(false, c, alpha)); },
                         0.01, 1.0, 2);
    };
    const double rough = mean_gain(1.0f);
    const double smooth = mean_gain(0.1f);
    Findings out;
    out.text = "The correlated form is never below the other and up to " + number(largest_ratio, 3) +
               " times as large, where both directions graze a rough surface. It brings back " +
               number(100.0 * rough, 2) + " % of the light at alpha = 1 (mean over a diffuse view) and " +
               number(100.0 * smooth, 2) + " % at alpha = 0.1: more for high roughness, as the paper says.";
    out.measured = {
        at_least("correlated over uncorrelated, smallest", lowest_gain, 0.99999),
        within("correlated over uncorrelated, largest (cosines 0.02, alpha 1)", largest_ratio, 12.9, 13.1),
        within("energy brought back at alpha = 1", 100.0 * rough, 2.0, 5.0, "%"),
        at_most("energy brought back at alpha = 0.1", 100.0 * smooth, 1.0, "%")};
    out.pictures = {spheres()};
    out.plots = {albedos, gain};
    out.techniques = {
        {"V_SmithGGXUncorrelated", "Walter et al. 2007, equation 23", "height-correlated Smith",
         "G of V_SmithGGXCorrelated; alpha, cosines 0.02 to 1", "", value.mean(), value.max(),
         [] { return cost_ns([](const vec4& u) { return V_SmithGGXUncorrelated(u.x, u.y, u.z); }); }},
        {"V_SmithGGXCorrelated", "Frostbite section 3.1.2, listing 2", "nothing: exact for Smith's surface",
         "itself", "", 0.0, 0.0,
         [] { return cost_ns([](const vec4& u) { return V_SmithGGXCorrelated(u.x, u.y, u.z); }); }}};
    return out;
}

}  // namespace

Experiment frostbite_figure07() {
    return {kPaper, "Figure 7", "Uncorrelated against height-correlated Smith",
            "Ratio of the two visibility terms, and the energy that the correlated one brings back, over "
            "angle and alpha.",
            run};
}

}  // namespace candela::measure::experiments
