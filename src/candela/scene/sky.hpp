#pragma once

#include <array>

namespace candela::scene {

/// A clear sky over flat ground at sea level. North is -Z and east +X, so that azimuth 0 is the middle of an
/// environment picture.
struct SkySettings {
    float elevation_deg = 40.0f;  ///< of the sun's centre above the level; negative: below it
    float azimuth_deg = 225.0f;   ///< of the sun, from north through east
    float turbidity = 2.5f;       ///< 1: no aerosol, 2: very clear, 3: clear, 6: hazy (Preetham et al. 1999)
    float ground_albedo = 0.2f;
    float altitude_m = 0.0f;  ///< of who looks, above the ground
    float ozone_du = 300.0f;  ///< Dobson units
};

/// A setting as users name it: on the command line without, in stage files with its unit.
struct SkySetting {
    const char* option;
    const char* key;
    float SkySettings::*value;
    double low;
    double high;
    const char* range;
};

inline constexpr std::array<SkySetting, 6> kSkySettings{{
    {"elevation", "elevation_deg", &SkySettings::elevation_deg, -90.0, 90.0, "-90 to 90 degrees"},
    {"azimuth", "azimuth_deg", &SkySettings::azimuth_deg, -360.0, 360.0, "-360 to 360 degrees"},
    {"turbidity", "turbidity", &SkySettings::turbidity, 1.0, 10.0, "1 to 10"},
    {"albedo", "albedo", &SkySettings::ground_albedo, 0.0, 1.0, "0 to 1"},
    {"altitude", "altitude_m", &SkySettings::altitude_m, 0.0, 99000.0, "0 to 99,000 m"},
    {"ozone", "ozone_du", &SkySettings::ozone_du, 0.0, 1000.0, "0 to 1000 Dobson units"},
}};

}  // namespace candela::scene
