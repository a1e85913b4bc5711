#pragma once

#include <optional>
#include <string>
#include <vector>

#include "candela/measure/picture.hpp"

/// Where the difference of two pictures comes from, by the paths that light takes to the camera.
namespace candela::measure {

/// Luminance in cd/m^2 that adds up to the surfaces' light. Direct is from lights and emissive surfaces; the
/// rest is from the environment and by way of other surfaces, with its occlusion.
struct LightPaths {
    Picture direct_diffuse;
    Picture direct_specular;
    Picture indirect_diffuse;
    Picture indirect_specular;
    Picture emission;
    Picture unshadowed_direct;     ///< both direct ones, without shadows; empty: unknown
    Picture occluded_environment;  ///< the environment's light that occlusion takes away; empty: unknown
};

struct PathError {
    std::string path;                 ///< "direct diffuse"
    double reference_mean_nit = 0.0;  ///< of luminance, over the picture
    double picture_mean_nit = 0.0;
    double mean_absolute_nit = 0.0;  ///< of the difference of luminance
    double share = 0.0;  ///< of the sum of mean_absolute_nit over the paths; 0 for what is taken away
};

/// A row a path, then, where both sides know them, "shadows" and "occlusion": the direct and the
/// environment's light that they take away. Both are in the rows above too. Pixels that are not finite are
/// left out. Throws std::invalid_argument when the sizes differ.
[[nodiscard]] std::vector<PathError> split_error(const LightPaths& x, const LightPaths& r);

}  // namespace candela::measure
