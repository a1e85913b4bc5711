#pragma once

#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::bake {

/// Probabilities of an environment's texels, in proportion to the light that each sends: the table behind
/// shading/environment_sampling.glsl. Rotation and scale of the environment do not matter.
struct EnvironmentDistribution {
    int width = 0;
    int height = 0;
    std::vector<float> row_cdf;     ///< height + 1, from 0 to 1
    std::vector<float> column_cdf;  ///< height rows of width + 1, each from 0 to 1
};

/// Weights are luminance as bilinear reading sees it, integrated over each texel. A part of `uniform` in
/// [0,1] goes to all directions alike, so that what the table underestimates still has a bounded weight; a
/// black environment is uniform altogether.
[[nodiscard]] EnvironmentDistribution environment_distribution(const scene::Environment& environment,
                                                               float uniform = 0.0f);

}  // namespace candela::bake
