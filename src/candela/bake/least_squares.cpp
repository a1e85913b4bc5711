#include "candela/bake/least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace candela::bake {
namespace {

constexpr int kRounds = 60;

/// Gauss's elimination with row pivots.
std::vector<double> solve(std::vector<double> a, std::vector<double> b) {
    const std::size_t n = b.size();
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t pivot = i;
        for (std::size_t row = i + 1; row < n; ++row)
            if (std::abs(a[row * n + i]) > std::abs(a[pivot * n + i])) pivot = row;
        for (std::size_t k = 0; k < n; ++k) std::swap(a[i * n + k], a[pivot * n + k]);
        std::swap(b[i], b[pivot]);
        for (std::size_t row = i + 1; row < n; ++row) {
            const double factor = a[row * n + i] / a[i * n + i];
            for (std::size_t k = i; k < n; ++k) a[row * n + k] -= factor * a[i * n + k];
            b[row] -= factor * b[i];
        }
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[i * n + k] * b[k];
        b[i] /= a[i * n + i];
    }
    return b;
}

}  // namespace

NormalEquations& NormalEquations::operator+=(const NormalEquations& other) {
    error += other.error;
    for (std::size_t k = 0; k < gradient.size(); ++k) gradient[k] += other.gradient[k];
    for (std::size_t k = 0; k < matrix.size(); ++k) matrix[k] += other.matrix[k];
    return *this;
}

std::vector<double> least_squares(std::vector<double> unknowns, const SumOfSquares& squares) {
    const std::size_t n = unknowns.size();
    double damping = 1.0e-3;
    double error = squares(unknowns, false).error;
    bool better = true;
    for (int round = 0; round < kRounds && better; ++round) {
        const NormalEquations at = squares(unknowns, true);
        better = false;
        for (int attempt = 0; attempt < 8 && !better; ++attempt) {
            std::vector<double> damped = at.matrix;
            for (std::size_t i = 0; i < n; ++i) damped[i * n + i] += damping * at.matrix[i * n + i] + 1.0e-9;
            const std::vector<double> step = solve(std::move(damped), at.gradient);
            std::vector<double> next = unknowns;
            for (std::size_t i = 0; i < n; ++i) next[i] -= step[i];
            const double next_error = squares(next, false).error;
            if (!(next_error < error)) {
                damping *= 5.0;
                continue;
            }
            better = error - next_error > 1.0e-6 * error;
            error = next_error;
            unknowns = std::move(next);
            damping = std::max(0.2 * damping, 1.0e-9);
            if (!better) break;
        }
    }
    return unknowns;
}

}  // namespace candela::bake
