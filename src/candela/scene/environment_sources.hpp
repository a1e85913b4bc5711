#pragma once

#include <optional>
#include <vector>

#include "candela/scene/environment_resample.hpp"
#include "candela/scene/light.hpp"
#include "candela/scene/scene.hpp"

/// What is in an environment, and the bright small things in it: the sun and lamps. All with the
/// environment's scale; directions are those of the world, with its rotation.
namespace candela::scene {

/// Something small that is far brighter than what surrounds it.
struct EnvironmentSource {
    glm::vec3 direction{0.0f};  ///< unit, towards it: the mean over its light
    /// Of the disc of its peak's luminance that gives the same light: exact for one of uniform luminance,
    /// and for one texel.
    double solid_angle_sr = 0.0;
    /// What it adds to the light behind it: lx at normal incidence, per Rec.709 channel.
    glm::dvec3 illuminance_lx{0.0};
    double contrast = 0.0;  ///< its peak over the median about it; infinite before black
    std::vector<std::uint32_t> texels;

    [[nodiscard]] double half_angle_rad() const noexcept;
};

struct SourceLimits {
    double contrast = 25.0;
    double half_angle_rad = 0.0872665;  ///< 5 degrees: what is larger is a panel or a window, and stays
    std::size_t max_sources = 16;
    int max_rejected = 64;        ///< bright things that are no source, before the search ends
    double min_fraction = 0.005;  ///< of the lx at normal incidence from everywhere
};

/// The brightest first, by lx at normal incidence.
[[nodiscard]] std::vector<EnvironmentSource> find_sources(const Environment& environment,
                                                          const SourceLimits& limits = {});

/// A source like the sun: its disc within a degree of its middle (or four texels, where those are larger),
/// and more than 20 % of what it and the upper half of the rest give at best: E / (E + rest) with E at normal
/// incidence and the rest's illuminance facing up. The brightest, if there is one.
[[nodiscard]] std::optional<EnvironmentSource> find_sun(const Environment& environment);

/// Takes sources out of the picture: their texels become what surrounds them. The lights hold what was taken,
/// as suns of their solid angle (all are infinitely far), so that the light of everything stays the same.
[[nodiscard]] std::vector<Light> take_out(Environment& environment,
                                          const std::vector<EnvironmentSource>& sources);

/// Moves a sun of the scene's environment to its lights, so that it casts a shadow. True when there was one.
bool split_sun(Scene& scene);

/// Illuminance in lx on a horizontal plane that sees the upper half of the environment.
[[nodiscard]] double upward_illuminance_lx(const Environment& environment);

/// Mean luminance over all directions, in cd/m^2 per Rec.709 channel. Texels that are not finite count as 0.
[[nodiscard]] glm::dvec3 mean_nit(const Environment& environment);

struct EnvironmentStatistics {
    double upward_lx = 0.0;
    double downward_lx = 0.0;
    glm::dvec3 mean_nit{0.0};  ///< over all directions, per Rec.709 channel
    double mean_luminance_nit = 0.0;
    std::vector<double> percentiles_nit;  ///< at kPercentiles, by solid angle
    double peak_nit = 0.0;                ///< luminance of the brightest texel
    double peak_solid_angle_sr = 0.0;     ///< of the texels about it that have half of it
    glm::vec3 peak_direction{0.0f};
};
inline constexpr double kPercentiles[] = {1.0, 10.0, 50.0, 90.0, 99.0, 99.9};

[[nodiscard]] EnvironmentStatistics statistics_of(const Environment& environment);

}  // namespace candela::scene
