#include "candela/measure/specular_figure.hpp"

namespace candela::measure::experiments {
namespace {

std::vector<SphereColumn> columns(LightShape shape) {
    std::vector<SphereColumn> out;
    for (const float alpha : {0.02f, 0.05f, 0.1f, 0.25f, 0.5f}) {
        ShapedLight light = light_towards_spheres(shape, {-1.0f, 1.6f, 1.8f});
        light.radius = shape == LightShape::tube ? 0.12f : 0.7f;
        light.half_width = shape == LightShape::tube ? 1.2f : 0.9f;
        light.half_height = 0.5f;
        out.push_back({light, alpha});
    }
    return out;
}

Findings run() {
    Findings out;
    const std::string round = "dominant direction";
    const std::string flat = "dominant direction, not normalized";
    add_specular_figure(out, "Sphere", columns(LightShape::sphere), {round, "transformed cosine"},
                        {0.06, 0.018});
    add_specular_figure(out, "Tube", columns(LightShape::tube), {round, "transformed cosine"},
                        {0.035, 0.011});
    add_specular_figure(out, "Disk", columns(LightShape::disk), {flat, "transformed cosine"}, {0.1, 0.017});
    add_specular_figure(out, "Rectangle", columns(LightShape::rectangle), {flat, "transformed cosine"},
                        {0.12, 0.018});
    out.text =
        "Frostbite's lights: Karis's approach with the lobe's dominant direction; disk and rectangle without "
        "a normalization, as "
        "none was found. Those two are too bright wherever the metal is not rough.";
    return out;
}

}  // namespace

Experiment frostbite_figure47() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 47",
            "The reflection of all types of area light",
            "Metal spheres, alpha 0.02, 0.05, 0.1, 0.25 and 0.5 from left to right, under sphere, tube, disk "
            "and rectangle: Frostbite's "
            "technique (section 4.7.5) and linearly transformed cosines above the sampled integral.",
            run};
}

}  // namespace candela::measure::experiments
