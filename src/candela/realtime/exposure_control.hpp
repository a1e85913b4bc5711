#pragma once

#include "candela/scene/scene.hpp"

namespace candela::realtime {

/// Fractions of the metered pixels, from dark to bright, whose average the automatic exposure follows.
inline constexpr double kMeterLow = 0.10;
inline constexpr double kMeterHigh = 0.95;

/// EV100 of an exposure that is not automatic, without its compensation.
[[nodiscard]] float manual_ev100(const scene::Exposure& exposure);

/// What the lights of a scene promise before anything is drawn.
struct LightEstimate {
    float typical_nit = 0.0f;  ///< a grey card somewhere in the scene, within a few stops
    float peak_nit = 0.0f;     ///< the brightest thing that can be seen directly; 0 = nothing known
};
[[nodiscard]] LightEstimate estimate_light(const scene::Scene& scene);

}  // namespace candela::realtime
