#include "candela/bake/irradiance_harmonics.hpp"

#include <algorithm>
#include <cmath>

#include "shading/environment_filter.glsl"
#include "shading/spherical_harmonics.glsl"

namespace candela::bake {
namespace {

void project(Sh9& sh, const glm::vec3& direction, const glm::vec3& value) {
    for (std::size_t i = 0; i < sh.size(); ++i)
        sh[i] += value * shading::sh_basis(static_cast<int>(i), direction);
}

Sh9 windowed(const Sh9& sh, float lambda) {
    Sh9 out = sh;
    for (std::size_t i = 0; i < sh.size(); ++i) out[i] *= shading::sh_window(static_cast<int>(i), lambda);
    return out;
}

/// Over directions dense enough for functions of degree 2; as a share of the mean.
float least_over_mean(const Sh9& sh) {
    float least = 1.0f;
    constexpr int rows = 48;
    for (int y = 0; y <= rows; ++y) {
        for (int x = 0; x < 2 * rows; ++x) {
            const glm::vec3 value =
                evaluate_sh(sh, shading::equirect_direction(
                                    {static_cast<float>(x) / (2.0f * rows), static_cast<float>(y) / rows}));
            for (int c = 0; c < 3; ++c) {
                const float mean = sh[0][c] * shading::sh_basis(0, {});
                if (mean > 0.0f) least = std::min(least, value[c] / mean);
            }
        }
    }
    return least;
}

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

float window_negative(Sh9& sh) {
    // Rounding of a black half is not worth a window.
    constexpr float least = -1.0e-5f;
    if (least_over_mean(sh) >= least) return 0.0f;
    float low = 0.0f;
    float high = 1.0f;
    while (least_over_mean(windowed(sh, high)) < 0.0f) high *= 2.0f;
    for (int i = 0; i < 20; ++i) {
        const float middle = 0.5f * (low + high);
        (least_over_mean(windowed(sh, middle)) < 0.0f ? low : high) = middle;
    }
    sh = windowed(sh, high);
    return high;
}

}  // namespace candela::bake
