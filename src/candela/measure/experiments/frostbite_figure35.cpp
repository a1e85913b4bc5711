#include <glm/geometric.hpp>

#include "candela/measure/area_truth.hpp"
#include "candela/measure/lit_scene.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/lights/tube.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;
using glm::dvec3;

const SphereLight kLight{dvec3(0.0, 0.4, 0.75), 0.6};

SphereLight seen_from(const dvec3& position) {
    return {kLight.center - position, kLight.radius};
}

Illuminance by(float (*f)(vec3, vec3, float)) {
    return [f](const dvec3& n, const dvec3& position) {
        const SphereLight l = seen_from(position);
        return double(f(vec3(n), vec3(l.center), float(l.radius)));
    };
}

Findings run() {
    LitScene scene;
    scene.lamp = [](const dvec3& origin, const dvec3& direction) {
        return ray_to_sphere(origin, direction, kLight.center, kLight.radius);
    };
    Findings out;
    add_lit_figure(
        out, scene, "Sphere",
        {{"without horizon", by(sphere_projected_solid_angle_no_horizon), 0.004},
         {"exact", by(sphere_projected_solid_angle), 1e-4}},
        [](const dvec3& n, const dvec3& position) { return illuminance_truth(n, seen_from(position), 2); },
        1.2);
    out.text =
        "The relations with the horizon match the quadrature to the last bit of the picture, as printed. "
        "Without the horizon "
        "the balls' terminators are wrong by little: half of the lamp is missing there.";
    return out;
}

}  // namespace

Experiment frostbite_figure35() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 35", "Sphere light with the horizon",
            "Floor and balls under a sphere, without the horizon, with it, and by quadrature.", run};
}

}  // namespace candela::measure::experiments
