#include "candela/measure/karis_spheres.hpp"

namespace candela::measure::experiments {
namespace {

Findings run() {
    Findings out;
    add_specular_figure(out, "Tube light", karis_spheres_under_tube(),
                        {"representative point", "transformed cosine"}, {0.05, 0.012});
    out.text =
        "Line and sphere in turn, each with its normalization, make a tube, as printed; how long its image "
        "is on rough metal is what the "
        "representative point gets least right.";
    return out;
}

}  // namespace

Experiment karis2013_figure13() {
    return {"Karis 2013", "Figure 13", "A tube light by the representative point",
            "Metal spheres, alpha 0.02, 0.05, 0.1, 0.25 and 0.5 from left to right, under a tube light: "
            "equations 11, 14, 19 and 20, and "
            "linearly transformed cosines, above the sampled integral.",
            run};
}

}  // namespace candela::measure::experiments
