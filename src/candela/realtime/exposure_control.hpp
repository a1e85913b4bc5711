#pragma once

#include "candela/realtime/profile.hpp"
#include "candela/scene/scene.hpp"

namespace candela::realtime {

/// EV100 of an exposure that is not automatic, without its compensation.
[[nodiscard]] float manual_ev100(const scene::Exposure& exposure);

/// The factor from cd/m^2 to exposed values, 1 = white: by the profile's slot `exposure`.
[[nodiscard]] float exposure_at(float ev100, ExposureTechnique technique);
/// Its inverse.
[[nodiscard]] float ev100_at(float exposure, ExposureTechnique technique);

/// Illuminance in lx somewhere in the middle of `bounds`, within a few stops, by the scene's lights and its
/// environment (the mean over all directions); emissive surfaces are not counted.
[[nodiscard]] float typical_illuminance_lx(const scene::Scene& scene, const scene::Aabb& bounds);

/// What the lights of a scene promise before anything is drawn.
struct LightEstimate {
    float typical_nit = 0.0f;  ///< a grey card somewhere in the scene, within a few stops
    float peak_nit = 0.0f;     ///< the brightest thing that can be seen directly; 0 = nothing known
};
[[nodiscard]] LightEstimate estimate_light(const scene::Scene& scene);

}  // namespace candela::realtime
