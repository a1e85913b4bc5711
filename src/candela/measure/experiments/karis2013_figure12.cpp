#include "candela/measure/karis_spheres.hpp"

namespace candela::measure::experiments {
namespace {

Findings run() {
    Findings out;
    add_specular_figure(out, "Sphere light", karis_spheres_under_sphere(),
                        {"representative point", "transformed cosine"}, {0.06, 0.017});
    out.text =
        "The representative point has the light's sharp image, and around it a lobe that is too bright and "
        "too wide where the light is "
        "large: the normalization is that of the peak. The transformed cosine is beside it for scale.";
    return out;
}

}  // namespace

Experiment karis2013_figure12() {
    return {"Karis 2013", "Figure 12", "A sphere light by the representative point",
            "Metal spheres, alpha 0.02, 0.05, 0.1, 0.25 and 0.5 from left to right, under a sphere light: "
            "equations 11 and 14, and "
            "linearly transformed cosines, above the sampled integral.",
            run};
}

}  // namespace candela::measure::experiments
