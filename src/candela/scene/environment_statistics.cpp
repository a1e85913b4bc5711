#include <algorithm>
#include <cmath>
#include <numeric>

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

std::vector<double> percentiles_of(const PictureSphere& sphere) {
    std::vector<std::uint32_t> order(sphere.texels());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return sphere.luminance(a) < sphere.luminance(b); });
    std::vector<double> out;
    double below = 0.0;
    std::size_t i = 0;
    for (const double percent : kPercentiles) {
        while (i + 1 < order.size() && below + sphere.solid_angle(order[i]) < percent / 100.0 * 4.0 * M_PI)
            below += sphere.solid_angle(order[i++]);
        out.push_back(double{sphere.luminance(order[i])});
    }
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

EnvironmentStatistics statistics_of(const Environment& e) {
    const PictureSphere sphere(e);
    EnvironmentStatistics out;
    out.upward_lx = illuminance_lx(e, true);
    out.downward_lx = illuminance_lx(e, false);
    for (std::uint32_t t = 0; t < sphere.texels(); ++t)
        out.mean_nit +=
            glm::dvec3(e.luminance_nit[t]) * (sphere.solid_angle(t) * double{e.scale} / (4.0 * M_PI));
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
