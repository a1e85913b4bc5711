#include "candela/measure/karis_spheres.hpp"

namespace candela::measure::experiments {
namespace {

Findings run() {
    Findings out;
    add_specular_figure(out, "Sphere light", karis_spheres_under_sphere(), {"specular D modification"},
                        {0.09});
    out.text =
        "As printed: the widened lobe turns the glossy spheres rough, and the light's round image is lost at "
        "grazing angles.";
    return out;
}

}  // namespace

Experiment karis2013_figure10() {
    return {"Karis 2013", "Figure 10", "A sphere light by widening the lobe",
            "Metal spheres, alpha 0.02, 0.05, 0.1, 0.25 and 0.5 from left to right, under a sphere light: "
            "the specular D "
            "modification (equation 10) above the sampled integral.",
            run};
}

}  // namespace candela::measure::experiments
