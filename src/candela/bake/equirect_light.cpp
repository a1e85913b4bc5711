#include "candela/bake/equirect_light.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "shading/environment.glsl"

namespace candela::bake {
namespace {

/// As many as cost no more than the rest of the work.
constexpr std::size_t kMostPeaks = 32;
/// A texel stands out when it is this many times as bright as the mean of the map.
constexpr double kPeakOverMean = 16.0;

float texel_solid_angle(const EquirectLight& light, std::uint32_t row) {
    return shading::equirect_texel_solid_angle(row, light.width, light.height);
}

float luminance(const glm::vec4& texel) {
    return shading::luminance(glm::vec3(texel));
}

/// Of the map that peaks are looked for in.
constexpr std::uint32_t kPeakMapWidth = 2048;

/// Two texels each way of a map of this size become one; texel(x, y) is of that map.
template <class Texel>
glm::vec4 halved_texel(std::uint32_t width, std::uint32_t height, std::uint32_t x, std::uint32_t y,
                       const Texel& texel) {
    const float upper = shading::equirect_texel_solid_angle(2 * y, width, height);
    const float lower = shading::equirect_texel_solid_angle(2 * y + 1, width, height);
    return ((texel(2 * x, 2 * y) + texel(2 * x + 1, 2 * y)) * upper +
            (texel(2 * x, 2 * y + 1) + texel(2 * x + 1, 2 * y + 1)) * lower) /
           (2.0f * (upper + lower));
}

template <class Texel>
void fill(EquirectLight& to, const Texel& texel) {
    to.texels.resize(std::size_t{to.width} * to.height);
    tbb::parallel_for(0u, to.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < to.width; ++x) to.texels[std::size_t{y} * to.width + x] = texel(x, y);
    });
}

EquirectLight halve(const EquirectLight& from) {
    EquirectLight to;
    to.width = from.width / 2;
    to.height = from.height / 2;
    to.rotation_rad = from.rotation_rad;
    to.peaks = from.peaks;
    fill(to, [&](std::uint32_t x, std::uint32_t y) {
        return halved_texel(from.width, from.height, x, y, [&](std::uint32_t u, std::uint32_t v) {
            return from.texels[std::size_t{v} * from.width + u];
        });
    });
    return to;
}

/// Files are repaired when they are read; one such texel of others would be in every filtered one.
glm::vec3 without_nan(const glm::vec3& texel) {
    return glm::mix(texel, glm::vec3(0.0f), glm::isnan(texel));
}

/// The picture after so many halvings, without a copy of it at any larger size.
glm::vec4 reduced_texel(const scene::Environment& e, float scale, int halvings, std::uint32_t x,
                        std::uint32_t y) {
    if (halvings == 0) return {without_nan(e.luminance_nit[std::size_t{y} * e.width + x]) * scale, 0.0f};
    return halved_texel(
        e.width >> (halvings - 1), e.height >> (halvings - 1), x, y,
        [&](std::uint32_t u, std::uint32_t v) { return reduced_texel(e, scale, halvings - 1, u, v); });
}

/// The luminance that no texel may pass: what only kMostPeaks pass, or kPeakOverMean times the mean.
float cap_luminance(const EquirectLight& light) {
    double sum = 0.0;
    std::vector<float> brightest(light.texels.size());
    for (std::uint32_t y = 0; y < light.height; ++y) {
        double row = 0.0;
        for (std::uint32_t x = 0; x < light.width; ++x) {
            const std::size_t i = std::size_t{y} * light.width + x;
            brightest[i] = luminance(light.texels[i]);
            row += static_cast<double>(brightest[i]);
        }
        sum += row * static_cast<double>(texel_solid_angle(light, y));
    }
    const std::size_t at = std::min(kMostPeaks, brightest.size() - 1);
    std::nth_element(brightest.begin(), brightest.begin() + static_cast<std::ptrdiff_t>(at), brightest.end(),
                     std::greater<>());
    // The mean of what stays below: a sun does not raise the bar for a lamp.
    double above = 0.0;
    for (std::uint32_t y = 0; y < light.height; ++y) {
        for (std::uint32_t x = 0; x < light.width; ++x) {
            const float l = luminance(light.texels[std::size_t{y} * light.width + x]);
            if (l > brightest[at])
                above +=
                    static_cast<double>(l - brightest[at]) * static_cast<double>(texel_solid_angle(light, y));
        }
    }
    const double mean = (sum - above) / (4.0 * M_PI);
    return std::max(brightest[at], static_cast<float>(kPeakOverMean * mean));
}

