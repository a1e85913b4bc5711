#include <glm/geometric.hpp>

#include "candela/measure/lit_scene.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/lights/sphere.glsl"
#include "shading/tone_curves.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;
using glm::dvec3;

const dvec3 kCenter(0.0, 0.2, 0.35);

/// Lit points, and those of them where r^2 / d^2 n.l is within 1 % of the truth.
struct Count {
    double lit = 0.0;
    double correct = 0.0;
};

Panel picture(double radius_m, Count& count) {
    LitScene scene;
    scene.lamp = [=](const dvec3& origin, const dvec3& direction) {
        return ray_to_sphere(origin, direction, kCenter, radius_m);
    };
    return render(scene, [&](const dvec3& n, const dvec3& position) {
        const vec3 to(kCenter - position);
        const float exact = sphere_projected_solid_angle(vec3(n), to, float(radius_m));
        const float simple = sphere_projected_solid_angle_no_horizon(vec3(n), to, float(radius_m));
        if (exact <= 0.0f) return glm::vec3(0.0f);
        const bool correct = std::abs(simple - exact) < 0.01f * exact;
        count.lit += 1.0;
        count.correct += correct ? 1.0 : 0.0;
        const glm::vec3 value =
            tone_curve(kToneAces, glm::vec3(exact / float(PI * radius_m * radius_m) * 1.6f));
        return correct ? value * glm::vec3(0.35f, 1.0f, 0.35f) : value;
    });
}

Findings run() {
    Count small;
    Count large;
    Findings out;
    out.pictures = {beside(
        {picture(0.08, small), picture(0.9, large)}, "Where the formula without horizon is right",
        "Green: r^2/d^2 n.l is within 1 % of the truth. Left: radius 0.08 m, right: 0.9 m, at the same "
        "power.")};
    const double right_small = small.correct / small.lit;
    const double right_large = large.correct / large.lit;
    out.text = "Of the lit points " + number(100.0 * right_small, 3) +
               " % are right for the small sphere and " + number(100.0 * right_large, 3) +
               " % for the large one: those from which all of the sphere is above the horizon, where the "
               "formula is exact, "
               "whatever the solid angle (the paper asks for a small one, too).";
    out.measured = {at_least("small sphere: share of the lit points that are right", right_small, 0.9),
                    within("large sphere: share of the lit points that are right", right_large, 0.0, 0.5),
                    at_most("large over small", right_large / right_small, 0.5)};
    out.tables = {{"Share of the lit points within 1 %",
                   {"radius, m", "share"},
                   {{"0.08", number(right_small, 3)}, {"0.9", number(right_large, 3)}}}};
    return out;
}

}  // namespace

Experiment frostbite_figure36() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 36", "Where a sphere needs the horizon",
            "The common formula r^2/d^2 n.l against the exact one, for a small and a large sphere.", run};
}

}  // namespace candela::measure::experiments
