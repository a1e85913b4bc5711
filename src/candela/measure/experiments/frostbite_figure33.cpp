#include <glm/geometric.hpp>

#include "candela/measure/lit_rectangle.hpp"
#include "shading/lights/tube.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;
using glm::dvec3;

/// A wall of light on the left, from under the floor to over the balls. right x up is -x, away from where it
/// shines.
const LitRectangle kLight{{dvec3(-3.2, 0.6, 1.0), dvec3(0.0, -1.0, 0.0), dvec3(0.0, 0.0, 1.0), 1.6, 1.4}};

Findings run() {
    const LitScene scene = kLight.scene();
    Findings out;
    add_lit_figure(out, scene, "A large rectangle that crosses the horizon",
                   {{"form factor, no horizon", kLight.by(rectangle_projected_solid_angle_arvo), 0.06},
                    {"simplified MRP, wrong intensity of the wrap",
                     kLight.by(rectangle_projected_solid_angle_simplified), 0.31},
                    {"exact", kLight.by(rectangle_projected_solid_angle), 1e-4}},
                   kLight.truth(), 2.0);
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
