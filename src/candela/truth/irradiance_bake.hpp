#pragma once

#include <cstdint>
#include <functional>

#include "candela/truth/path_integrator.hpp"

namespace candela::truth {

struct IrradianceBakeOptions {
    PathOptions path;              ///< the material model; what only a picture needs is set by the bake
    std::uint32_t samples = 2048;  ///< paths of each probe
    std::uint32_t seed = 0;
    std::function<void(double fraction)> progress;  ///< from any thread, one at a time
};

/// Fills the probes of a scene's irradiance volumes by path tracing from where they stand, on every core.
/// What arrives straight from lights and emissive surfaces is left out: the frame finds it by itself. The
/// same bytes for any number of threads.
[[nodiscard]] std::vector<scene::IrradianceVolume> bake_irradiance(const scene::Scene& scene,
                                                                   const IrradianceBakeOptions& options);

/// A probe that sees more than this part of its surroundings from behind stands inside of something.
inline constexpr double kMostBackFaces = 0.25;

}  // namespace candela::truth
