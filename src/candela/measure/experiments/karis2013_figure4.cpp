#include "candela/measure/split_sum.hpp"

namespace candela::measure::experiments {

Experiment karis2013_figure4() {
    return {
        "Karis 2013", "Figure 4", "The split sum on metal spheres",
        "Spheres under a generated high-dynamic-range environment: the integral by importance sampling, the "
        "split sum, and the split "
        "sum with n = v; their errors over roughness.",
        [] {
            return split_sum_figure({glm::vec3(0.95f, 0.93f, 0.88f),
                                     1.0f,
                                     "metal",
                                     {.printed_mean = 0.095,
                                      .weighted_mean = 0.08,
                                      .isotropic_mean = 0.14,
                                      .weighted_over_printed = 0.8},
                                     "The weight helps metal, as the paper says of it."});
        }};
}

}  // namespace candela::measure::experiments
