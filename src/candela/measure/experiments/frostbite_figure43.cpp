#include <glm/geometric.hpp>

#include "candela/measure/area_truth.hpp"
#include "candela/measure/lit_scene.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/lights/tube.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;
using glm::dvec3;

const TubeLight kLight{dvec3(0.0, 0.7, 0.4), glm::normalize(dvec3(1.0, 0.25, 0.12)), 0.9, 0.18};

TubeLight seen_from(const dvec3& position) {
    TubeLight l = kLight;
    l.center -= position;
    return l;
}

Illuminance by(float (*f)(vec3, vec3, vec3, float, float)) {
    return [f](const dvec3& n, const dvec3& position) {
        const TubeLight l = seen_from(position);
        return double(f(vec3(n), vec3(l.center), vec3(l.axis), float(l.half_length), float(l.radius)));
    };
}

Findings run() {
    LitScene scene;
    scene.lamp = [](const dvec3& origin, const dvec3& direction) {
        return ray_to_capsule(origin, direction, kLight.center, kLight.axis, kLight.half_length,
                              kLight.radius);
    };
    Findings out;
    add_lit_figure(
        out, scene, "Tube",
        {{"rectangle plus sphere", by(tube_projected_solid_angle_frostbite), 0.028},
         {"exact", by(tube_projected_solid_angle), 1e-4}},
        [](const dvec3& n, const dvec3& position) { return illuminance_truth(n, seen_from(position), 3); },
        0.6);
    out.text =
        "The paper's facing rectangle plus a sphere at the nearest point comes close from far away and is "
        "too bright by the "
        "sphere close by; the capsule's outline is the truth.";
    return out;
}

}  // namespace

Experiment frostbite_figure43() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 43", "Tube light",
            "Floor and balls under a capsule: the paper's facing rectangle and sphere, the capsule's "
            "outline, and quadrature.",
            run};
}

}  // namespace candela::measure::experiments
