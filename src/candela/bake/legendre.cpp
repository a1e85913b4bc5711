#include "candela/bake/legendre.hpp"

#include <algorithm>
#include <cmath>

// The loops over rows are worth twice as much where the processor has wide fused arithmetic.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__)
#define CANDELA_WIDE __attribute__((target_clones("arch=haswell", "default")))
#else
#define CANDELA_WIDE
#endif

namespace candela::bake {
namespace {

/// Rows at a time: what stays in registers.
constexpr std::size_t kBlock = 8;

/// Near the poles functions of high order vanish: below 1e-12 beyond this margin.
constexpr double kOrderMargin = 24.0;

/// Steps of the recurrence in l for fixed m, of functions whose square integrates to 1 over the sphere with
/// exp(i m phi): P_l = a (x P_{l-1} - b P_{l-2}).
struct Step {
    double a;
    double b;
};

std::vector<Step> recurrence(std::uint32_t m, std::uint32_t degree) {
    std::vector<Step> steps(degree + 1 - m);
    const double m2 = double(m) * double(m);
    for (std::uint32_t l = m + 1; l <= degree; ++l) {
        const double l2 = double(l) * double(l);
        const double p2 = (double(l) - 1.0) * (double(l) - 1.0);
        steps[l - m] = {std::sqrt((4.0 * l2 - 1.0) / (l2 - m2)), std::sqrt((p2 - m2) / (4.0 * p2 - 1.0))};
    }
    return steps;
}

/// Logarithm of the constant c of P_m^m = c sin^m.
double log_diagonal(std::uint32_t m) {
    double sum = -0.5 * std::log(4.0 * M_PI);
    for (std::uint32_t k = 1; k <= m; ++k) sum += 0.5 * std::log1p(0.5 / double(k));
    return sum;
}

/// First row, on a boundary of blocks, where order m has anything up to this degree.
std::size_t first_row(const LegendreRows& rows, std::uint32_t m, std::uint32_t degree) {
    const double least = (double(m) - kOrderMargin) / double(std::max(degree, 1u));
    if (least <= 0.0) return 0;
    const double log_least = std::log(least);
    std::size_t row = 0;
    while (row + 1 < rows.size() && rows.log_sine[row] < log_least) ++row;
    return row / kBlock * kBlock;
}

/// The functions of one order in one block of rows.
struct Block {
    double cosine[kBlock] = {};
    double now[kBlock] = {};
    double before[kBlock] = {};
    std::size_t count = 0;

    Block(const LegendreRows& rows, std::size_t first, std::uint32_t m, double log_start)
        : count(std::min(kBlock, rows.size() - first)) {
        for (std::size_t i = 0; i < count; ++i) {
            cosine[i] = rows.cosine[first + i];
            now[i] = std::exp(log_start + double(m) * rows.log_sine[first + i]);
        }
    }
};

/// One degree on.
inline __attribute__((always_inline)) void advance(Block& block, const Step& step) {
    for (std::size_t i = 0; i < kBlock; ++i) {
        const double next = step.a * (block.cosine[i] * block.now[i] - step.b * block.before[i]);
        block.before[i] = block.now[i];
        block.now[i] = next;
    }
}

CANDELA_WIDE void add_block(Block block, const Step* steps, std::size_t degrees,
                            const double (&values)[2][6][kBlock], double* out) {
    for (std::size_t l = 0; l < degrees; ++l) {
        if (l > 0) advance(block, steps[l]);
        const double(&v)[6][kBlock] = values[l & 1];
        // Four lanes each: the order of the sum is the code's own, on every processor.
        for (std::size_t c = 0; c < 6; ++c) {
            double lane[4];
            for (std::size_t i = 0; i < 4; ++i)
                lane[i] = block.now[i] * v[c][i] + block.now[i + 4] * v[c][i + 4];
            out[6 * l + c] += (lane[0] + lane[1]) + (lane[2] + lane[3]);
        }
    }
}

CANDELA_WIDE void expand_block(Block block, const Step* steps, std::size_t degrees, const double* in,
                               double (&values)[2][6][kBlock]) {
    for (std::size_t l = 0; l < degrees; ++l) {
        if (l > 0) advance(block, steps[l]);
        double(&v)[6][kBlock] = values[l & 1];
        for (std::size_t c = 0; c < 6; ++c) {
            for (std::size_t i = 0; i < kBlock; ++i) v[c][i] += in[6 * l + c] * block.now[i];
        }
    }
}

}  // namespace

LegendreRows::LegendreRows(std::uint32_t rows) : cosine((rows + 1) / 2), log_sine(cosine.size()) {
    for (std::size_t r = 0; r < cosine.size(); ++r) {
        const double polar = M_PI * (double(r) + 0.5) / double(rows);
        cosine[r] = std::cos(polar);
        log_sine[r] = std::log(std::sin(polar));
    }
}

void sum_over_rows(const LegendreRows& rows, std::uint32_t m, std::uint32_t degree,
                   const double* const (&even)[6], const double* const (&odd)[6], double* out) {
    const std::vector<Step> steps = recurrence(m, degree);
    const double start = log_diagonal(m);
    std::fill_n(out, 6 * steps.size(), 0.0);
    for (std::size_t first = first_row(rows, m, degree); first < rows.size(); first += kBlock) {
        const Block block(rows, first, m, start);
        double values[2][6][kBlock] = {};
        for (std::size_t c = 0; c < 6; ++c) {
            std::copy_n(even[c] + first, block.count, values[0][c]);
            std::copy_n(odd[c] + first, block.count, values[1][c]);
        }
        add_block(block, steps.data(), steps.size(), values, out);
    }
}

void sum_over_degrees(const LegendreRows& rows, std::uint32_t m, std::uint32_t degree, const double* in,
                      const double* scale, double* const (&even)[6], double* const (&odd)[6]) {
    const std::vector<Step> steps = recurrence(m, degree);
    const double start = log_diagonal(m);
    std::vector<double> scaled(6 * steps.size());
    for (std::size_t i = 0; i < scaled.size(); ++i) scaled[i] = in[i] * scale[m + i / 6];
    const std::size_t begin = first_row(rows, m, degree);
    for (std::size_t c = 0; c < 6; ++c) {
        std::fill_n(even[c], begin, 0.0);
        std::fill_n(odd[c], begin, 0.0);
    }
    for (std::size_t first = begin; first < rows.size(); first += kBlock) {
        const Block block(rows, first, m, start);
        double values[2][6][kBlock] = {};
        expand_block(block, steps.data(), steps.size(), scaled.data(), values);
        for (std::size_t c = 0; c < 6; ++c) {
            std::copy_n(values[0][c], block.count, even[c] + first);
            std::copy_n(values[1][c], block.count, odd[c] + first);
        }
    }
}

}  // namespace candela::bake
