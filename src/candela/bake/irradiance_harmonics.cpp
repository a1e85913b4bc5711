#include "candela/bake/irradiance_harmonics.hpp"

#include <algorithm>
#include <cmath>

#include "shading/environment.glsl"
#include "shading/spherical_harmonics.glsl"

namespace candela::bake {
namespace {

void project(Sh9& sh, const glm::vec3& direction, const glm::vec3& value) {
    for (std::size_t i = 0; i < sh.size(); ++i)
        sh[i] += value * shading::sh_basis(static_cast<int>(i), direction);
}

/// The parts of each degree in directions dense enough for functions of degree 2, as shares of the mean.
std::vector<glm::vec3> degrees_over_mean(const Sh9& sh) {
    std::vector<glm::vec3> out;
    constexpr int rows = 48;
    for (int y = 0; y <= rows; ++y) {
        for (int x = 0; x < 2 * rows; ++x) {
            const glm::vec3 d = shading::equirect_direction(
                {static_cast<float>(x) / (2.0f * rows), static_cast<float>(y) / rows});
            std::array<glm::vec3, 3> degrees{};
            for (int i = 0; i < shading::kShCoefficients; ++i)
                degrees[i == 0 ? 0 : (i < 4 ? 1 : 2)] +=
                    sh[static_cast<std::size_t>(i)] * shading::sh_basis(i, d);
            for (int c = 0; c < 3; ++c) {
                if (degrees[0][c] > 0.0f)
                    out.emplace_back(1.0f, degrees[1][c] / degrees[0][c], degrees[2][c] / degrees[0][c]);
            }
        }
    }
    return out;
}

float least_windowed(const std::vector<glm::vec3>& degrees, float lambda) {
    const glm::vec3 window(shading::sh_window(0, lambda), shading::sh_window(1, lambda),
                           shading::sh_window(4, lambda));
    float least = 1.0f;
    for (const glm::vec3& d : degrees) least = std::min(least, glm::dot(window, d));
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
    const std::vector<glm::vec3> degrees = degrees_over_mean(sh);
    if (least_windowed(degrees, 0.0f) >= least) return 0.0f;
    float low = 0.0f;
    float high = 1.0f;
    while (least_windowed(degrees, high) < 0.0f) high *= 2.0f;
    for (int i = 0; i < 20; ++i) {
        const float middle = 0.5f * (low + high);
        (least_windowed(degrees, middle) < 0.0f ? low : high) = middle;
    }
    for (std::size_t i = 0; i < sh.size(); ++i) sh[i] *= shading::sh_window(static_cast<int>(i), high);
    return high;
}

}  // namespace candela::bake
