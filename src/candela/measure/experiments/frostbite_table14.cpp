#include <cfloat>
#include <glm/gtc/packing.hpp>

#include "candela/measure/numerics.hpp"

namespace candela::measure::experiments {
namespace {

struct Format {
    const char* name;
    int mantissa_bits;
    int exponent_bits;
    bool hidden_one;
    double printed_largest;
    double printed_smallest;
    double printed_digits;
};

constexpr std::array<Format, 5> kFormats{
    Format{"32-bit float", 23, 8, true, 3.4028237e38, 1.175494e-38, 7.22},
    Format{"16-bit float", 10, 5, true, 65504.0, 6.10e-5, 3.31},
    Format{"14-bit float (RGB9E5)", 9, 5, false, 65408.0, 6.10e-5, 3.16},
    Format{"11-bit float", 6, 5, true, 65024.0, 6.10e-5, 2.5},
    Format{"10-bit float", 5, 5, true, 64512.0, 6.10e-5, 2.32}};

/// With a hidden one the top exponent is for infinity; RGB9E5 has neither.
double largest(const Format& f) {
    const double bias = std::exp2(f.exponent_bits - 1) - 1.0;
    if (!f.hidden_one)
        return (1.0 - std::exp2(-f.mantissa_bits)) * std::exp2(std::exp2(f.exponent_bits) - 1.0 - bias);
    return (2.0 - std::exp2(-f.mantissa_bits)) * std::exp2(std::exp2(f.exponent_bits) - 2.0 - bias);
}

/// Smallest that keeps all its mantissa bits.
double smallest(const Format& f) {
    const double bias = std::exp2(f.exponent_bits - 1) - 1.0;
    return f.hidden_one ? std::exp2(1.0 - bias) : std::exp2(-1.0 - bias);
}

/// Decimal digits of a mantissa, hidden one included.
double digits(const Format& f) {
    return (f.mantissa_bits + (f.hidden_one ? 1 : 0)) * std::log10(2.0);
}

/// What the bits really decode to, where GLM has the format.
double packed_largest(std::size_t format) {
    switch (format) {
        case 0:
            return double(FLT_MAX);
        case 1:
            return double(glm::unpackHalf1x16(0x7bffu));
        case 2:
            return double(glm::unpackF3x9_E1x5(0xf80001ffu).x);
        case 3:
            return double(glm::unpackF2x11_1x10(0x7bfu).x);
        default:
            return double(glm::unpackF2x11_1x10(0x3dfu << 22u).z);
    }
}

Findings run() {
    ErrorStatistics largest_error;
    ErrorStatistics packed_error;
    ErrorStatistics smallest_error;
    ErrorStatistics digits_error_wide;
    ErrorStatistics digits_error_small;
    Table table{"Table 14",
                {"format", "largest", "printed", "smallest normalized", "printed", "digits", "printed"},
                {}};
    for (std::size_t i = 0; i < kFormats.size(); ++i) {
        const Format& f = kFormats[i];
        largest_error.add(largest(f) / f.printed_largest - 1.0);
        packed_error.add(packed_largest(i) / largest(f) - 1.0);
        if (f.hidden_one) smallest_error.add(smallest(f) / f.printed_smallest - 1.0);
        (i < 2 ? digits_error_wide : digits_error_small).add(digits(f) - f.printed_digits);
        table.rows.push_back({f.name, number(largest(f), 8), number(f.printed_largest, 8),
                              number(smallest(f), 4), number(f.printed_smallest, 7), fixed(digits(f), 2),
                              number(f.printed_digits)});
    }
    Findings out;
    out.text =
        "The largest values follow from the bits, and decoding the bits gives the same numbers. The smallest "
        "ones too, but for RGB9E5: with a mantissa of 9 bits and no hidden one its smallest value "
        "that keeps all bits is 1.53e-5, not the printed 6.10e-5. The printed decimal digits are those of "
        "the mantissa for 32 and 16 bits (7.22, 3.31); for the small formats the same formula gives " +
        fixed(digits(kFormats[2]), 2) + ", " + fixed(digits(kFormats[3]), 2) + " and " +
        fixed(digits(kFormats[4]), 2) + " where the paper has 3.16, 2.5 and 2.32: those do not reproduce.";
    out.measured = {
        at_most("largest values against print, largest relative difference", largest_error.max(), 1e-6),
        at_most("largest values against the decoded bits, largest relative difference", packed_error.max(),
                1e-6),
        at_most("smallest values against print without RGB9E5, largest relative difference",
                smallest_error.max(), 1e-3),
        within("smallest value of RGB9E5 (printed 6.10e-5, not reproduced)", smallest(kFormats[2]), 1.52e-5,
               1.53e-5),
        at_most("digits of 32 and 16 bits against print, largest difference", digits_error_wide.max(), 0.01),
        within("digits of 14, 11 and 10 bits against print, largest difference (not reproduced)",
               digits_error_small.max(), 0.3, 0.6)};
    out.tables = {table};
    return out;
}

}  // namespace

Experiment frostbite_table14() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Table 14",
            "Limits and precision of small float formats",
            "Largest, smallest and decimal digits from the number of bits, and from decoding the bits.", run};
}

}  // namespace candela::measure::experiments
