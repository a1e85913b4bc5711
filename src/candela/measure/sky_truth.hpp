#pragma once

#include <cstdint>

#include "candela/bake/sky_model.hpp"

/// The light of a clear sky by random walks against the light: every order of scattering with its phase
/// functions, over the round earth, by the same coefficients as bake::SkyModel.
namespace candela::measure {

struct SkyEstimate {
    double value = 0.0;
    double standard_error = 0.0;
};

/// Luminance in cd/m^2 in a direction by elevation and azimuth from the sun's.
[[nodiscard]] SkyEstimate sky_luminance_truth(const bake::SkyModel& model, double elevation_rad,
                                              double azimuth_rad, int walks, std::uint64_t seed);

/// Illuminance in lx of level ground by the sky without the sun.
[[nodiscard]] SkyEstimate sky_illuminance_truth(const bake::SkyModel& model, int walks, std::uint64_t seed);

}  // namespace candela::measure
