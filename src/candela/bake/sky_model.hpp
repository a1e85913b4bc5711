#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "candela/scene/sky.hpp"
#include "shading/sky/scattering.glsl"

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

/// Scatterings by aerosol one after the other that are told apart (shading::forward_shares); the last is all
/// further ones.
inline constexpr int kForwardOrders = 4;

/// What comes along a ray of sky, apart from the phase functions, which are the same all along it: shares of
/// sunlight, 1/sr, or of all bands together linear Rec.709 in cd/m^2.
template <class T>
struct SkyRay {
    T air;                                  ///< scattered by air: times rayleigh_phase
    std::array<T, kForwardOrders> aerosol;  ///< by aerosol so many times in a row: times forward_phase
    T rest;                                 ///< all other
};

/// The sum of a ray's parts; `cosine`: between ray and sun.
[[nodiscard]] glm::vec3 radiance_of(const SkyRay<glm::vec3>& light, float cosine);

/// The sky over one place at one position of the sun, spectrally (shading/sky). Light scattered once is
/// integrated along each ray; two orders are integrated over all directions, with their mean and its first
/// moment; the following ones are Hillaire's closure.
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

    /// Means over all directions of radiance by sunlight's irradiance, 1/sr.
    struct Moments {
        shading::SkyBands mean;
        shading::SkyBands up;       ///< times the cosine between the way to look and up
        shading::SkyBands sunward;  ///< ... and level towards the sun
    };
    /// Light of some orders of scattering over altitude and the sun's angle from the zenith there; and what
    /// it gives to level ground.
    struct Scattered {
        SkyTable<Moments> moments;
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
        float cosine;             ///< between ray and sun
        bool ground;              ///< ends there, or misses it
        bool sunlit;              ///< with light scattered or reflected once
        const Scattered* source;  ///< and with what this scatters again; may be null
        int steps;
        bool eye;  ///< ends there: by the phase functions of its last scatterings; else for a mean
    };
    /// What is scattered at a point of a ray by air, evenly, and what aerosol adds by its asymmetry.
    struct Source {
        shading::SkyBands even;
        shading::SkyBands directed;
    };
    [[nodiscard]] float narrowed_depth(int band, const glm::vec3& columns_m) const {
        const auto b = static_cast<std::size_t>(band);
        return shading::sky_optical_depth(air_.air_scattering.of[b], air_.narrowed_extinction.of[b],
                                          air_.ozone_absorption.of[b], columns_m);
    }
    [[nodiscard]] Source source_at(const March& m, float distance_m, float altitude_m, float sun_mu) const;
    [[nodiscard]] SkyRay<shading::SkyBands> march(const March& m) const;
    void add_forward(const shading::SkyBands& scattered, float aerosol_m,
                     SkyRay<shading::SkyBands>& out) const;
    void add_ground(const March& m, float distance_m, const shading::SkyBands& transmittance,
                    SkyRay<shading::SkyBands>& out) const;
    void gather_at(const Scattered* source, int column, int row, Scattered& out) const;
    [[nodiscard]] Scattered gather(const Scattered* source, int columns) const;
    [[nodiscard]] Scattered scatter() const;

    shading::SkyAtmosphere air_;
    float eye_m_;
    float sun_angle_rad_;  ///< from the zenith
    float sun_mu_;
    Scattered scattered_;
};

}  // namespace candela::bake
