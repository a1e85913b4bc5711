#include "candela/bake/legendre.hpp"

#include <algorithm>
#include <cmath>

#include "candela/bake/wide.hpp"

namespace candela::bake {
namespace {

/// Rows at a time: what stays in registers.
constexpr std::size_t kBlock = 8;

/// Near the poles functions of high order vanish: below 1e-12 beyond this margin.
constexpr double kOrderMargin = 24.0;

/// The step from degree l - 2 and l to l + 2 at fixed order, of functions whose square integrates to 1 over
/// the sphere with exp(i m phi): P_{l+2} = (a x^2 - c) P_l - b P_{l-2}. It is the recurrence x P_l =
/// beta_{l+1} P_{l+1} + beta_l P_{l-1}, taken twice, so that degrees of one parity are found without the
/// others.
struct Step {
    double a;
    double b;
    double c;
};

double beta(std::uint32_t l, std::uint32_t m) {
    const double l2 = double(l) * double(l);
    return std::sqrt((l2 - double(m) * double(m)) / (4.0 * l2 - 1.0));
}

std::vector<Step> recurrence(std::uint32_t m, std::uint32_t degree) {
    std::vector<Step> steps(degree + 1 - m);
    double before = 0.0;
    double now = 0.0;
    double next = beta(m + 1, m);
    for (std::uint32_t l = m; l <= degree; ++l) {
        const double after = beta(l + 2, m);
        const double a = 1.0 / (next * after);
        steps[l - m] = {a, a * now * before, a * (next * next + now * now)};
        before = now;
        now = next;
        next = after;
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

/// A number for each of some rows; arithmetic on it is row by row.
constexpr std::size_t kLanes = 4;
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));
constexpr std::size_t kParts = kBlock / kLanes;

/// The functions of one order in one block of rows.
struct Block {
    Lanes cosine2[kParts] = {};
    Lanes start[2][kParts] = {};  // of degrees m and m + 1
    std::size_t count = 0;

    Block(const LegendreRows& rows, std::size_t first, std::uint32_t m, double log_start)
        : count(std::min(kBlock, rows.size() - first)) {
        const double second = 1.0 / beta(m + 1, m);
        for (std::size_t i = 0; i < count; ++i) {
            const double cosine = rows.cosine[first + i];
            const double value = std::exp(log_start + double(m) * rows.log_sine[first + i]);
            cosine2[i / kLanes][i % kLanes] = cosine * cosine;
            start[0][i / kLanes][i % kLanes] = value;
            start[1][i / kLanes][i % kLanes] = second * cosine * value;
        }
    }
};

/// As an element of a std::vector, which forgets the alignment of the bare type.
struct alignas(sizeof(Lanes)) Sum {
    Lanes value = {};
};

struct BlockValues {
    Lanes part[2][6][kParts] = {};  // by the parity of l - m
};

inline __attribute__((always_inline)) void advance(Lanes (&now)[kParts], Lanes (&before)[kParts],
                                                   const Lanes (&cosine2)[kParts], const Step& step) {
    for (std::size_t p = 0; p < kParts; ++p) {
        const Lanes next = (step.a * cosine2[p] - step.c) * now[p] - step.b * before[p];
        before[p] = now[p];
        now[p] = next;
    }
}

CANDELA_WIDE void add_block(const Block& block, const Step* steps, std::size_t degrees,
                            const BlockValues& values, Sum* out) {
    for (std::size_t parity = 0; parity < 2; ++parity) {
        Lanes now[kParts] = {block.start[parity][0], block.start[parity][1]};
        Lanes before[kParts] = {};
        const Lanes cosine2[kParts] = {block.cosine2[0], block.cosine2[1]};
        for (std::size_t l = parity; l < degrees; l += 2) {
            for (std::size_t c = 0; c < 6; ++c)
                out[6 * l + c].value +=
                    now[0] * values.part[parity][c][0] + now[1] * values.part[parity][c][1];
            advance(now, before, cosine2, steps[l]);
        }
    }
}

CANDELA_WIDE void expand_block(const Block& block, const Step* steps, std::size_t degrees, const double* in,
                               BlockValues& values) {
    for (std::size_t parity = 0; parity < 2; ++parity) {
        Lanes now[kParts] = {block.start[parity][0], block.start[parity][1]};
        Lanes before[kParts] = {};
        const Lanes cosine2[kParts] = {block.cosine2[0], block.cosine2[1]};
        Lanes sums[6][kParts] = {};
        for (std::size_t l = parity; l < degrees; l += 2) {
            for (std::size_t c = 0; c < 6; ++c) {
                for (std::size_t p = 0; p < kParts; ++p) sums[c][p] += in[6 * l + c] * now[p];
            }
            advance(now, before, cosine2, steps[l]);
        }
        for (std::size_t c = 0; c < 6; ++c) {
            for (std::size_t p = 0; p < kParts; ++p) values.part[parity][c][p] = sums[c][p];
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
    std::vector<Sum> sums(6 * steps.size());
    for (std::size_t first = first_row(rows, m, degree); first < rows.size(); first += kBlock) {
        const Block block(rows, first, m, start);
        BlockValues values;
        for (std::size_t c = 0; c < 6; ++c) {
            for (std::size_t i = 0; i < block.count; ++i) {
                values.part[0][c][i / kLanes][i % kLanes] = even[c][first + i];
                values.part[1][c][i / kLanes][i % kLanes] = odd[c][first + i];
            }
        }
        add_block(block, steps.data(), steps.size(), values, sums.data());
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const Lanes& sum = sums[i].value;
        out[i] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
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
        BlockValues values;
        expand_block(block, steps.data(), steps.size(), scaled.data(), values);
        for (std::size_t c = 0; c < 6; ++c) {
            for (std::size_t i = 0; i < block.count; ++i) {
                even[c][first + i] = values.part[0][c][i / kLanes][i % kLanes];
                odd[c][first + i] = values.part[1][c][i / kLanes][i % kLanes];
            }
        }
    }
}

}  // namespace candela::bake