void take_peaks(EquirectLight& light) {
    const float cap = cap_luminance(light);
    if (!(cap > 0.0f)) return;
    for (std::uint32_t y = 0; y < light.height; ++y) {
        for (std::uint32_t x = 0; x < light.width; ++x) {
            glm::vec4& texel = light.texels[std::size_t{y} * light.width + x];
            const float l = luminance(texel);
            if (l <= cap) continue;
            const glm::vec4 kept = texel * (cap / l);
            const float across = shading::TWO_PI / static_cast<float>(light.width);
            const float down = shading::PI / static_cast<float>(light.height);
            light.peaks.push_back({glm::vec3(texel - kept) * texel_solid_angle(light, y),
                                   across * (static_cast<float>(x) + 0.5f) - shading::PI,
                                   down * (static_cast<float>(y) + 0.5f), across, down});
            texel = kept;
        }
    }
}

}  // namespace

glm::vec3 LightPeak::direction(float across, float down) const {
    return shading::equirect_direction({0.5f + (azimuth_rad + across * azimuth_step_rad) / shading::TWO_PI,
                                        (polar_rad + down * polar_step_rad) / shading::PI});
}

void for_hat(const LightPeak& peak, const std::function<void(const glm::vec3&, float)>& visit) {
    constexpr int points = 16;
    float shares[points * points];
    const auto place = [](int i) {
        return 2.0f * (static_cast<float>(i) + 0.5f) / static_cast<float>(points) - 1.0f;
    };
    float total = 0.0f;
    for (int k = 0; k < points * points; ++k) {
        const float down = place(k / points);
        shares[k] = (1.0f - std::abs(place(k % points))) * (1.0f - std::abs(down)) *
                    std::abs(std::sin(peak.polar_rad + down * peak.polar_step_rad));
        total += shares[k];
    }
    for (int k = 0; k < points * points; ++k)
        visit(peak.direction(place(k % points), place(k / points)), shares[k] / total);
}

glm::vec4 EquirectLight::read(float u, float v) const {
    return read_texels((u - std::floor(u)) * static_cast<float>(width), v * static_cast<float>(height));
}

glm::vec4 EquirectLight::read_texels(float across, float down) const {
    const float x = across - 0.5f;
    const float y = std::clamp(down - 0.5f, 0.0f, static_cast<float>(height - 1));
    // Not below -1: whole numbers from there on are what a conversion cuts off at.
    const int left = static_cast<int>(x + 1.0f) - 1;
    const auto top = static_cast<std::uint32_t>(y);
    const std::uint32_t bottom = std::min(top + 1, height - 1);
    const float fx = x - static_cast<float>(left);
    const float fy = y - static_cast<float>(top);
    const auto last = static_cast<int>(width) - 1;
    const auto x0 = static_cast<std::size_t>(left < 0 ? last : std::min(left, last));
    const std::size_t x1 = left >= last ? 0 : static_cast<std::size_t>(left + 1);
    const glm::vec4* upper = texels.data() + std::size_t{top} * width;
    const glm::vec4* lower = texels.data() + std::size_t{bottom} * width;
    return glm::mix(glm::mix(upper[x0], upper[x1], fx), glm::mix(lower[x0], lower[x1], fx), fy);
}

glm::dvec3 EquirectLight::energy() const {
    glm::dvec3 sum(0.0);
    for (std::uint32_t y = 0; y < height; ++y) {
        glm::dvec3 row(0.0);
        for (std::uint32_t x = 0; x < width; ++x) row += glm::dvec3(texels[std::size_t{y} * width + x]);
        sum += row * static_cast<double>(texel_solid_angle(*this, y));
    }
    for (const LightPeak& peak : peaks) sum += glm::dvec3(peak.power);
    return sum;
}

EquirectLight equirect_light(const scene::Environment& environment, float scale,
                             std::uint32_t largest_width) {
    EquirectLight light;
    light.width = environment.width;
    light.height = environment.height;
    light.rotation_rad = environment.rotation_rad;
    const auto halves = [&light](std::uint32_t width) {
        return light.width > width && light.width % 2 == 0 && light.height % 2 == 0;
    };
    // Peaks where they are, however small the map is made.
    const std::uint32_t peak_width = std::max(largest_width, kPeakMapWidth);
    int halvings = 0;
    for (; halves(peak_width); ++halvings) light.width /= 2, light.height /= 2;
    fill(light,
         [&](std::uint32_t x, std::uint32_t y) { return reduced_texel(environment, scale, halvings, x, y); });
    take_peaks(light);
    while (halves(largest_width)) light = halve(light);
    light.lowest = light.highest = light.texels.front();
    for (const glm::vec4& texel : light.texels) {
        light.lowest = glm::min(light.lowest, texel);
        light.highest = glm::max(light.highest, texel);
    }
    return light;
}

EquirectLight refined(const EquirectLight& light, std::uint32_t factor) {
    EquirectLight to = light;
    to.width *= factor;
    to.height *= factor;
    to.texels.resize(std::size_t{to.width} * to.height);
    tbb::parallel_for(0u, to.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < to.width; ++x) {
            to.texels[std::size_t{y} * to.width + x] =
                light.read((static_cast<float>(x) + 0.5f) / static_cast<float>(to.width),
                           (static_cast<float>(y) + 0.5f) / static_cast<float>(to.height));
        }
    });
    return to;
}

}  // namespace candela::bake
