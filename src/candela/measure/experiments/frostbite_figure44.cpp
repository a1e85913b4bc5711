#include <glm/geometric.hpp>

#include "candela/measure/area_truth.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/lights/tube.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;
using glm::dvec3;

const dvec3 kUp(0.0, 0.0, 1.0);
const vec3 kZ(0.0f, 0.0f, 1.0f);
const vec3 kX(1.0f, 0.0f, 0.0f);
const vec3 kY(0.0f, 1.0f, 0.0f);

double facing_disk(double distance) {
    return double(disk_projected_solid_angle(kZ, float(distance) * kZ, -kZ, 1.0f));
}
double point(double distance) {
    return kPi / (distance * distance);
}

/// A technique with the rule and the truth, at a place that both see at an angle.
struct Rule {
    const char* name;
    double largest_m;  ///< the light's largest dimension
    double (*technique)(const vec3& to);
    double (*truth)(const dvec3& to);
};

const std::array<Rule, 4> kRules{
    Rule{"sphere_projected_solid_angle_five_times", 2.0,
         [](const vec3& to) { return double(sphere_projected_solid_angle_five_times(kZ, to, 1.0f)); },
         [](const dvec3& to) {
             return illuminance_truth(kUp, SphereLight{to, 1.0});
         }},
    Rule{"disk_projected_solid_angle_five_times", 2.0,
         [](const vec3& to) { return double(disk_projected_solid_angle_five_times(kZ, to, -kZ, 1.0f)); },
         [](const dvec3& to) {
             return illuminance_truth(kUp, DiskLight{to, -kUp, 1.0});
         }},
    Rule{"rectangle_projected_solid_angle_five_times", 2.0,
         [](const vec3& to) {
             return double(rectangle_projected_solid_angle_five_times(kZ, to, kX, kY, 1.0f, 0.5f));
         },
         [](const dvec3& to) {
             return illuminance_truth(kUp, RectangleLight{to, dvec3(kX), dvec3(kY), 1.0, 0.5});
         }},
    Rule{"tube_projected_solid_angle_five_times", 2.0,
         [](const vec3& to) { return double(tube_projected_solid_angle_five_times(kZ, to, kX, 0.9f, 0.1f)); },
         [](const dvec3& to) {
             return illuminance_truth(kUp, TubeLight{to, dvec3(kX), 0.9, 0.1});
         }}};

Findings run() {
    Findings out;
    for (const Rule& rule : kRules) {
        ErrorStatistics error;  // relative, beyond five times
        for (const double distance : {5.0, 6.0, 10.0, 30.0}) {
            for (const double tilt : linspace(0.0, 75.0, 6)) {
                for (const double turn : linspace(0.0, 90.0, 4)) {
                    const double t = tilt * kPi / 180.0;
                    const double a = turn * kPi / 180.0;
                    const dvec3 to = 1.0001 * distance * rule.largest_m *
                                     dvec3(std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t));
                    error.add(rule.technique(vec3(to)) / rule.truth(to) - 1.0);
                }
            }
        }
        out.measured.push_back(at_most(std::string(rule.name) + ": beyond five times, largest relative error",
                                       error.max(), 0.035));
        out.techniques.push_back(
            {rule.name, "Frostbite section 4.7.3, listing 14",
             "illuminance of an area light by that of a point",
             "quadrature, 5 to 30 times the largest dimension, tilts to 75 degrees, relative", "",
             error.mean(), error.max(), [f = rule.technique] {
                 return cost_ns([f](const vec4& u) {
                     return float(f(vec3(20.0f * u.x, 20.0f * u.y, 1.0f + 20.0f * u.z)));
                 });
             }});
    }
    double within_1_percent = 0.0;
    for (const double d : linspace(1.0, 20.0, 1901))
        if (point(d) / facing_disk(d) - 1.0 > 0.01) within_1_percent = d;
    const double at_10 = point(10.0) / facing_disk(10.0) - 1.0;
    out.measured.push_back(within("facing disk: point at 10 radii, relative error (printed: less than 1 %)",
                                  at_10, 0.0, 0.01 * 1.001));
    out.measured.push_back(
        within("facing disk: point within 1 % from, in radii (printed: 10)", within_1_percent, 9.5, 10.5));
    const auto x = logspace(0.1, 30.0, 120);
    out.plots = {{"A facing disk against a point",
                  "Per luminance, the disk of radius 1.",
                  {"distance over radius", 0.1, 30.0, Scale::logarithmic},
                  {"illuminance per luminance, sr", 1e-3, 300.0, Scale::logarithmic},
                  {curve("disk", x, facing_disk), curve("inverse square", x, point, Stroke::dashed)}},
                 {"Relative error of the inverse square",
                  "",
                  {"distance over radius", 1.0, 30.0, Scale::logarithmic},
                  {"relative error", 1e-3, 1.0, Scale::logarithmic},
                  {curve("point against disk", logspace(1.0, 30.0, 60),
                         [](double d) { return point(d) / facing_disk(d) - 1.0; })}}};
    out.text = "The inverse square is within 1 % of a facing disk from " + number(within_1_percent, 3) +
               " radii on: five times its diameter, as printed (the error is the square of radius over "
               "distance). At an "
               "angle and for rectangles and tubes the rule holds to 3 %.";
    return out;
}

}  // namespace

Experiment frostbite_figure44() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 44", "Five times rule",
            "A facing disk against a point of the same luminous power over distance, and the rule for all "
            "four shapes.",
            run};
}

}  // namespace candela::measure::experiments
