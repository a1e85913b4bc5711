#pragma once

#include <cstdint>
#include <vector>

#include "candela/bake/filter_environment.hpp"
#include "candela/bake/filter_reference.hpp"

namespace candela::measure {

/// How far a level of a filtered environment is from the integral, in luminance.
struct LevelError {
    std::uint32_t size = 0;
    float alpha = 0.0f;
    double rmse = 0.0;          ///< by the root of the mean square of the truth
    double largest = 0.0;       ///< |error| / truth
    double energy_ratio = 0.0;  ///< of the level to the source
};

/// Truths at the centres of some texels of each level but the mirror's.
struct FilterTruth {
    struct Place {
        std::uint32_t face, x, y;
        double luminance_nit;
    };
    std::vector<std::vector<Place>> levels;
    double energy = 0.0;  ///< of the source, luminance times solid angle
};

[[nodiscard]] FilterTruth filter_truth(const scene::Environment& environment, std::uint32_t size,
                                       scene::RoughnessMapping mapping, std::uint32_t texels_a_level);

/// One entry for each level but the first.
[[nodiscard]] std::vector<LevelError> filter_errors(const FilterTruth& truth,
                                                    const scene::FilteredEnvironment& filtered);

/// A dim blue sky over ground with one texel of 1.6e9 cd/m^2, as bright as the sun's disc.
[[nodiscard]] scene::Environment one_texel_sun_environment(std::uint32_t width);

}  // namespace candela::measure
