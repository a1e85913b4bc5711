#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "candela/measure/image_metrics.hpp"
#include "candela/measure/parallel_rows.hpp"
#include "shading/language.glsl"

namespace candela::measure {
namespace {

constexpr int radius = 5;
constexpr double sigma_pixels = 1.5;

/// The moments of a pair of lumas under one window. Single precision would lose a variance of 1e-7 in xx -
/// x^2.
struct Moments {
    double x = 0.0, r = 0.0, xx = 0.0, rr = 0.0, xr = 0.0;
};

std::array<double, 2 * radius + 1> window_weights() {
    std::array<double, 2 * radius + 1> weights{};
    double sum = 0.0;
    for (int i = -radius; i <= radius; ++i) {
        const double w = std::exp(-0.5 * i * i / (sigma_pixels * sigma_pixels));
        weights[static_cast<std::size_t>(i + radius)] = w;
        sum += w;
    }
    for (double& w : weights) w /= sum;
    return weights;
}

/// The weighted mean of get(j) over the part of the window around `center` that lies in [0, size).
template <class Get>
Moments window_mean(int center, int size, const Get& get) {
    static const auto weights = window_weights();
    Moments sum;
    double total = 0.0;
    for (int j = std::max(center - radius, 0); j <= std::min(center + radius, size - 1); ++j) {
        const double w = weights[static_cast<std::size_t>(j - center + radius)];
        const Moments m = get(j);
        sum.x += w * m.x;
        sum.r += w * m.r;
        sum.xx += w * m.xx;
        sum.rr += w * m.rr;
        sum.xr += w * m.xr;
        total += w;
    }
    const double scale = 1.0 / total;
    return {sum.x * scale, sum.r * scale, sum.xx * scale, sum.rr * scale, sum.xr * scale};
}

/// Wang et al. 2004, equation 13.
double similarity(const Moments& m) {
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    const double variance_x = m.xx - m.x * m.x, variance_r = m.rr - m.r * m.r;
    const double covariance = m.xr - m.x * m.r;
    return (2.0 * m.x * m.r + c1) * (2.0 * covariance + c2) /
           ((m.x * m.x + m.r * m.r + c1) * (variance_x + variance_r + c2));
}

}  // namespace

double ssim(const Picture& x, const Picture& r, const Mask& mask) {
    const std::size_t count = std::size_t{r.width} * r.height;
    if (x.width != r.width || x.height != r.height || x.pixels.size() != count || r.pixels.size() != count)
        throw std::invalid_argument("ssim: the pictures are not of one size");
    const int width = static_cast<int>(r.width), height = static_cast<int>(r.height);
    std::vector<Moments> rows(count);
    std::vector<double> map(count);
    const auto at = [&](int column, int row) { return std::size_t(row) * r.width + std::size_t(column); };
    for_row_bands(r.height, [&](std::uint32_t first, std::uint32_t end) {
        for (int y = int(first); y < int(end); ++y) {
            for (int column = 0; column < width; ++column) {
                rows[at(column, y)] = window_mean(column, width, [&](int j) {
                    const double a = double(shading::luminance(x.pixels[at(j, y)]));
                    const double b = double(shading::luminance(r.pixels[at(j, y)]));
                    return Moments{a, b, a * a, b * b, a * b};
                });
            }
        }
    });
    for_row_bands(r.height, [&](std::uint32_t first, std::uint32_t end) {
        for (int y = int(first); y < int(end); ++y) {
            for (int column = 0; column < width; ++column)
                map[at(column, y)] =
                    similarity(window_mean(y, height, [&](int j) { return rows[at(column, j)]; }));
        }
    });
    const bool has_inside = width > 2 * radius && height > 2 * radius;
    const int border = has_inside ? radius : 0;
    double sum = 0.0;
    std::size_t used = 0;
    for (int y = border; y < height - border; ++y) {
        for (int column = border; column < width - border; ++column) {
            if (!mask.empty() && mask[at(column, y)] == 0) continue;
            sum += map[at(column, y)];
            ++used;
        }
    }
    return used == 0 ? 1.0 : sum / static_cast<double>(used);
}

}  // namespace candela::measure
