#include "candela/measure/split_sum.hpp"

namespace candela::measure::experiments {

Experiment karis2013_figure5() {
    return {"Karis 2013", "Figure 5", "The split sum on dielectric spheres",
            "As Figure 4 with F0 = 0.04, specular reflection only, pictures brightened eight times.", [] {
                return split_sum_figure({glm::vec3(0.04f),
                                         8.0f,
                                         "dielectric",
                                         {.printed_mean = 0.065,
                                          .weighted_mean = 0.1,
                                          .isotropic_mean = 0.18,
                                          .weighted_over_printed = 1.5},
                                         "On a dielectric, whose lobe Fresnel pulls to grazing directions, "
                                         "the weight makes it worse."});
            }};
}

}  // namespace candela::measure::experiments
