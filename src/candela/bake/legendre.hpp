#pragma once

#include <cstdint>
#include <vector>

namespace candela::bake {

/// Rows of a grid that are mirrored at the equator, from the pole to the equator.
struct LegendreRows {
    std::vector<double> cosine;
    std::vector<double> log_sine;

    explicit LegendreRows(std::uint32_t rows);
    [[nodiscard]] std::size_t size() const noexcept { return cosine.size(); }
};

/// For order m and all degrees up to `degree`: out[6 (l - m) + c] = sum over rows of the normalized Legendre
/// function times even[c] or odd[c], by the parity of l - m. Arrays of rows.size() each.
void sum_over_rows(const LegendreRows& rows, std::uint32_t m, std::uint32_t degree,
                   const double* const (&even)[6], const double* const (&odd)[6], double* out);

/// The other way: even[c] and odd[c] of each row = sum over degrees of in[6 (l - m) + c] scale[l] times the
/// normalized Legendre function.
void sum_over_degrees(const LegendreRows& rows, std::uint32_t m, std::uint32_t degree, const double* in,
                      const double* scale, double* const (&even)[6], double* const (&odd)[6]);

}  // namespace candela::bake
