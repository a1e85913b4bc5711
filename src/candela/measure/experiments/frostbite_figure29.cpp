#include <array>

#include "candela/measure/numerics.hpp"
#include "candela/measure/specular_techniques.hpp"
#include "shading/lights/representative_point.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

constexpr std::array kAlphas{0.002f, 0.005f, 0.01f, 0.02f, 0.05f, 0.1f, 0.2f, 0.4f};
constexpr std::array kAngles_deg{0.0f, 30.0f, 60.0f, 80.0f};
constexpr float kAngularRadius_rad = 0.00465f;  ///< Frostbite, footnote 28: a diameter of 0.53 degrees
constexpr uint kSuns = 60;

vec3 mirror_of(const SpecularView& view) {
    return {-view.v.x, -view.v.y, view.v.z};
}

/// D V cos of the sun's disc with everything in one direction, per luminance and over the albedo.
double in_one_direction(const ShapedLight& sun, const SpecularView& view, const vec3& l) {
    const vec3 n(0.0f, 0.0f, 1.0f);
    const float solid_angle = TWO_PI * (1.0f - std::cos(kAngularRadius_rad));
    const float illuminance = solid_angle * max(normalize(sun.center).z, 0.0f);
    return double(specular_at_point(n, view.v, l, view.alpha, view.alpha) * illuminance / view.albedo);
}
double punctual(const ShapedLight& sun, const SpecularView& view) {
    return in_one_direction(sun, view, sun.center);
}
double disc(const ShapedLight& sun, const SpecularView& view) {
    return in_one_direction(
        sun, view,
        representative_direction_of_sun(normalize(sun.center), mirror_of(view), kAngularRadius_rad));
}

std::vector<SpecularTechnique> techniques() {
    std::vector<SpecularTechnique> out{
        {"representative_direction_of_sun", "sun disc", "Frostbite, section 4.6, listing 6", disc},
        {"specular_at_point", "punctual sun", "Frostbite, equation 28", punctual}};
    out.push_back(specular_techniques(LightShape::sphere).front());
    return out;
}

/// Sums of |error| by technique, and of the truth, over suns in the lobe.
struct Sums {
    std::array<double, 3> errors{};
    double truth = 0.0;
};

Sums measure_alpha(float alpha, const std::vector<SpecularTechnique>& all) {
    Sums out;
    for (const float angle_deg : kAngles_deg) {
        const float NoV = std::cos(angle_deg * PI / 180.0f);
        const SpecularTruth truth(NoV, alpha, specular_albedo(NoV, alpha), 1024, 1024);
        const SpecularView view{truth.view(), alpha, truth.albedo()};
        for (uint k = 0; k < kSuns; ++k) {
            const vec3 h = sample_ggx_vndf(sobol_owen(k, 41u), view.v, std::max(alpha, kAngularRadius_rad));
            ShapedLight sun;
            sun.center = 2.0f * dot(view.v, h) * h - view.v;
            if (sun.center.z < 2.0f * kAngularRadius_rad) continue;
            sun.radius = std::sin(kAngularRadius_rad);
            const double integral = truth.integrate(sun).value;
            out.truth += integral;
            for (std::size_t i = 0; i < all.size(); ++i)
                out.errors[i] += std::abs(all[i].estimate(sun, view) - integral);
        }
    }
    return out;
}

Findings run() {
    const std::vector<SpecularTechnique> all = techniques();
    Findings out;
    Plot plot{"The sun's highlight: error over roughness",
              "Sum of errors over sum of truths.",
              {"alpha", 0.002, 0.4, Scale::logarithmic},
              {"error, %", 0.01, 10000.0, Scale::logarithmic},
              {}};
    for (const SpecularTechnique& t : all) plot.series.push_back({t.label, {}, {}});
    std::array<double, 3> total{};
    std::array<double, 3> worst{};
    double truth = 0.0;
    for (const float alpha : kAlphas) {
        const Sums sums = measure_alpha(alpha, all);
        truth += sums.truth;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const double percent = 100.0 * sums.errors[i] / sums.truth;
            plot.series[i].x.push_back(double(alpha));
            plot.series[i].y.push_back(percent);
            total[i] += sums.errors[i];
            worst[i] = std::max(worst[i], percent);
        }
    }
    out.plots.push_back(std::move(plot));
    out.measured = {at_most("transformed cosine: error at the worst alpha", worst[2], 12.0, "%"),
                    at_most("sun disc: error at alpha 0.2", out.plots[0].series[0].y[6], 3.0, "%"),
                    at_most("punctual sun: error at alpha 0.2", out.plots[0].series[1].y[6], 1.0, "%")};
    out.text =
        "Listing 6 moves all of the sun's light to the mirror direction while the disc covers it, without a "
        "normalization: right for the "
        "shape of the highlight on a mirror, too bright by far where the lobe is narrower than the disc (" +
        number(worst[0], 3) + " % at the worst alpha). From alpha 0.2 on the sun may as well be a point.";
    for (std::size_t i = 0; i < 2; ++i) {
        const auto estimate = all[i].estimate;
        out.techniques.push_back(
            {all[i].name, all[i].source, "D V cos over the sun's disc",
             "sampled integral, suns within the lobe; alpha 0.002 to 0.4; largest: of one alpha", "%",
             100.0 * total[i] / truth, worst[i], [estimate] {
                 return cost_ns([&](const vec4& u) {
                     ShapedLight sun;
                     sun.center = normalize(vec3(u.x, u.y, 0.5f));
                     sun.radius = kAngularRadius_rad;
                     return float(estimate(sun, {at_cosine(u.z), 0.1f + u.w, 1.0f}));
                 });
             }});
    }
    return out;
}

}  // namespace

Experiment frostbite_figure29() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 29",
            "The sun as a disc on surfaces of every roughness",
            "Listing 6's representative direction, a punctual sun and linearly transformed cosines against "
            "the sampled integral, "
            "views at 0, 30, 60 and 80 degrees, suns where the lobe goes.",
            run};
}

}  // namespace candela::measure::experiments
