#include "candela/measure/numerics.hpp"
#include "shading/transfer.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

double srgb(double x) {
    return double(srgb_from_linear(float(x)));
}
double power(double x) {
    return double(gamma22_from_linear(float(x)));
}

Plot encoded(const char* title, double end) {
    const auto x = linspace(0.0, end, 401);
    return {title,
            "",
            {"linear value", 0.0, end},
            {"encoded value"},
            {curve("sRGB", x, srgb, Stroke::solid, 1), curve("power 1/2.2", x, power, Stroke::dashed, 2)}};
}

Findings run() {
    ErrorStatistics encode;
    ErrorStatistics decode;
    double worst_at = 0.0;
    double worst = 0.0;
    double dark_ratio = 0.0;
    for (const double x : linspace(0.0, 1.0, 20001)) {
        const double codes = 255.0 * (power(x) - srgb(x));
        encode.add(codes);
        if (std::abs(codes) > worst) {
            worst = std::abs(codes);
            worst_at = x;
        }
    }
    for (const double code : linspace(1.0, 255.0, 255)) {
        const double exact = double(linear_from_srgb(float(code / 255.0)));
        const double relative = double(linear_from_gamma22(float(code / 255.0))) / exact - 1.0;
        decode.add(100.0 * relative);
        if (code == 10.0) dark_ratio = relative + 1.0;
    }
    Findings out;
    out.text = "The power is off by " + number(encode.mean(), 2) + " codes of 8 bits on average and " +
               number(encode.max(), 3) + " at most, at a linear value of " + number(worst_at, 2) +
               ", always lifting the darkest values. Decoding code 10 with it gives " +
               number(dark_ratio, 2) +
               " of the right value. At the paper's example, linear 0.02, sRGB gives code " +
               fixed(255.0 * srgb(0.02), 1) + " and the power " + fixed(255.0 * power(0.02), 1) + ".";
    out.measured = {
        at_most("encoding, mean difference", encode.mean(), 2.0, "8-bit codes"),
        within("encoding, largest difference", encode.max(), 8.0, 9.0, "8-bit codes"),
        at_most("linear value where it is largest (dark)", worst_at, 0.01),
        within("linear 0.02: power minus sRGB", 255.0 * (power(0.02) - srgb(0.02)), 2.0, 4.5, "8-bit codes"),
        within("decoding code 10, over the right value", dark_ratio, 0.2, 0.35)};
    out.plots = {encoded("Linear to sRGB", 1.0),
                 encoded("The dark end", 0.05),
                 {"Power 1/2.2 minus sRGB",
                  "",
                  {"linear value", 1e-4, 1.0, Scale::logarithmic},
                  {"8-bit codes"},
                  {curve("difference", logspace(1e-4, 1.0, 300),
                         [](double x) { return 255.0 * (power(x) - srgb(x)); })}}};
    out.techniques = {{"gamma22_from_linear", "Frostbite section 5.1.5, listing 30", "the sRGB curve",
                       "srgb_from_linear, 0 to 1", "8-bit codes", encode.mean(), encode.max(),
                       [] { return cost_ns([](const vec4& u) { return gamma22_from_linear(u.x); }); }},
                      {"srgb_from_linear", "IEC 61966-2-1", "nothing: exact", "itself", "8-bit codes", 0.0,
                       0.0, [] { return cost_ns([](const vec4& u) { return srgb_from_linear(u.x); }); }}};
    return out;
}

}  // namespace

Experiment frostbite_figure75() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 75", "sRGB against a power of 2.2",
            "Both curves, encoded and decoded, in 8-bit codes; the dark end in particular.", run};
}

}  // namespace candela::measure::experiments
