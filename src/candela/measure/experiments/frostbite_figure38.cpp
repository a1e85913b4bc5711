#include <glm/geometric.hpp>

#include "candela/measure/area_truth.hpp"
#include "candela/measure/lit_scene.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/lights/tube.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;
using glm::dvec3;

/// Low over the floor, turned to the right and down.
const DiskLight kLight{dvec3(-0.5, 0.8, 0.75), glm::normalize(dvec3(0.6, -0.7, -0.4)), 0.7};

DiskLight seen_from(const dvec3& position) {
    DiskLight l = kLight;
    l.center -= position;
    return l;
}

Illuminance by(float (*f)(vec3, vec3, vec3, float)) {
    return [f](const dvec3& n, const dvec3& position) {
        const DiskLight l = seen_from(position);
        return double(f(vec3(n), vec3(l.center), vec3(l.direction), float(l.radius)));
    };
}

Findings run() {
    LitScene scene;
    scene.lamp = [](const dvec3& origin, const dvec3& direction) {
        return ray_to_disk(origin, direction, kLight.center, kLight.direction, kLight.radius);
    };
    Findings out;
    add_lit_figure(
        out, scene, "Disk",
        {{"without horizon", by(disk_projected_solid_angle_no_horizon), 0.055},
         {"facing disk times cosine", by(disk_projected_solid_angle_frostbite), 0.055},
         {"exact", by(disk_projected_solid_angle), 1e-4}},
        [](const dvec3& n, const dvec3& position) { return illuminance_truth(n, seen_from(position), 3); },
        0.9);
    out.text =
        "The paper's relations for a disk that faces the receiver, times the cosine at the light, are as far "
        "off as the form "
        "without the horizon: close to a tilted disk the error is in the orientation (Table E.1). By the "
        "disk's ellipse the "
        "picture is the truth.";
    return out;
}

}  // namespace

Experiment frostbite_figure38() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 38", "Disk light with the horizon",
            "Floor and balls under a tilted disk: without the horizon, by the paper's relations for a facing "
            "disk times the "
            "cosine at the light, by the disk's ellipse, and by quadrature.",
            run};
}

}  // namespace candela::measure::experiments
