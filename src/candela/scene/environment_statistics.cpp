#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "candela/scene/environment_sources.hpp"
#include "candela/scene/environment_sphere.hpp"

namespace candela::scene {
namespace {

using detail::PictureSphere;

/// Integral of cos(theta) sin(theta) over a row, above (up) or below the horizon, times a texel's step of
/// azimuth: exact.
double cosine_weight(const Environment& e, std::uint32_t row, bool up) {
    const auto polar = [&](double edge) {
        const double p = M_PI * edge / e.height;
        return up ? std::min(0.5 * M_PI, p) : std::max(0.5 * M_PI, p);
    };
    const double top = std::sin(polar(row)), bottom = std::sin(polar(row + 1.0));
    return std::abs(bottom * bottom - top * top) * M_PI / e.width;
}

double illuminance_lx(const Environment& e, bool up) {
    double sum = 0.0;
    for (std::uint32_t y = 0; y < e.height; ++y) {
        double row = 0.0;
        for (std::uint32_t x = 0; x < e.width; ++x)
            row += double{shading::luminance(e.luminance_nit[std::size_t{y} * e.width + x])};
        sum += cosine_weight(e, y, up) * row;
    }
    return sum * double{e.scale};
}

/// Grows with the value, as the bits of a float do but for its sign.
std::uint32_t sortable(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

/// Quantiles of luminance by solid angle. Only the bucket that one falls into is sorted.
class Quantiles {
  public:
    explicit Quantiles(const PictureSphere& sphere) : sphere_(sphere), buckets_sr_(kBuckets, 0.0) {
        for (std::uint32_t t = 0; t < sphere.texels(); ++t)
            buckets_sr_[bucket_of(t)] += sphere.solid_angle(t);
    }

    /// The luminance below which this much of the sphere lies.
    [[nodiscard]] double at(double below_sr) const {
        // The last that holds anything where rounding leaves their sum below what is asked for.
        std::size_t bucket = 0;
        double sum_sr = 0.0;
        double before_sr = 0.0;
        for (std::size_t b = 0; b < kBuckets && sum_sr < below_sr; ++b) {
            if (!(buckets_sr_[b] > 0.0)) continue;
            bucket = b;
            before_sr = sum_sr;
            sum_sr += buckets_sr_[b];
        }
        std::vector<std::uint32_t> texels;
        for (std::uint32_t t = 0; t < sphere_.texels(); ++t)
            if (bucket_of(t) == bucket) texels.push_back(t);
        std::sort(texels.begin(), texels.end(), [&](std::uint32_t a, std::uint32_t b) {
            return sphere_.luminance(a) < sphere_.luminance(b);
        });
        std::size_t i = 0;
        while (i + 1 < texels.size() && before_sr + sphere_.solid_angle(texels[i]) < below_sr)
            before_sr += sphere_.solid_angle(texels[i++]);
        return double{sphere_.luminance(texels.at(i))};
    }

  private:
    static constexpr std::size_t kBuckets = std::size_t{1} << 16u;

    [[nodiscard]] std::size_t bucket_of(std::uint32_t texel) const {
        return sortable(sphere_.luminance(texel)) >> 16u;
    }

    const PictureSphere& sphere_;
    std::vector<double> buckets_sr_;
};

std::vector<double> percentiles_of(const PictureSphere& sphere) {
    const Quantiles quantiles(sphere);
    std::vector<double> out;
    for (const double percent : kPercentiles) out.push_back(quantiles.at(percent / 100.0 * 4.0 * M_PI));
    return out;
}

/// Solid angle of the texels connected to the peak by at least half of its luminance.
double solid_angle_of_peak(const PictureSphere& sphere, std::uint32_t peak) {
    const Environment& e = sphere.environment();
    std::vector<std::uint8_t> met(sphere.texels(), 0);
    std::vector<std::uint32_t> open{peak};
    met[peak] = 1;
    double sum = 0.0;
    while (!open.empty()) {
        const std::uint32_t texel = open.back();
        open.pop_back();
        sum += sphere.solid_angle(texel);
        const std::uint32_t x = texel % e.width, y = texel / e.width;
        const std::uint32_t beside[] = {
            y * e.width + (x + 1) % e.width, y * e.width + (x + e.width - 1) % e.width,
            y > 0 ? texel - e.width : texel, y + 1 < e.height ? texel + e.width : texel};
        for (const std::uint32_t t : beside) {
            if (met[t] == 0 && sphere.luminance(t) >= 0.5f * sphere.luminance(peak))
                met[t] = 1, open.push_back(t);
        }
    }
    return sum;
}

}  // namespace

double upward_illuminance_lx(const Environment& environment) {
    return illuminance_lx(environment, true);
}

glm::dvec3 mean_nit(const Environment& e) {
    glm::dvec3 sum(0.0);
    for (std::uint32_t y = 0; y < e.height; ++y) {
        glm::dvec3 row(0.0);
        for (std::uint32_t x = 0; x < e.width; ++x) {
            const glm::dvec3 nit(e.luminance_nit[std::size_t{y} * e.width + x]);
            if (std::isfinite(nit.x + nit.y + nit.z)) row += nit;
        }
        sum += row * detail::texel_solid_angle_sr(e, y);
    }
    return sum * (double{e.scale} / (4.0 * M_PI));
}

EnvironmentStatistics statistics_of(const Environment& e) {
    const PictureSphere sphere(e);
    EnvironmentStatistics out;
    out.upward_lx = illuminance_lx(e, true);
    out.downward_lx = illuminance_lx(e, false);
    out.mean_nit = mean_nit(e);
    out.mean_luminance_nit = shading::luminance(out.mean_nit);
    out.percentiles_nit = percentiles_of(sphere);
    const auto peak = std::max_element(sphere.luminances().begin(), sphere.luminances().end());
    const auto texel = static_cast<std::uint32_t>(peak - sphere.luminances().begin());
    out.peak_nit = double{*peak};
    out.peak_solid_angle_sr = solid_angle_of_peak(sphere, texel);
    out.peak_direction = shading::rotate_about_y(glm::vec3(sphere.direction(texel)), e.rotation_rad);
    return out;
}

}  // namespace candela::scene
