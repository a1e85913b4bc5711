#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "candela/scene/sky.hpp"
#include "shading/sky/atmosphere.glsl"

namespace candela::bake {

/// A grid of values between which one interpolates.
template <class T>
struct SkyTable {
    int width = 0;
    int height = 0;
    std::vector<T> values;
    [[nodiscard]] const T& at(int x, int y) const {
        return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
    [[nodiscard]] T& at(int x, int y) {
        return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
};

/// What comes along a ray of sky, apart from the phase functions of light scattered once, which are the same
/// all along it: shares of sunlight, 1/sr. Linear Rec.709 in cd/m^2 once weighted.
template <class T>
struct SkyRay {
    T air;      ///< scattered once, by air: times rayleigh_phase
    T aerosol;  ///< scattered once, by aerosol: times aerosol_phase
    T rest;     ///< scattered more often or reflected by the ground
};

/// The sky over one place at one position of the sun, spectrally (shading/sky). Light scattered once is
/// integrated along each ray; of what is scattered more often two orders are integrated over all directions,
/// the following ones by Hillaire's closure.
class SkyModel {
  public:
    explicit SkyModel(const scene::SkySettings& settings);

    [[nodiscard]] const shading::SkyAtmosphere& air() const noexcept { return air_; }
    [[nodiscard]] float eye_altitude_m() const noexcept { return eye_m_; }
    [[nodiscard]] float sun_mu() const noexcept { return sun_mu_; }

    /// Metres of air, aerosol and ozone of density 1 towards a direction that misses the ground.
    [[nodiscard]] glm::vec3 columns_m(float altitude_m, float mu) const;

    /// Sunlight at the eye at normal incidence, with the share of the disc that is above the horizon: lx.
    [[nodiscard]] glm::vec3 sun_rec709_lx() const;

    /// `cosine`: between ray and sun. Rays at the horizon are sky or ground as `ground` says.
    [[nodiscard]] SkyRay<glm::vec3> ray(float mu, float cosine, bool ground, int steps = 48) const;

    /// Luminance in cd/m^2 of sky or ground in a direction by elevation and azimuth from the sun's; channels
    /// can be negative.
    [[nodiscard]] glm::vec3 luminance_nit(float elevation_rad, float azimuth_rad) const;

    /// Mean over all directions of light of some orders of scattering, over altitude and the sun's angle from the
    /// zenith there; and what it gives to level ground.
    struct Scattered {
        SkyTable<shading::SkyBands> mean;      ///< radiance by sunlight's irradiance, 1/sr
        std::vector<shading::SkyBands> ground;  ///< irradiance by sunlight's
        float first_angle_rad = 0.0f;           ///< of the sun, in the first column
        float angle_step_rad = 0.0f;
    };

  private:
    /// A ray through the air and what of its light is asked for.
    struct March {
        float altitude_m;
        float mu;
        float sun_mu;
        float cosine;  ///< between ray and sun
        bool ground;   ///< ends there, or misses it
        bool sunlit;   ///< with light scattered or reflected once
        const Scattered* source;  ///< and with what this scatters again; may be null
        int steps;
        bool eye;
    };
    struct Narrowed { shading::SkyBands scattering; shading::SkyBands extinction; float asymmetry; };
    [[nodiscard]] SkyRay<shading::SkyBands> march(const March& m) const;
    void add_ground(const March& m, float distance_m, const shading::SkyBands& transmittance,
                    SkyRay<shading::SkyBands>& out) const;
    void gather_at(const Scattered* source, int column, int row, Scattered& out) const;
    [[nodiscard]] Scattered gather(const Scattered* source, int columns) const;
    [[nodiscard]] Scattered scatter() const;

    shading::SkyAtmosphere air_;
    Narrowed narrowed_;
    float eye_m_;
    float sun_angle_rad_;  ///< from the zenith
    float sun_mu_;
    SkyTable<glm::vec3> log_columns_;
    Scattered scattered_;
};

}  // namespace candela::bake
