#include "candela/measure/numerics.hpp"
#include "shading/fresnel.glsl"
#include "shading/microfacet.glsl"
#include "shading/sampling.glsl"
#include "shading/surface_side.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

struct View {
    vec3 v;
    vec3 surface_normal;
};

/// In the frame of the mapped normal: a map of this tilt, and a viewer at an angle to the surface itself
/// whose azimuth is against the tilt.
View view_of(double tilt_degrees, double view_degrees, double azimuth_degrees) {
    const auto radians = [](double degrees) { return degrees * kPi / 180.0; };
    const double t = radians(tilt_degrees);
    const auto turned = [&](const glm::dvec3& d) {
        return vec3(
            glm::dvec3(d.x * std::cos(t) - d.z * std::sin(t), d.y, d.x * std::sin(t) + d.z * std::cos(t)));
    };
    const double w = radians(view_degrees);
    const double p = radians(azimuth_degrees);
    return {turned({std::sin(w) * std::cos(p), std::sin(w) * std::sin(p), std::cos(w)}), turned({0, 0, 1})};
}

struct Kept {
    double part = 0.0;
    double fresnel_rise = 0.0;
};

/// Part of a lobe's light under a uniform surrounding that comes from above the surface.
Kept integral(const View& view, float alpha, float f0) {
    constexpr int side = 128;
    const vec3 n(0.0f, 0.0f, 1.0f);
    double all = 0.0;
    double above = 0.0;
    double rise = 0.0;
    for (int i = 0; i < side * side; ++i) {
        const glm::vec2 u((float(i % side) + 0.5f) / side, (float(i / side) + 0.5f) / side);
        const vec3 h = sample_ggx_vndf(u, view.v, alpha);
        const vec3 l = 2.0f * glm::dot(view.v, h) * h - view.v;
        if (l.z <= 0.0f) continue;
        const double density = double(pdf_reflected(pdf_ggx_vndf(view.v, h, alpha), glm::dot(view.v, h)));
        const double lobe =
            double(D_GGX(n, h, alpha) * V_SmithGGXCorrelated(view.v.z, l.z, alpha) * l.z) / density;
        const double grazing = std::pow(1.0 - double(glm::dot(view.v, h)), 5.0) * (1.0 - double(f0));
        all += lobe * (double(f0) + grazing);
        rise += lobe * grazing;
        if (above_surface(view.surface_normal, l)) above += lobe * (double(f0) + grazing);
    }
    return {above / all, rise / all};
}

Findings run() {
    ErrorStatistics metal;
    ErrorStatistics dielectric;
    Series seen{"metal", {}, {}, Stroke::points};
    Series seen_dielectric{"dielectric", {}, {}, Stroke::points};
    for (const double tilt : {30.0, 45.0, 60.0}) {
        for (const double roughness : {0.1, 0.2, 0.4, 0.55, 0.7}) {
            for (const double angle : {0.0, 30.0, 60.0}) {
                for (const double azimuth : {0.0, 90.0, 180.0}) {
                    const View view = view_of(tilt, angle, azimuth);
                    if ((angle == 0.0 && azimuth > 0.0) || view.v.z < 0.05f) continue;
                    const auto alpha = float(roughness * roughness);
                    const vec3 n(0.0f, 0.0f, 1.0f);
                    const vec3 mirror = 2.0f * view.v.z * n - view.v;
                    for (const float f0 : {1.0f, 0.04f}) {
                        const Kept truth = integral(view, alpha, f0);
                        const double estimate = double(lobe_above_surface(mirror, n, view.surface_normal,
                                                                          alpha, float(truth.fresnel_rise)));
                        (f0 == 1.0f ? metal : dielectric).add(estimate - truth.part);
                        Series& s = f0 == 1.0f ? seen : seen_dielectric;
                        s.x.push_back(truth.part);
                        s.y.push_back(estimate);
                    }
                }
            }
        }
    }
    Findings out;
    out.text =
        "A normal map turns part of a lobe below the surface, where no light comes from. What is left of it "
        "under a "
        "uniform surrounding is estimated within " +
        number(metal.mean(), 2) + " of the whole lobe on average for metals and " +
        number(dielectric.mean(), 2) + " for dielectrics, at most " +
        number(std::max(metal.max(), dielectric.max()), 2) +
        ": at grazing view towards the tilt, where shadowing cuts the lobe a second time.";
    out.measured = {at_most("metal, mean error", metal.mean(), 0.025),
                    at_most("metal, largest error", metal.max(), 0.14),
                    at_most("dielectric, mean error", dielectric.mean(), 0.03),
                    at_most("dielectric, largest error", dielectric.max(), 0.14)};
    out.plots = {{"Part of the lobe above the surface",
                  "Horizontal: the integral. Vertical: lobe_above_surface.",
                  {"integral", 0.0, 1.0},
                  {"estimate", 0.0, 1.0},
                  {seen, seen_dielectric,
                   curve(
                       "equal", linspace(0.0, 1.0, 2), [](double x) { return x; }, Stroke::dashed)}}};
    const auto cost = [] {
        return cost_ns([](const vec4& u) {
            const vec3 n(0.0f, 0.0f, 1.0f);
            const vec3 s = vec3(u.x, 0.0f, std::sqrt(1.0f - u.x * u.x));
            return lobe_above_surface(vec3(0.0f, u.y, std::sqrt(1.0f - u.y * u.y)), n, s, u.z, u.w);
        });
    };
    const std::string truth =
        "integral, uniform surrounding; maps of 30 to 60 degrees, roughness 0.1 to 0.7, views to 60 degrees";
    out.techniques = {{"lobe_above_surface, F0 = 1", "own, shading/surface_side.glsl",
                       "the part of a lobe about a mapped normal that is above the surface", truth, "",
                       metal.mean(), metal.max(), cost},
                      {"lobe_above_surface, F0 = 0.04", "own, shading/surface_side.glsl",
                       "the part of a lobe about a mapped normal that is above the surface", truth, "",
                       dielectric.mean(), dielectric.max(), cost}};
    return out;
}

}  // namespace

Experiment image_light_normal_maps() {
    return {"Own estimates", "normal maps", "Lobes that normal maps turn below the surface",
            "The part of a reflected lobe that stays above the surface, against the integral.", run};
}

}  // namespace candela::measure::experiments
