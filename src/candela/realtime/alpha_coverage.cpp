#include "candela/realtime/alpha_coverage.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace candela::realtime {
namespace {

/// Samples that a coverage is measured with, where the level has not that many texels itself.
constexpr double kFewestSamples = 65536.0;
/// Larger levels are measured at their texels alone: what lies between two is a small part of them.
constexpr std::size_t kMostSupersampledTexels = std::size_t{1} << 20;
/// Alpha takes one of so many values.
constexpr std::size_t kBins = 4096;

/// Irrational: shifts that do not repeat.
constexpr float kShiftX = 0.618034f;
constexpr float kShiftY = 0.569840f;

float fraction(float x) {
    return x - std::floor(x);
}

/// A texel's alpha between it and its right and lower neighbours, at a fraction of a texel.
template <class Visit>
void each_sample(const AlphaTexels& level, const Visit& visit) {
    const std::size_t texels = std::size_t{level.width} * level.height;
    const double per_texel = std::sqrt(kFewestSamples / static_cast<double>(texels));
    const int steps =
        texels > kMostSupersampledTexels ? 1 : static_cast<int>(std::clamp(std::ceil(per_texel), 2.0, 64.0));
    const float step = 1.0f / static_cast<float>(steps);
    for (std::uint32_t y = 0; y < level.height; ++y) {
        const std::size_t row = std::size_t{y} * level.width;
        const std::size_t below = std::size_t{(y + 1) % level.height} * level.width;
        for (std::uint32_t x = 0; x < level.width; ++x) {
            const std::uint32_t right = (x + 1) % level.width;
            const float a = level.at(row + x);
            const float b = level.at(row + right);
            const float c = level.at(below + x);
            const float d = level.at(below + right);
            if (steps == 1) {
                visit(a);
                continue;
            }
            // Rows of samples are shifted against each other, so that edges along them count in fine steps.
            const float row_shift = fraction(kShiftY * static_cast<float>(x + 5 * y));
            for (int j = 0; j < steps; ++j) {
                const float v = (static_cast<float>(j) + row_shift) * step;
                const float left_alpha = a + (c - a) * v;
                const float right_alpha = b + (d - b) * v;
                const float shift =
                    fraction(kShiftX * static_cast<float>(static_cast<std::uint32_t>(j) + 7 * x + 13 * y));
                for (int i = 0; i < steps; ++i) {
                    const float u = (static_cast<float>(i) + shift) * step;
                    visit(left_alpha + (right_alpha - left_alpha) * u);
                }
            }
        }
    }
}

}  // namespace

float coverage(const AlphaTexels& level, float cutoff) {
    std::size_t covered = 0;
    std::size_t all = 0;
    each_sample(level, [&](float alpha) {
        covered += alpha >= cutoff ? 1 : 0;
        ++all;
    });
    return static_cast<float>(static_cast<double>(covered) / static_cast<double>(all));
}

float alpha_scale_for_coverage(const AlphaTexels& level, float cutoff, float wanted) {
    std::vector<std::size_t> histogram(kBins, 0);
    std::size_t all = 0;
    each_sample(level, [&](float alpha) {
        const float bin = std::clamp(alpha, 0.0f, 1.0f) * static_cast<float>(kBins - 1);
        ++histogram[static_cast<std::size_t>(bin)];
        ++all;
    });
    // Down from the largest alpha until as much is covered as is wanted.
    const double most = static_cast<double>(wanted) * static_cast<double>(all);
    double covered = 0.0;
    std::size_t bin = kBins;
    while (bin > 1 && covered + 0.5 * static_cast<double>(histogram[bin - 1]) <= most) {
        --bin;
        covered += static_cast<double>(histogram[bin]);
    }
    const float threshold = static_cast<float>(bin) / static_cast<float>(kBins - 1);
    return cutoff / threshold;
}

}  // namespace candela::realtime
