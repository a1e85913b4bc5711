#include "candela/measure/dfg_lookup.hpp"
#include "candela/measure/numerics.hpp"

namespace candela::measure::experiments {
namespace {

using namespace shading;

Findings run() {
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
    out.text = "The constants are as printed: " + number(double(ab.x), 5) + " F0 - " +
               number(-double(ab.y), 2) +
               ". At roughness 1 the approximation does not depend on the angle at all, and it is negative "
               "for F0 below " +
               number(zero, 2) + ". The integral itself is " + number(truth.z, 4) + " F0 + " +
               number(truth.w, 2) + " at normal incidence; the simplification 0.45 F0 is within " +
               number(simplified.max(), 2) + " of it at all angles, the most at grazing ones.";
    out.measured = {
        within("scale of F0 (printed: 0.4524)", double(ab.x), 0.45239, 0.45241),
        within("bias (printed: -0.0024)", double(ab.y), -0.00241, -0.00239),
        at_most("change over n.v at roughness 1", over_angle.max(), 1e-6),
        at_most("0.45 F0 against the integral, F0 0.04 to 1, mean error", simplified.mean(), 0.05),
        at_most("0.45 F0 against the integral, F0 0.04 to 1, largest error", simplified.max(), 0.16)};
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
