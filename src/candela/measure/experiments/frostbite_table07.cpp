#include "candela/measure/numerics.hpp"
#include "shading/exposure.glsl"

namespace candela::measure::experiments {
namespace {

/// Printed in Table 7 for EV100 -4 to 16.
constexpr std::array<double, 21> kPrinted{0.008, 0.016, 0.031, 0.063, 0.125, 0.25, 0.5,  1,    2,    4,   8,
                                          16,    32,    64,    128,   256,   512,  1024, 2048, 4096, 8192};

Findings run() {
    ErrorStatistics rounding;  // in units of the printed value's last digit
    ErrorStatistics round_trip;
    Table table{"Table 7, K = 12.5", {"EV100", "printed, cd/m^2", "computed, cd/m^2"}, {}};
    for (std::size_t i = 0; i < kPrinted.size(); ++i) {
        const float ev = float(i) - 4.0f;
        const double luminance_nit = double(shading::luminance_from_ev100(ev));
        const double last_digit = kPrinted[i] < 0.2 ? 0.001 : kPrinted[i] < 1.0 ? 0.01 : 1.0;
        rounding.add((luminance_nit - kPrinted[i]) / last_digit);
        round_trip.add(double(shading::ev100_from_luminance(float(luminance_nit)) - ev));
        table.rows.push_back({number(double(ev)), number(kPrinted[i], 6), number(luminance_nit, 7)});
    }
    Findings out;
    out.text = "Every entry is the computed value rounded to the digits that are printed.";
    out.measured = {at_most("computed minus printed, largest", rounding.max(), 0.5001, "of the last digit"),
                    at_most("EV100 to luminance and back, largest error", round_trip.max(), 1e-5, "EV")};
    out.tables = {table};
    return out;
}

}  // namespace

Experiment frostbite_table07() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Table 7", "Exposure value to luminance",
            "Equation 12 for EV100 from -4 to 16 against the printed luminances.", run};
}

}  // namespace candela::measure::experiments
