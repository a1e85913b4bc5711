#pragma once

#include <functional>
#include <vector>

namespace candela::bake {

/// Half the gradient of a sum of squares and the Gauss-Newton matrix by its unknowns, row by row.
struct NormalEquations {
    double error = 0.0;
    std::vector<double> gradient;
    std::vector<double> matrix;

    NormalEquations& operator+=(const NormalEquations& other);
};

/// Of a sum of squares at some unknowns; gradient and matrix may be left empty where they are not asked for.
using SumOfSquares = std::function<NormalEquations(const std::vector<double>& unknowns, bool with_matrix)>;

/// Levenberg and Marquardt's method, from a start; deterministic.
[[nodiscard]] std::vector<double> least_squares(std::vector<double> start, const SumOfSquares& squares);

}  // namespace candela::bake
