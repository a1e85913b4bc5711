#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "candela/measure/experiment.hpp"
#include "shading/sampling.glsl"
#include "shading/sequence.glsl"

/// Quadrature, error statistics and timing for the experiments.
namespace candela::measure {

constexpr double kPi = 3.14159265358979323846;

/// `count` >= 2 values from low to high, both included.
[[nodiscard]] std::vector<double> linspace(double low, double high, int count);
/// As linspace in the logarithm; both > 0.
[[nodiscard]] std::vector<double> logspace(double low, double high, int count);

/// Shortest text with this many significant digits.
[[nodiscard]] std::string number(double value, int digits = 4);
/// A measured value: 4 significant digits, 6 from 1000 on, so that large ones show no power of ten.
[[nodiscard]] std::string readable(double value);
/// A cost: 3 significant digits without a power of ten.
[[nodiscard]] std::string cost_text(double ns);
/// With this many digits after the point; never "-0".
[[nodiscard]] std::string fixed(double value, int decimals);

/// The curve y = f(x).
template <class F>
[[nodiscard]] Series curve(std::string name, const std::vector<double>& x, F f, Stroke stroke = Stroke::solid,
                           int color = -1) {
    Series out{std::move(name), x, {}, stroke, color};
    for (const double at : x) out.y.push_back(static_cast<double>(f(at)));
    return out;
}

/// Integral of f over [a, b]: Gauss-Legendre, 8 points in each of `panels` equal parts.
template <class F>
[[nodiscard]] double integrate(F f, double a, double b, int panels = 64) {
    constexpr std::array<double, 4> at{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                       0.9602898564975363};
    constexpr std::array<double, 4> weight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                           0.1012285362903763};
    const double half = 0.5 * (b - a) / panels;
    double sum = 0.0;
    for (int panel = 0; panel < panels; ++panel) {
        const double centre = a + half * (2 * panel + 1);
        for (std::size_t i = 0; i < at.size(); ++i)
            sum += weight[i] * (f(centre - half * at[i]) + f(centre + half * at[i]));
    }
    return sum * half;
}

/// Unit direction with this cosine to z, in the xz plane.
[[nodiscard]] inline glm::vec3 at_cosine(float cosine) {
    return {std::sqrt(std::max(1.0f - cosine * cosine, 0.0f)), 0.0f, cosine};
}

/// Integral of f(l) NoL over the hemisphere of z, by `side`^2 points that follow the cosine and as many that
/// follow a GGX lobe of this alpha seen from v, weighted by the balance heuristic.
template <class F>
[[nodiscard]] double integrate_hemisphere(const glm::vec3& v, float alpha, int side, F f) {
    double total = 0.0;
    const auto add = [&](const glm::vec3& l) {
        if (l.z <= 0.0f) return;
        const glm::vec3 h = glm::normalize(v + l);
        const double density =
            double(shading::pdf_cosine_hemisphere(l.z)) +
            double(shading::pdf_reflected(shading::pdf_ggx_vndf(v, h, alpha), glm::dot(v, h)));
        total += double(f(l)) * double(l.z) / density;
    };
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const glm::vec2 u((float(i) + 0.5f) / float(side), (float(j) + 0.5f) / float(side));
            add(shading::sample_cosine_hemisphere(u));
            const glm::vec3 h = shading::sample_ggx_vndf(u, v, alpha);
            add(2.0f * glm::dot(v, h) * h - v);
        }
    }
    return total / (double(side) * double(side));
}

/// Mean and maximum of magnitudes. A value that is not finite makes both infinite, so that no bound is met.
class ErrorStatistics {
  public:
    void add(double error) {
        if (!std::isfinite(error)) error = std::numeric_limits<double>::infinity();
        sum_ += std::abs(error);
        max_ = std::max(max_, std::abs(error));
        ++count_;
    }
    [[nodiscard]] double mean() const { return count_ == 0 ? 0.0 : sum_ / double(count_); }
    [[nodiscard]] double max() const { return max_; }

  private:
    double sum_ = 0.0;
    double max_ = 0.0;
    std::size_t count_ = 0;
};

/// ns per call of f(vec4 of numbers in (0,1)) -> float: the best of five runs over inputs that stay in the
/// first-level cache. A throughput: the compiler may overlap or vectorize calls, as it may in a loop over
/// pixels.
template <class F>
[[nodiscard]] double cost_ns(F f) {
    using Clock = std::chrono::steady_clock;
    std::array<glm::vec4, 256> inputs;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const glm::vec2 a = shading::sobol_owen(shading::uint(i), 1u);
        const glm::vec2 b = shading::sobol_owen(shading::uint(i), 2u);
        inputs[i] = 0.001f + 0.998f * glm::vec4(a.x, a.y, b.x, b.y);
    }
    double best = std::numeric_limits<double>::infinity();
    volatile float sink = 0.0f;
    for (int run = 0; run < 5; ++run) {
        std::size_t calls = 0;
        float sum = 0.0f;
        const auto start = Clock::now();
        double elapsed_ns = 0.0;
        while (elapsed_ns < 1.0e6) {
            for (const glm::vec4& u : inputs) sum += f(u);
            sink = sum;
            calls += inputs.size();
            elapsed_ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
        }
        best = std::min(best, elapsed_ns / double(calls));
    }
    (void)sink;
    return best;
}

}  // namespace candela::measure
