#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "candela/measure/experiment.hpp"

namespace candela::measure {

/// Mean errors that must not be exceeded, relative to the mean of the reference.
struct SplitSumBounds {
    double printed_mean = 0.0;
    double weighted_mean = 0.0;
    double isotropic_mean = 0.0;
    double weighted_over_printed = 1.0;  ///< met within 0.05
};

struct SplitSumMaterial {
    glm::vec3 f0{1.0f};
    float display_scale = 1.0f;  ///< on pictures only
    std::string name;
    SplitSumBounds bounds;
    std::string weighting;  ///< what the weight by n.l does to it, a sentence
};

/// Karis 2013, Figures 4 and 5, for one material: reference, split sum as printed and weighted by n.l, split
/// sum with n = v.
[[nodiscard]] Findings split_sum_figure(const SplitSumMaterial& material);

}  // namespace candela::measure
