#pragma once

#include <cstddef>
#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::bake {

/// Probabilities of an environment's cells, in proportion to the light that each sends: the table behind
/// shading/environment_sampling.glsl. Rotation and scale of the environment do not matter. A cell is a texel
/// of a picture of this size, which is the environment's own or a smaller one.
struct EnvironmentDistribution {
    int width = 0;
    int height = 0;
    std::vector<float> row_cdf;     ///< height + 1, from 0 to 1
    std::vector<float> column_cdf;  ///< height rows of width + 1, each from 0 to 1
};

/// How the weights of texels are made of their light.
struct EnvironmentWeights {
    /// A part in [0,1] that goes to all directions alike, so that what the table underestimates still has a
    /// bounded weight.
    float uniform = 0.0f;
    /// Leaves what is no brighter than the mean to the draws from the material, which find it anyway: MIS
    /// compensation, Karlik et al. 2019. Needs a second way of drawing.
    bool compensated = false;
    /// At most this many cells: a larger environment has several texels to a cell, with the sum of their
    /// light. At the default the table takes 32 MiB, a quarter of the least that a storage buffer holds
    /// (Vulkan 1.3, Required Limits: maxStorageBufferRange).
    std::size_t max_cells = std::size_t{1} << 23u;
};

/// Weights are luminance as bilinear reading sees it, integrated over each texel. An environment without
/// contrast is uniform altogether.
[[nodiscard]] EnvironmentDistribution environment_distribution(const scene::Environment& environment,
                                                               const EnvironmentWeights& weights = {});

}  // namespace candela::bake
