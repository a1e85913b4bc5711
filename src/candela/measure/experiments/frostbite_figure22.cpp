#include <glm/geometric.hpp>

#include "candela/measure/area_truth.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/lights/units.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;
using glm::dvec3;

constexpr double kPower_lm = 1000.0;
const dvec3 kUp(0.0, 0.0, 1.0);

double point_lx(double d) {
    return double(lx_from_cd(point_cd_from_lm(float(kPower_lm)), float(d)));
}
double sphere_lx(double d) {
    return double(sphere_nit_from_lm(float(kPower_lm), 0.2f)) *
           illuminance_truth(kUp, SphereLight{d * kUp, 0.2});
}
double disk_lx(double d) {
    return double(disk_nit_from_lm(float(kPower_lm), 0.2f)) *
           illuminance_truth(kUp, DiskLight{d * kUp, -kUp, 0.2});
}
double tube_lx(double d) {
    const TubeLight tube{d * kUp, dvec3(1.0, 0.0, 0.0), 1.0, 0.02};
    return double(tube_nit_from_lm(float(kPower_lm), 0.02f, 2.0f)) * illuminance_truth(kUp, tube);
}

Findings run() {
    ErrorStatistics point;
    ErrorStatistics sphere;
    for (const double d : logspace(0.25, 20.0, 40)) {
        point.add(point_lx(d) * 4.0 * kPi * d * d / kPower_lm - 1.0);
        sphere.add(sphere_lx(d) / point_lx(d) - 1.0);
    }
    // What the tube's own inverse square, from far away, would be close by.
    const double tube_near = tube_lx(0.25) * 0.25 * 0.25 / (tube_lx(40.0) * 40.0 * 40.0);
    const double disk_near = disk_lx(0.25) * 0.25 * 0.25 / (disk_lx(40.0) * 40.0 * 40.0);
    const auto x = logspace(0.22, 20.0, 120);
    Findings out;
    out.text =
        "The flux through every sphere about a point light is its power. A sphere light obeys the inverse "
        "square "
        "from its centre at every distance, to the last digit; a disk 0.4 m wide gives at 0.25 m " +
        number(100.0 * disk_near, 3) + " % and a tube 2 m long " + number(100.0 * tube_near, 3) +
        " % of what their own inverse square from afar would say. The law is one of points, as the paper "
        "says.";
    out.measured = {at_most("point: flux through spheres over the power, largest error", point.max(), 1e-5),
                    at_most("sphere of 0.2 m against the point, largest relative error", sphere.max(), 1e-5),
                    within("disk at 0.25 m over its inverse square", disk_near, 0.55, 0.66),
                    within("tube at 0.25 m over its inverse square", tube_near, 0.1, 0.25)};
    out.plots = {{"Illuminance of 1000 lm, facing the light",
                  "",
                  {"distance from the centre, m", 0.2, 20.0, Scale::logarithmic},
                  {"illuminance, lx", 0.1, 1e4, Scale::logarithmic},
                  {curve("point", x, point_lx), curve("sphere, radius 0.2 m", x, sphere_lx, Stroke::dotted),
                   curve("disk, radius 0.2 m", x, disk_lx, Stroke::dashed),
                   curve("tube, 2 m", x, tube_lx, Stroke::dashed)}}};
    return out;
}

}  // namespace

Experiment frostbite_figure22() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 22", "Inverse square law",
            "Flux through spheres about a point light, and where lights with a size leave the law.", run};
}

}  // namespace candela::measure::experiments
