#include <glm/geometric.hpp>

#include "candela/measure/area_truth.hpp"
#include "candela/measure/lit_scene.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/lights/tube.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;
using glm::dvec3;

/// A wall of light on the left, from under the floor to over the balls. right x up is -x, away from where it
/// shines.
const RectangleLight kLight{dvec3(-3.2, 0.6, 1.0), dvec3(0.0, -1.0, 0.0), dvec3(0.0, 0.0, 1.0), 1.6, 1.4};

RectangleLight seen_from(const dvec3& position) {
    RectangleLight l = kLight;
    l.center -= position;
    return l;
}

using Technique = float (*)(vec3, vec3, vec3, vec3, float, float);

Illuminance by(Technique f) {
    return [f](const dvec3& n, const dvec3& position) {
        const RectangleLight l = seen_from(position);
        return double(
            f(vec3(n), vec3(l.center), vec3(l.right), vec3(l.up), float(l.half_width), float(l.half_height)));
    };
}

Findings run() {
    LitScene scene;
    scene.lamp = [](const dvec3& origin, const dvec3& direction) {
        return ray_to_rectangle(origin, direction, kLight.center, kLight.right * kLight.half_width,
                                kLight.up * kLight.half_height);
    };
    Findings out;
    add_lit_figure(
        out, scene, "A large rectangle that crosses the horizon",
        {{"form factor, no horizon", by(rectangle_projected_solid_angle_arvo), 0.06},
         {"simplified MRP, wrong intensity of the wrap", by(rectangle_projected_solid_angle_simplified),
          0.31},
         {"exact", by(rectangle_projected_solid_angle), 1e-4}},
        [](const dvec3& n, const dvec3& position) { return illuminance_truth(n, seen_from(position), 4); },
        2.0);
    out.text =
        "The form factor without the horizon is right where all of the wall is above it and wrong on the "
        "balls, whose dark "
        "side it cuts off hard, and on the floor, from which the buried part is taken off. The "
        "representative point with the "
        "solid angle of the whole wraps, far too bright. Clipping at the horizon is the truth, for the price "
        "of structured "
        "sampling.";
    return out;
}

}  // namespace

Experiment frostbite_figure33() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 33",
            "What the horizon does to a large rectangle",
            "Floor and balls under a rectangle that reaches below the floor: without the horizon, with it at "
            "the wrong "
            "intensity, and right.",
            run};
}

}  // namespace candela::measure::experiments
