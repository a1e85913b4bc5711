#include "candela/measure/dfg_lookup.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/fully_rough.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

Surface surface(float metallic, float base) {
    Surface s{};
    s.base_color = vec3(base);
    s.metallic = metallic;
    s.perceptual_roughness = 1.0f;
    s.dielectric_f0 = vec3(0.04f);
    s.dielectric_f90 = vec3(1.0f);
    return s;
}

/// Of a material of roughness 1: the light that is not where the full model of `mobile` has it, summed over
/// all places of a sun, and the light of a uniform surrounding; both over the full model's.
struct Replaced {
    double misplaced = 0.0;
    double furnace = 0.0;
};
Replaced replaced(const Surface& s, float NoV) {
    const vec3 n(0.0f, 0.0f, 1.0f);
    const vec3 v = at_cosine(NoV);
    const BsdfTechniques t = image_based_form(techniques_ue4());
    const Surface rough = fully_rough_surface(s);
    double full = 0.0;
    double without_lobe = 0.0;
    Replaced out;
    const auto f = [&](const Surface& of, const vec3& l) {
        vec3 diffuse;
        vec3 specular;
        evaluate_standard(of, t, n, v, l, vec4(0.5f), diffuse, specular);
        return double(diffuse.x + specular.x);
    };
    full = integrate_hemisphere(v, 1.0f, 64, [&](const vec3& l) { return f(s, l); });
    without_lobe = integrate_hemisphere(v, 1.0f, 64, [&](const vec3& l) { return f(rough, l); });
    out.misplaced =
        integrate_hemisphere(v, 1.0f, 64, [&](const vec3& l) { return std::abs(f(rough, l) - f(s, l)); }) /
        full;
    out.furnace = without_lobe / full;
    return out;
}

Findings run() {
    ErrorStatistics misplaced;
    ErrorStatistics furnace;
    for (const Surface& s :
         {surface(0.0f, 0.1f), surface(0.0f, 0.5f), surface(1.0f, 0.5f), surface(1.0f, 1.0f)}) {
        for (const double NoV : linspace(0.1, 1.0, 19)) {
            const Replaced r = replaced(s, float(NoV));
            misplaced.add(r.misplaced);
            furnace.add(r.furnace - 1.0);
        }
    }
    const vec2 ab = env_brdf_approx(1.0f, 1.0f);
    ErrorStatistics over_angle;
    ErrorStatistics simplified;
    for (const double NoV : linspace(0.02, 1.0, 50)) {
        const vec2 at = env_brdf_approx(1.0f, float(NoV));
        over_angle.add(double(std::max(std::abs(at.x - ab.x), std::abs(at.y - ab.y))));
        for (const float f0 : {0.04f, 0.5f, 1.0f}) {
            const vec2 truth = integrate_ggx_albedo_ue4(float(NoV), 1.0f, 2048);
            simplified.add(double(0.45f * f0 - (f0 * truth.x + truth.y)));
        }
    }
    const double zero = -double(ab.y) / double(ab.x);
    const glm::dvec4 truth = dfg_truth(1.0f, 1.0f, 1000000);
    Findings out;
    out.text =
        "The constants are as printed: " + number(double(ab.x), 5) + " F0 - " + number(-double(ab.y), 2) +
        ". At roughness 1 the approximation does not depend on the angle at all, and it is negative "
        "for F0 below " +
        number(zero, 2) + ". The integral itself is " + number(truth.z, 4) + " F0 + " + number(truth.w, 2) +
        " at normal incidence; the simplification 0.45 F0 is within " + number(simplified.max(), 2) +
        " of it at all angles, the most at grazing ones. A whole material of roughness 1 (the slot "
        "fully-rough: flagged materials in mobile) is " +
        number(100.0 * furnace.mean(), 3) + " % off in a uniform surrounding, and " +
        number(100.0 * misplaced.mean(), 3) +
        " % of a sun's light, summed over its places, is not where the full model has it: the lobe is "
        "wide, but no cosine.";
    out.measured = {
        within("scale of F0 (printed: 0.4524)", double(ab.x), 0.45239, 0.45241),
        within("bias (printed: -0.0024)", double(ab.y), -0.00241, -0.00239),
        at_most("change over n.v at roughness 1", over_angle.max(), 1e-6),
        at_most("0.45 F0 against the integral, F0 0.04 to 1, mean error", simplified.mean(), 0.05),
        at_most("0.45 F0 against the integral, F0 0.04 to 1, largest error", simplified.max(), 0.16),
        within("whole material in a uniform surrounding, mean error", 100.0 * furnace.mean(), 11.2, 11.7,
               "%"),
        within("light of a sun that is elsewhere, mean", 100.0 * misplaced.mean(), 13.4, 14.0, "%")};
    out.techniques = {
        {"fully_rough_surface", "Karis 2014, \"Environment BRDF\"", "a material of roughness 1",
         "the full model with k = alpha / 2, light of a sun summed over its places, relative; base 0.1 to 1, "
         "n.v 0.1 to 1",
         "%", 100.0 * misplaced.mean(), 100.0 * misplaced.max(), [] {
             return cost_ns(
                 [](const vec4& u) { return fully_rough_surface(surface(u.x, u.y)).base_color.x; });
         }}};
    const auto x = linspace(0.02, 1.0, 50);
    out.plots = {{"Reflectance at roughness 1, F0 = 1",
                  "",
                  {"n.v", 0.0, 1.0},
                  {"reflectance", 0.0, 1.0},
                  {curve("integral", x,
                         [](double c) {
                             const vec2 t = integrate_ggx_albedo_ue4(float(c), 1.0f, 2048);
                             return t.x + t.y;
                         }),
                   curve(
                       "EnvBRDFApprox", x,
                       [](double c) {
                           const vec2 t = env_brdf_approx(1.0f, float(c));
                           return t.x + t.y;
                       },
                       Stroke::dashed),
                   curve(
                       "0.45 F0", x, [](double) { return 0.45; }, Stroke::dotted)}}};
    return out;
}

}  // namespace

Experiment karis2014_fully_rough() {
    return {
        "Karis 2014", "EnvBRDFApprox(F0, 1, 1)", "The fully rough material",
        "The constants that roughness 1 and n.v = 1 give, and how good their simplification to 0.45 F0 is.",
        run};
}

}  // namespace candela::measure::experiments
