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
constexpr float sigma_pixels = 1.5f;

/// The moments of a pair of lumas under one window.
struct Moments {
    float x = 0.0f, r = 0.0f, xx = 0.0f, rr = 0.0f, xr = 0.0f;
};

std::array<float, 2 * radius + 1> window_weights() {
    std::array<float, 2 * radius + 1> weights{};
    float sum = 0.0f;
    for (int i = -radius; i <= radius; ++i) {
        const float w = std::exp(-0.5f * float(i * i) / (sigma_pixels * sigma_pixels));
        weights[static_cast<std::size_t>(i + radius)] = w;
        sum += w;
    }
    for (float& w : weights) w /= sum;
    return weights;
}

/// The weighted mean of get(j) over the part of the window around `center` that lies in [0, size).
template <class Get>
Moments window_mean(int center, int size, const Get& get) {
    static const auto weights = window_weights();
    Moments sum;
    float total = 0.0f;
    for (int j = std::max(center - radius, 0); j <= std::min(center + radius, size - 1); ++j) {
        const float w = weights[static_cast<std::size_t>(j - center + radius)];
        const Moments m = get(j);
        sum.x += w * m.x;
        sum.r += w * m.r;
        sum.xx += w * m.xx;
        sum.rr += w * m.rr;
        sum.xr += w * m.xr;
        total += w;
    }
    const float scale = 1.0f / total;
    return {sum.x * scale, sum.r * scale, sum.xx * scale, sum.rr * scale, sum.xr * scale};
}

/// Wang et al. 2004, equation 13.
float similarity(const Moments& m) {
    constexpr float c1 = 0.01f * 0.01f, c2 = 0.03f * 0.03f;
    const float variance_x = std::max(m.xx - m.x * m.x, 0.0f);
    const float variance_r = std::max(m.rr - m.r * m.r, 0.0f);
    const float covariance = m.xr - m.x * m.r;
    return (2.0f * m.x * m.r + c1) * (2.0f * covariance + c2) /
           ((m.x * m.x + m.r * m.r + c1) * (variance_x + variance_r + c2));
}

}  // namespace

double ssim(const Picture& x, const Picture& r, const Mask& mask) {
    const std::size_t count = std::size_t{r.width} * r.height;
    if (x.width != r.width || x.height != r.height || x.pixels.size() != count || r.pixels.size() != count)
        throw std::invalid_argument("ssim: the pictures are not of one size");
    const int width = static_cast<int>(r.width), height = static_cast<int>(r.height);
    std::vector<Moments> rows(count);
    std::vector<float> map(count);
    const auto at = [&](int column, int row) { return std::size_t(row) * r.width + std::size_t(column); };
    for_row_bands(r.height, [&](std::uint32_t first, std::uint32_t end) {
        for (int y = int(first); y < int(end); ++y) {
            for (int column = 0; column < width; ++column) {
                rows[at(column, y)] = window_mean(column, width, [&](int j) {
                    const float a = shading::luminance(x.pixels[at(j, y)]);
                    const float b = shading::luminance(r.pixels[at(j, y)]);
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
            sum += double(map[at(column, y)]);
            ++used;
        }
    }
    return used == 0 ? 1.0 : sum / static_cast<double>(used);
}

}  // namespace candela::measure
