#pragma once

#include <functional>
#include <string>
#include <vector>

#include "candela/measure/dfg_lookup.hpp"
#include "candela/measure/image_light.hpp"

/// What the profile slots `reflection` and `dfg` choose from, on perfectly prefiltered light, and their
/// truth.
namespace candela::measure {

/// A grey surface of this f0, f90 = 1, single scattering.
struct GlossySurface {
    float f0 = 1.0f;
    float perceptual_roughness = 0.5f;
    int prefilter_samples = 512;  ///< of each read; pictures do with fewer
};

struct ReflectionTechnique {
    std::string name;      ///< in plots and tables
    std::string function;  ///< in shading/
    std::string source;
    /// Light reflected towards the viewer.
    std::function<glm::vec3(const ImageLight&, const ReceiverFrame&, float NoV, const GlossySurface&)>
        reflected;
    std::function<double()> cost_ns;
};

/// Those that differ in where they read, with the DFG table: mirror direction first.
[[nodiscard]] std::vector<ReflectionTechnique> direction_techniques();
/// Those that differ in the second factor, with the mirror direction.
[[nodiscard]] std::vector<ReflectionTechnique> reflectance_techniques();

/// The integral of L D V F n.l with height-correlated Smith.
[[nodiscard]] glm::vec3 reflected_truth(const ImageLight& light, const ReceiverFrame& frame,
                                        const GlossySurface& surface, int samples);

}  // namespace candela::measure
