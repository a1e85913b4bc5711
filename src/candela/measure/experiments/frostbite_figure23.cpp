#include <glm/geometric.hpp>

#include "candela/measure/lit_scene.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/lights/punctual.glsl"
#include "shading/lights/units.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;
using glm::dvec3;

constexpr float kPower_lm = 1000.0f;
const dvec3 kPosition(0.0, 0.0, 2.5);

double degrees(double a) {
    return a * kPi / 180.0;
}

/// A spot that points down, with a cone this wide, edge to edge.
Illuminance spot(double intensity_cd, double opening_deg) {
    const auto outer = float(std::cos(degrees(0.5 * opening_deg)));
    const auto inner = float(std::cos(degrees(0.45 * opening_deg)));
    return [=](const dvec3& n, const dvec3& position) {
        const dvec3 to = kPosition - position;
        const double distance2 = glm::dot(to, to);
        const dvec3 l = to / std::sqrt(distance2);
        return intensity_cd * std::max(glm::dot(n, l), 0.0) / distance2 *
               double(angle_attenuation(float(l.z), inner, outer));
    };
}

constexpr std::array<double, 3> kOpenings_deg{25.0, 45.0, 70.0};

double exact_cd(double opening_deg) {
    return double(spot_cd_from_lm_exact(kPower_lm, float(degrees(0.5 * opening_deg))));
}

Findings run() {
    LitScene scene;
    scene.width = 150;
    scene.height = 110;
    scene.target = dvec3(0.0, 0.0, 0.4);
    scene.balls = {{0.0, 0.0, 0.4, 0.4}};
    std::vector<Panel> exact;
    std::vector<Panel> frostbite;
    Series exact_lx{"exact", {}, {}, Stroke::solid};
    Series frostbite_lx{"Frostbite, power / pi", {}, {}, Stroke::dashed};
    const dvec3 up(0.0, 0.0, 1.0);
    const double fixed_cd = double(spot_cd_from_lm(kPower_lm));
    for (const double opening : kOpenings_deg) {
        exact.push_back(render(scene, spot(exact_cd(opening), opening), 400.0));
        frostbite.push_back(render(scene, spot(fixed_cd, opening), 400.0));
    }
    for (const double opening : linspace(10.0, 175.0, 100)) {
        exact_lx.x.push_back(opening);
        frostbite_lx.x.push_back(opening);
        exact_lx.y.push_back(spot(exact_cd(opening), opening)(up, dvec3(0.0)));
        frostbite_lx.y.push_back(spot(fixed_cd, opening)(up, dvec3(0.0)));
    }
    const double ratio = exact_cd(25.0) / exact_cd(70.0);
    const double solid_angles =
        double(cone_solid_angle(float(degrees(35.0))) / cone_solid_angle(float(degrees(12.5))));
    Findings out;
    out.text = "With the exact solid angle the same 1000 lm light the middle " + number(ratio, 3) +
               " times as much from a cone of 25 degrees as from one of 70: the ratio of the solid angles. "
               "With Frostbite's "
               "power / pi the level does not depend on the cone.";
    out.measured = {within("exact: 25 over 70 degrees, over the ratio of the solid angles",
                           ratio / solid_angles, 0.9999, 1.0001),
                    within("Frostbite: 10 over 175 degrees", frostbite_lx.y.front() / frostbite_lx.y.back(),
                           0.9999, 1.0001)};
    out.pictures = {
        beside(exact, "Exact: 25, 45 and 70 degrees, 1000 lm", "A smaller cone is brighter inside."),
        beside(frostbite, "Frostbite: 25, 45 and 70 degrees, 1000 lm", "The cone only masks.")};
    out.plots = {{"Illuminance under a spot of 1000 lm at 2.5 m",
                  "",
                  {"opening angle, degrees", 0.0, 180.0, Scale::linear, 30.0},
                  {"illuminance, lx", 10.0, 1e5, Scale::logarithmic},
                  {exact_lx, frostbite_lx}}};
    return out;
}

}  // namespace

Experiment frostbite_figure23() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 23", "A spot's cone and its illuminance",
            "The same luminous power through three cones, by the exact solid angle and by Frostbite's "
            "convention.",
            run};
}

}  // namespace candela::measure::experiments
