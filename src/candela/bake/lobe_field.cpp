#include "candela/bake/lobe_field.hpp"

#include <algorithm>
#include <cmath>

#include "candela/bake/wide.hpp"
#include "shading/environment_filter.glsl"

namespace candela::bake {
namespace {

/// The transform of the LD weight falls like exp(-2 alpha l) sqrt(alpha l).
constexpr double kDegreeTimesAlpha = 6.0;
/// The clamped cosine of a rough lobe falls slower, as l^-2.5.
constexpr std::uint32_t kLeastDegree = 100;

/// The hat of bilinear reading in nine points, its second moments kept.
constexpr float kHatSide = 1.0f / 12.0f;

std::uint32_t grid_width(std::uint32_t degree) {
    std::uint32_t width = 64;
    while (2 * width < 5 * degree) width *= 2;
    return width;
}

CANDELA_WIDE float nearest_half_sine2(const Directions& d, const glm::vec3& to) {
    float least = 1.0f;
    for (std::size_t i = 0; i < d.size(); ++i) {
        const float x = d.x[i] - to.x;
        const float y = d.y[i] - to.y;
        const float z = d.z[i] - to.z;
        const float s = 0.25f * (x * x + y * y + z * z);
        least = s < least ? s : least;
    }
    return least;
}

CANDELA_WIDE void add_source(std::size_t count, const float* x, const float* y, const float* z,
                             const glm::vec3& to, const glm::vec3& power, float alpha, float* r, float* g,
                             float* b) {
    for (std::size_t i = 0; i < count; ++i) {
        const float w = shading::ld_weight(shading::half_sine2({x[i], y[i], z[i]}, to), alpha);
        r[i] += power.x * w;
        g[i] += power.y * w;
        b[i] += power.z * w;
    }
}

}  // namespace

std::uint32_t ld_degree(float alpha) {
    return std::max(kLeastDegree, static_cast<std::uint32_t>(std::ceil(kDegreeTimesAlpha / double(alpha))));
}

std::vector<double> ld_zonal_coefficients(float alpha, std::uint32_t degree) {
    // Angles spaced as a hyperbolic sine, close together within the lobe; Gauss's four nodes in each part.
    const double node[4] = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
    const double node_weight[4] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                   0.1739274225687269};
    const std::size_t parts = 64 + 2 * std::size_t{degree};
    const double stretch = std::asinh(0.5 * M_PI / double(alpha));
    std::vector<double> cosine(4 * parts);
    std::vector<double> weight(cosine.size());
    double total = 0.0;
    for (std::size_t i = 0; i < cosine.size(); ++i) {
        const double at = (double(i / 4) + node[i % 4]) / double(parts);
        const double theta = double(alpha) * std::sinh(stretch * at);
        const double half_sine = std::sin(0.5 * theta);
        cosine[i] = std::cos(theta);
        weight[i] = node_weight[i % 4] * std::cosh(stretch * at) * std::sin(theta) *
                    double(shading::ld_weight(static_cast<float>(half_sine * half_sine), alpha));
        total += weight[i];
    }
    std::vector<double> now(cosine.size(), 1.0);
    std::vector<double> before(cosine.size(), 0.0);
    std::vector<double> out(degree + 1);
    for (std::uint32_t l = 0; l <= degree; ++l) {
        double sum = 0.0;
        const double a = (2.0 * l + 1.0) / (l + 1.0);
        const double b = double(l) / (l + 1.0);
        for (std::size_t i = 0; i < cosine.size(); ++i) {
            sum += weight[i] * now[i];
            const double next = a * cosine[i] * now[i] - b * before[i];
            before[i] = now[i];
            now[i] = next;
        }
        out[l] = sum / total;
    }
    return out;
}

LobeField::LobeField(const EquirectLight& light, const Harmonics& harmonics, float alpha)
    : alpha_(alpha),
      grid_(synthesize(harmonics,
                       ld_zonal_coefficients(alpha, std::min(ld_degree(alpha), harmonics.degree())),
                       grid_width(std::min(ld_degree(alpha), harmonics.degree())))),
      lowest_(light.lowest),
      highest_(light.highest) {
    const float normalize = 1.0f / shading::ld_weight_integral(alpha);
    for (const LightPeak& peak : light.peaks) {
        far_.push_back({peak.direction(), peak.power * normalize});
        for (int j = -1; j <= 1; ++j) {
            for (int i = -1; i <= 1; ++i) {
                const float share = (i == 0 ? 1.0f - 2.0f * kHatSide : kHatSide) *
                                    (j == 0 ? 1.0f - 2.0f * kHatSide : kHatSide);
                near_.push_back({peak.direction(static_cast<float>(i), static_cast<float>(j)),
                                 peak.power * (normalize * share)});
            }
        }
        // A lobe much wider than the texel does not tell it from a point; nor does the lobe's flank far away.
        const float step = peak.polar_step_rad;
        if (2.0f * alpha < 16.0f * step) near_half_sine2_ = std::max(near_half_sine2_, 100.0f * step * step);
    }
}

void LobeField::evaluate(Directions& d) const {
    d.make_unit();
    d.find_places(static_cast<float>(grid_.width()), static_cast<float>(grid_.height()));
    for (std::size_t i = 0; i < d.size(); ++i) {
        const glm::vec4 value = glm::clamp(grid_.read(d.r[i], d.g[i]), lowest_, highest_);
        d.r[i] = value.x;
        d.g[i] = value.y;
        d.b[i] = value.z;
    }
    for (std::size_t peak = 0; peak < far_.size(); ++peak) {
        if (near_half_sine2_ > 0.0f && nearest_half_sine2(d, far_[peak].direction) < near_half_sine2_)
            add_sources(near_.data() + 9 * peak, 9, d);
        else
            add_sources(far_.data() + peak, 1, d);
    }
}

void LobeField::add_sources(const Source* sources, std::size_t count, Directions& d) const {
    for (std::size_t i = 0; i < count; ++i)
        add_source(d.size(), d.x.data(), d.y.data(), d.z.data(), sources[i].direction, sources[i].power,
                   alpha_, d.r.data(), d.g.data(), d.b.data());
}

}  // namespace candela::bake
