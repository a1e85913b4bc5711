#include <glm/geometric.hpp>

#include "candela/measure/lit_rectangle.hpp"
#include "shading/lights/tube.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;
using glm::dvec3;

/// Behind the balls, it shines towards the viewer: right x up is y, away from him.
const LitRectangle kLight{{dvec3(0.0, 1.6, 0.7), dvec3(-1.0, 0.0, 0.0), dvec3(0.0, 0.0, 1.0), 1.0, 0.6}};

void add(Findings& out, const LitScene& scene, const std::string& title, double structured, double exact) {
    add_lit_figure(
        out, scene, title,
        {{"structured sampling", kLight.by(rectangle_projected_solid_angle_structured), structured},
         {"exact", kLight.by(rectangle_projected_solid_angle), exact}},
        kLight.truth(), 0.4);
}

Findings run() {
    const LitScene scene = kLight.scene();
    Findings out;
    add(out, scene, "Rectangle", 0.03, 1e-4);
    LitScene close = scene;
    close.target = dvec3(1.45, 0.3, 0.5);
    close.field_of_view_rad = 0.22;
    add(out, close, "Closer", 0.075, 1e-4);
    out.text =
        "Where corners of the light set, the five points of structured sampling take the light away in "
        "steps: on the "
        "balls' dark sides, barely visible, as printed. The level close to the light is off, too. Clipping "
        "is the truth "
        "at the same cost.";
    return out;
}

}  // namespace

Experiment frostbite_figure41() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 41", "Structured sampling of a rectangle",
            "Floor and balls under a rectangle by the paper's five points, by clipping, and by quadrature; "
            "and closer.",
            run};
}

}  // namespace candela::measure::experiments
