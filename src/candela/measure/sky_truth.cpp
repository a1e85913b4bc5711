#include "candela/measure/sky_truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace candela::measure {
namespace {

using namespace shading;
using glm::dvec3;

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadius = double(kEarthRadius_m);
constexpr int kRouletteFrom = 6;

using Random = std::mt19937_64;

double uniform(Random& random) {
    return (double(random() >> 11) + 0.5) * 0x1.0p-53;
}

/// Unit, with this cosine to `axis` and a random azimuth.
dvec3 around(const dvec3& axis, double cosine, Random& random) {
    const dvec3 other = std::abs(axis.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
    const dvec3 x = glm::normalize(glm::cross(other, axis));
    const dvec3 z = glm::cross(axis, x);
    const double a = 2.0 * kPi * uniform(random);
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    return glm::normalize(cosine * axis + sine * (std::cos(a) * x + std::sin(a) * z));
}

/// By the inverse of Henyey and Greenstein's distribution.
double aerosol_cosine(double u) {
    const double g = double(kAerosolAsymmetry);
    const double s = (1.0 - g * g) / (1.0 - g + 2.0 * g * u);
    return std::clamp((1.0 + g * g - s * s) / (2.0 * g), -1.0, 1.0);
}

/// By rejection: the phase function is at most twice its least.
double air_cosine(Random& random) {
    const double most = double(rayleigh_phase(1.0f));
    for (;;) {
        const double c = 2.0 * uniform(random) - 1.0;
        if (uniform(random) * most <= double(rayleigh_phase(float(c)))) return c;
    }
}

/// A walk of one band's light.
class Walk {
  public:
    Walk(const bake::SkyModel& model, const dvec3& to_sun, int band, Random& random)
        : model_(model), air_(model.air()), to_sun_(to_sun), band_(std::size_t(band)), random_(random) {}

    /// Share of sunlight, 1/sr, that comes against `d` to `p`.
    double radiance(dvec3 p, dvec3 d) {
        double sum = 0.0;
        double weight = 1.0;
        for (int event = 0; event < 1000; ++event) {
            const Arrival at = travel(p, d);
            if (at == Arrival::space) return sum;
            if (at == Arrival::ground) {
                const dvec3 n = glm::normalize(p);
                weight *= double(air_.ground_albedo);
                sum += weight / kPi * std::max(glm::dot(n, to_sun_), 0.0) * sun_at(0.0, glm::dot(n, to_sun_));
                d = around(n, std::sqrt(uniform(random_)), random_);
            } else {
                const double h = glm::length(p) - kRadius;
                const Share share = share_at(h);
                weight *= (share.air + share.aerosol) / share.all;
                const double aerosol = share.aerosol / (share.air + share.aerosol);
                const auto cosine = float(glm::dot(d, to_sun_));
                const double phase = (1.0 - aerosol) * double(rayleigh_phase(cosine)) +
                                     aerosol * double(aerosol_phase(cosine));
                sum += weight * phase * sun_at(h, glm::dot(glm::normalize(p), to_sun_));
                d = around(
                    d, uniform(random_) < aerosol ? aerosol_cosine(uniform(random_)) : air_cosine(random_),
                    random_);
            }
            if (event >= kRouletteFrom) {
                const double survive = std::min(weight, 0.9);
                if (uniform(random_) >= survive) return sum;
                weight /= survive;
            }
            if (!(weight > 0.0)) return sum;
        }
        return sum;
    }

  private:
    enum class Arrival { space, ground, air };
    struct Share {
        double air;
        double aerosol;
        double all;
    };

    Share share_at(double altitude_m) const {
        const vec3 density = sky_density(float(altitude_m));
        const double air = double(air_.air_scattering.of[band_] * density.x);
        const double aerosol = double(air_.aerosol_scattering.of[band_] * density.y);
        return {air, aerosol, double(extinction(density))};
    }

    double sun_at(double altitude_m, double sun_mu) const {
        const auto h = float(std::max(altitude_m, 0.0));
        const float visible = sun_visible_share(h, float(sun_mu));
        if (!(visible > 0.0f)) return 0.0;
        const vec3 columns = model_.columns_m(h, std::max(float(sun_mu), sky_horizon_mu(h)));
        return double(visible) * std::exp(-double(extinction(columns)));
    }
    float extinction(const vec3& columns) const {
        return sky_optical_depth(air_.air_scattering.of[band_], air_.aerosol_extinction.of[band_],
                                 air_.ozone_absorption.of[band_], columns);
    }

    /// To the next collision, by rejection against a bound of the extinction ahead (Woodcock et al. 1965).
    Arrival travel(dvec3& p, const dvec3& d) {
        for (;;) {
            const double r = glm::length(p);
            const double mu = glm::dot(p, d) / r;
            const double lowest =
                mu >= 0.0 ? r : std::max(r * std::sqrt(std::max(1.0 - mu * mu, 0.0)), kRadius);
            const double bound = bound_at(lowest - kRadius);
            const double step = -std::log(uniform(random_)) / bound;
            const double b = r * mu;
            const double to_ground = b * b - (r * r - kRadius * kRadius);
            if (mu < 0.0 && to_ground >= 0.0) {
                const double ground = -b - std::sqrt(to_ground);
                if (step >= ground) {
                    p = glm::normalize(p + std::max(ground, 0.0) * d) * kRadius;
                    return Arrival::ground;
                }
            }
            const dvec3 next = p + step * d;
            const double h = glm::length(next) - kRadius;
            if (h >= double(kAirTop_m) && glm::dot(next, d) >= 0.0) return Arrival::space;
            p = next;
            if (h < double(kAirTop_m) && uniform(random_) * bound < share_at(h).all) return Arrival::air;
        }
    }

    /// Extinction at this altitude with the most of ozone: air and aerosol only thin out above.
    double bound_at(double altitude_m) const {
        const Share share = share_at(altitude_m);
        const double ozone = altitude_m < 40000.0 ? double(air_.ozone_absorption.of[band_]) : 0.0;
        return std::max(share.all + ozone, 1.0e-8);
    }

    const bake::SkyModel& model_;
    const SkyAtmosphere& air_;
    dvec3 to_sun_;
    std::size_t band_;
    Random& random_;
};

/// Mean of walks that start at the eye in the directions that `towards` draws, times `factor`; bands are
/// drawn by their luminance.
template <class Towards>
SkyEstimate estimate(const bake::SkyModel& model, int walks, std::uint64_t seed, double factor,
                     Towards towards) {
    Random random(seed);
    std::array<double, std::size_t(kSkyBands)> below{};
    double all_lx = 0.0;
    for (int b = 0; b < kSkyBands; ++b)
        below[std::size_t(b)] = all_lx += double(luminance(model.air().rec709_lx[b]));
    const double mu = double(model.sun_mu());
    const dvec3 to_sun(0.0, mu, -std::sqrt(std::max(1.0 - mu * mu, 0.0)));
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < walks; ++i) {
        const double at = (double(i) + uniform(random)) / double(walks) * all_lx;
        const auto band = std::min(std::upper_bound(below.begin(), below.end(), at) - below.begin(),
                                   std::ptrdiff_t{kSkyBands - 1});
        Walk walk(model, to_sun, int(band), random);
        const double x = factor * all_lx *
                         walk.radiance({0.0, kRadius + double(model.eye_altitude_m()), 0.0}, towards(random));
        sum += x;
        squares += x * x;
    }
    const double mean = sum / walks;
    return {mean, std::sqrt(std::max(squares / walks - mean * mean, 0.0) / walks)};
}

}  // namespace

SkyEstimate sky_luminance_truth(const bake::SkyModel& model, double elevation_rad, double azimuth_rad,
                                int walks, std::uint64_t seed) {
    const double level = std::cos(elevation_rad);
    const dvec3 d(level * std::sin(azimuth_rad), std::sin(elevation_rad), -level * std::cos(azimuth_rad));
    return estimate(model, walks, seed, 1.0, [&](Random&) { return d; });
}

SkyEstimate sky_illuminance_truth(const bake::SkyModel& model, int walks, std::uint64_t seed) {
    return estimate(model, walks, seed, kPi, [](Random& random) {
        return around(dvec3(0.0, 1.0, 0.0), std::sqrt(uniform(random)), random);
    });
}

}  // namespace candela::measure
