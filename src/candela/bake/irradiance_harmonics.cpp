#include "candela/bake/irradiance_harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <vector>

#include "shading/environment.glsl"
#include "shading/spherical_harmonics.glsl"

namespace candela::bake {
namespace {

void project(Sh9& sh, const glm::vec3& direction, const glm::vec3& value) {
    for (std::size_t i = 0; i < sh.size(); ++i)
        sh[i] += value * shading::sh_basis(static_cast<int>(i), direction);
}

/// A channel over its mean, as a function of the unit direction d: 1 + b.d + d.(A d), A without a trace.
struct Shape {
    glm::dvec3 b{0.0};
    glm::dmat3 a{0.0};
    double power_1 = 0.0;  ///< mean square of band 1 over the sphere, to a common factor
    double power_2 = 0.0;

    /// The two bands in a direction, to be weighted.
    [[nodiscard]] glm::dvec2 bands(const glm::dvec3& d) const { return {glm::dot(b, d), glm::dot(d, a * d)}; }
};

Shape shape_of(const Sh9& sh, int channel) {
    const auto k = [&](int i) {
        return double{sh[static_cast<std::size_t>(i)][channel]} * double{shading::sh_scale(i)};
    };
    const double mean = k(0);
    Shape out;
    out.b = glm::dvec3(k(3), k(1), k(2)) / mean;
    // Of shading::sh_polynomial: x y, y z, 3 z^2 - 1 = 2 z^2 - x^2 - y^2, x z, x^2 - y^2.
    out.a[0][0] = (k(8) - k(6)) / mean;
    out.a[1][1] = (-k(8) - k(6)) / mean;
    out.a[2][2] = 2.0 * k(6) / mean;
    out.a[0][1] = out.a[1][0] = 0.5 * k(4) / mean;
    out.a[1][2] = out.a[2][1] = 0.5 * k(5) / mean;
    out.a[0][2] = out.a[2][0] = 0.5 * k(7) / mean;
    for (int i = 1; i < shading::kShCoefficients; ++i) {
        const double c = double{sh[static_cast<std::size_t>(i)][channel]} / mean;
        (i < 4 ? out.power_1 : out.power_2) += c * c;
    }
    return out;
}

glm::dvec3 downhill(const Shape& shape, const glm::dvec2& weights, glm::dvec3 at) {
    double squares = 0.0;
    for (int c = 0; c < 3; ++c) squares += glm::dot(shape.a[c], shape.a[c]);
    // No second derivative along the sphere is larger.
    const double steepest = weights.x * glm::length(shape.b) + 4.0 * weights.y * std::sqrt(squares);
    if (!(steepest > 0.0)) return at;
    constexpr int steps = 300;
    for (int i = 0; i < steps; ++i) {
        const glm::dvec3 gradient = weights.x * shape.b + 2.0 * weights.y * (shape.a * at);
        at = glm::normalize(at - (gradient - at * glm::dot(at, gradient)) / steepest);
    }
    return at;
}

/// Where the weighted bands are least: the least of a grid, followed downhill.
glm::dvec3 least_direction(const Shape& shape, const glm::dvec2& weights) {
    const auto value = [&](const glm::dvec3& d) { return glm::dot(weights, shape.bands(d)); };
    constexpr int rows = 24;
    glm::dvec3 at(0.0, 1.0, 0.0);
    for (int y = 0; y <= rows; ++y) {
        for (int x = 0; x < 2 * rows; ++x) {
            const glm::dvec3 d(shading::equirect_direction(
                {static_cast<float>(x) / (2.0f * rows), static_cast<float>(y) / rows}));
            if (value(d) < value(at)) at = d;
        }
    }
    at = downhill(shape, weights, at);
    // Band 2 is even, so what competes is about the opposite direction.
    const glm::dvec3 opposite = downhill(shape, weights, -at);
    return value(opposite) < value(at) ? opposite : at;
}

/// The weights from 0 to 1 that change the least, in the mean square over the sphere, of those with which
/// 1 + weights.bands >= 0 for all `bands`: a convex problem in two unknowns. weights 0 meet every constraint.
glm::dvec2 least_change(const Shape& shape, const std::vector<glm::dvec2>& bands) {
    // What the constraints leave of the weight of band 1, given that of band 2.
    const auto allowed = [&](double second) {
        glm::dvec2 range(0.0, 1.0);
        for (const glm::dvec2& b : bands) {
            const double rest = 1.0 + second * b.y;
            if (b.x < 0.0) range.y = std::min(range.y, rest / -b.x);
            if (b.x > 0.0) range.x = std::max(range.x, -rest / b.x);
            if (b.x == 0.0 && rest < 0.0) range.y = -1.0;
        }
        return range;
    };
    constexpr int halvings = 40;
    double most = 1.0;
    if (glm::dvec2 r = allowed(most); r.x > r.y) {
        double low = 0.0;
        for (int i = 0; i < halvings; ++i) {
            const double middle = 0.5 * (low + most);
            r = allowed(middle);
            (r.x > r.y ? most : low) = middle;
        }
        most = low;
    }
    const auto cost = [&](double second) {
        const double first = allowed(second).y;
        return (1.0 - first) * (1.0 - first) * shape.power_1 +
               (1.0 - second) * (1.0 - second) * shape.power_2;
    };
    double low = 0.0;
    double high = most;
    for (int i = 0; i < 2 * halvings; ++i) {
        const double third = (high - low) / 3.0;
        if (cost(low + third) < cost(high - third))
            high -= third;
        else
            low += third;
    }
    return {allowed(low).y, low};
}

/// Rounding of a black half is not worth a window.
constexpr double kNegligible = 1.0e-5;

}  // namespace

Sh9 irradiance_sh(const EquirectLight& light, const Harmonics& harmonics) {
    std::vector<double> scale;
    for (const int index : {0, 1, 4}) scale.push_back(double(shading::sh_cosine_over_pi(index)));
    SmoothGrid grid = synthesize(harmonics, scale, 16);
    const std::vector<double> weights = polar_weights(grid.height());
    Sh9 sh{};
    for (std::uint32_t y = 0; y < grid.height(); ++y) {
        const double weight = weights[std::min(y, grid.height() - 1 - y)] * 2.0 * M_PI / double(grid.width());
        for (std::uint32_t x = 0; x < grid.width(); ++x) {
            const glm::vec3 local = shading::equirect_direction(
                {(static_cast<float>(x) + 0.5f) / static_cast<float>(grid.width()),
                 (static_cast<float>(y) + 0.5f) / static_cast<float>(grid.height())});
            project(sh, shading::rotate_about_y(local, light.rotation_rad),
                    glm::vec3(grid.row(y)[x]) * static_cast<float>(weight));
        }
    }
    Sh9 of_peaks{};
    for (const LightPeak& peak : light.peaks)
        project(of_peaks, shading::rotate_about_y(peak.direction(), light.rotation_rad), peak.power);
    for (std::size_t i = 0; i < sh.size(); ++i)
        sh[i] += of_peaks[i] * shading::sh_cosine_over_pi(static_cast<int>(i));
    return sh;
}

glm::vec3 evaluate_sh(const Sh9& sh, const glm::vec3& direction) {
    glm::vec3 sum(0.0f);
    for (std::size_t i = 0; i < sh.size(); ++i)
        sum += sh[i] * shading::sh_basis(static_cast<int>(i), direction);
    return sum;
}

scene::HarmonicsWindow window_negative(Sh9& sh) {
    scene::HarmonicsWindow out;
    for (int c = 0; c < 3; ++c) {
        if (!(sh[0][c] > 0.0f)) continue;
        const Shape shape = shape_of(sh, c);
        std::vector<glm::dvec2> met;
        glm::dvec2 weights(1.0);
        // Each round adds the direction that the weights so far leave most negative.
        constexpr int rounds = 16;
        for (int round = 0; round < rounds; ++round) {
            const glm::dvec2 bands = shape.bands(least_direction(shape, weights));
            const double least = 1.0 + glm::dot(weights, bands);
            if (round == 0) out.least_over_mean[c] = static_cast<float>(least);
            if (least >= -kNegligible) break;
            met.push_back(bands);
            weights = least_change(shape, met);
        }
        out.bands[static_cast<std::size_t>(c)] = glm::vec2(weights);
        for (int i = 1; i < shading::kShCoefficients; ++i)
            sh[static_cast<std::size_t>(i)][c] *= static_cast<float>(i < 4 ? weights.x : weights.y);
    }
    return out;
}

}  // namespace candela::bake
