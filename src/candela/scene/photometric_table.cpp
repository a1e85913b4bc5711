#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "candela/scene/photometric.hpp"

namespace candela::scene {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
/// Files have their angles with up to three decimals, 22.5 or 11.25 or 33.333.
constexpr double kSameAngle_deg = 1e-3;

bool is_multiple(double angle, double step) {
    return std::abs(angle - step * std::round(angle / step)) <= kSameAngle_deg;
}

bool are_multiples(const std::vector<double>& angles, double step) {
    return std::all_of(angles.begin(), angles.end(), [&](double a) { return is_multiple(a, step); });
}

bool has_jump(const PhotometricProfile& p) {
    return std::adjacent_find(p.vertical_deg.begin(), p.vertical_deg.end()) != p.vertical_deg.end();
}

/// The smallest number of equal steps of `range` for which `fits(step)`; the largest where there is none.
template <typename Fits>
int fitting_steps(double range, int least, int most, const Fits& fits) {
    for (int count = least; count <= most; ++count) {
        if (fits(range / count)) return count;
    }
    return most;
}

/// A piecewise linear function; two equal places are a jump.
struct Curve {
    const std::vector<double>* at;
    std::vector<double> value;

    [[nodiscard]] double between(std::size_t i, double x) const {
        const double from = (*at)[i], to = (*at)[i + 1];
        return to > from ? std::lerp(value[i], value[i + 1], (x - from) / (to - from)) : value[i];
    }
    /// At a jump the mean of its sides: what a table without jumps can say of it at least loss of flux.
    [[nodiscard]] double operator()(double x) const {
        const auto low = std::lower_bound(at->begin(), at->end(), x - kSameAngle_deg);
        const auto high = std::upper_bound(at->begin(), at->end(), x + kSameAngle_deg);
        if (low < high) {
            double sum = 0.0;
            for (auto i = low; i < high; ++i) sum += value[std::size_t(i - at->begin())];
            return sum / double(high - low);
        }
        const auto i = std::clamp<std::ptrdiff_t>(low - at->begin() - 1, 0, std::ptrdiff_t(at->size()) - 2);
        return between(std::size_t(i), x);
    }
};

/// Means of a curve under the hat functions of `count` nodes `step` apart. `weight` is that of a place;
/// `wraps`: the node after the last is the first.
template <typename Weight>
std::vector<double> projected(const Curve& curve, std::size_t count, double step, bool wraps,
                              const Weight& weight) {
    // Gauss-Legendre with four points: exact to degree 7, where the curve times the hat has 2 and the sine of
    // a few degrees little more.
    constexpr std::array<double, 4> points{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                           0.8611363115940526};
    constexpr std::array<double, 4> weights{0.3478548451374539, 0.6521451548625461, 0.6521451548625461,
                                            0.3478548451374539};
    std::vector<double> sum(count), total(count);
    const double end = curve.at->back();
    std::size_t piece = 0;
    for (double from = 0.0; from < end - 1e-12;) {
        while (piece + 2 < curve.at->size() && (*curve.at)[piece + 1] <= from + 1e-12) ++piece;
        const auto cell = std::size_t(std::floor(from / step + 1e-9));
        const double to = std::min({(*curve.at)[piece + 1], double(cell + 1) * step, end});
        const std::size_t next = wraps ? (cell + 1) % count : std::min(cell + 1, count - 1);
        for (std::size_t k = 0; k < points.size(); ++k) {
            const double x = 0.5 * (from + to) + 0.5 * (to - from) * points[k];
            const double mass = 0.5 * (to - from) * weights[k] * weight(x);
            const double right = x / step - double(cell);
            sum[cell % count] += (1.0 - right) * mass * curve.between(piece, x);
            total[cell % count] += (1.0 - right) * mass;
            sum[next] += right * mass * curve.between(piece, x);
            total[next] += right * mass;
        }
        from = to;
    }
    for (std::size_t i = 0; i < count; ++i) sum[i] = total[i] > 0.0 ? sum[i] / total[i] : 0.0;
    return sum;
}

std::vector<double> along_vertical(const Curve& curve, std::size_t height) {
    const double step = 180.0 / double(height - 1);
    if (!are_multiples(*curve.at, step))
        return projected(curve, height, step, false, [](double x) { return std::sin(x * kDegree); });
    std::vector<double> out(height);
    for (std::size_t y = 0; y < height; ++y) out[y] = curve(double(y) * step);
    return out;
}

std::vector<double> along_horizontal(const Curve& curve, std::size_t width) {
    const double step = 360.0 / double(width);
    const bool same_everywhere = curve.at->size() == 2;
    if (!same_everywhere && !are_multiples(*curve.at, step))
        return projected(curve, width, step, true, [](double) { return 1.0; });
    std::vector<double> out(width);
    for (std::size_t x = 0; x < width; ++x) out[x] = curve(double(x) * step);
    return out;
}

}  // namespace

PhotometricGrid fitting_grid(std::span<const PhotometricProfile> profiles, int max_width, int max_height) {
    // A table has no jumps: a step this small loses under half a percent of a flat web's flux to one.
    constexpr double jump_step_deg = 0.5;
    PhotometricGrid out;
    out.height =
        1 + fitting_steps(180.0, 1, max_height - 1, [&](double step) {
            return std::all_of(profiles.begin(), profiles.end(), [&](const auto& p) {
                return are_multiples(p.vertical_deg, step) && (!has_jump(p) || step <= jump_step_deg);
            });
        });
    out.width = fitting_steps(360.0, 1, max_width, [&](double step) {
        return std::all_of(profiles.begin(), profiles.end(), [&](const auto& p) {
            return p.horizontal_deg.size() == 2 || are_multiples(p.horizontal_deg, step);
        });
    });
    return out;
}

std::vector<float> resample(const PhotometricProfile& profile, int width, int height) {
    const std::size_t source_rows = profile.vertical_deg.size();
    const std::size_t columns = profile.horizontal_deg.size();
    const auto w = std::size_t(std::max(width, 1)), h = std::size_t(std::max(height, 2));
    std::vector<std::vector<double>> tall(columns);
    for (std::size_t c = 0; c < columns; ++c) {
        const auto first = profile.candela.begin() + std::ptrdiff_t(c * source_rows);
        tall[c] = along_vertical({&profile.vertical_deg, {first, first + std::ptrdiff_t(source_rows)}}, h);
    }
    std::vector<float> out(w * h);
    for (std::size_t y = 0; y < h; ++y) {
        Curve row{&profile.horizontal_deg, std::vector<double>(columns)};
        for (std::size_t c = 0; c < columns; ++c) row.value[c] = tall[c][y];
        const std::vector<double> values = along_horizontal(row, w);
        std::transform(values.begin(), values.end(), out.begin() + std::ptrdiff_t(y * w),
                       [](double value) { return float(value); });
    }
    return out;
}

}  // namespace candela::scene
