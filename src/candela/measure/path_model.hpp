#pragma once

#include "candela/realtime/profile.hpp"
#include "candela/truth/path_integrator.hpp"

namespace candela::measure {

/// Gives the path tracer what of a profile is its model: the BSDF, which materials are fully rough, and how
/// lights without extent fade. The profile's other techniques approximate integrals, which the path tracer
/// has as they are.
inline void set_model(const realtime::Profile& profile, truth::PathOptions& options) {
    options.techniques = {static_cast<int>(profile.diffuse), static_cast<int>(profile.visibility),
                          static_cast<int>(profile.fresnel), static_cast<int>(profile.energy)};
    options.fully_rough = profile.fully_rough;
    options.falloff = {static_cast<int>(profile.falloff), profile.falloff_offset_m2};
}

}  // namespace candela::measure
