#pragma once

#include <cstdint>

#include "candela/scene/cube_map.hpp"
#include "candela/scene/progress.hpp"
#include "candela/scene/scene.hpp"

namespace candela::bake {

/// How the LD term of a level is found.
enum class FilterTechnique : std::uint8_t {
    harmonic,             ///< the lobe as a convolution in spherical harmonics; peaks of light exactly
    filtered_importance,  ///< Krivanek & Colbert 2008 as in Frostbite, listing 19
    ggx_importance,       ///< Karis 2013: samples of GGX, each one texel of the source
    cosine_power,         ///< a cosine lobe for GGX's, summed over all texels in it
};

/// What a texel of a filtered level holds.
enum class TexelValue : std::uint8_t {
    mean,   ///< the mean over its solid angle: a level has the energy of the source
    center  ///< the value in the direction of its centre; `harmonic` alone knows another
};

struct FilterOptions {
    std::uint32_t size = 256;  ///< texels a side of the finest level, a power of two
    std::uint32_t levels = 0;  ///< 0: down to one texel a side
    scene::RoughnessMapping mapping = scene::RoughnessMapping::linear;
    FilterTechnique technique = FilterTechnique::harmonic;
    TexelValue texel = TexelValue::mean;
    std::uint32_t sample_count = 0;  ///< a texel, where the technique draws; 0: as its authors do
    std::uint32_t irradiance_size = 32;
    ProgressFunction progress;  ///< by texels that are done
};

/// Name on the command line, and back; throws Error (Fault::usage) for a name that is none.
[[nodiscard]] const char* filter_technique_name(FilterTechnique technique);
[[nodiscard]] FilterTechnique filter_technique(const char* name);

/// Filters an environment for glossy and matt surfaces, its scale and rotation applied: directions are the
/// world's. Level 0 is the mirror's: the mean of the source in each texel. Units are such that no value is
/// beyond the range of a half float.
[[nodiscard]] scene::FilteredEnvironment filter_environment(const scene::Environment& environment,
                                                            const FilterOptions& options = {});

}  // namespace candela::bake
