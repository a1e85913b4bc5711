#include "candela/measure/numerics.hpp"
#include "shading/exposure.glsl"
#include "shading/photometry.glsl"
#include "shading/transfer.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

Findings run() {
    // Table 11 of the paper, 1 pm: sun and sky together across the sun's rays, and on level ground.
    constexpr double facing_lx = 150400.0;
    constexpr double level_lx = 113600.0;
    Table table{"A sunny day at f/16, ISO 100",
                {"shutter", "subject", "illuminance, lx", "luminance, cd/m^2", "exposed value", "8-bit sRGB"},
                {}};
    double grey_level = 0.0;
    double white_level = 0.0;
    double metered_off = 0.0;
    for (const double shutter : {100.0, 125.0}) {
        const float ev100 = ev100_from_camera(16.0f, float(1.0 / shutter), 100.0f);
        for (const auto& [subject, reflectance] :
             {std::pair{"grey card, 18 %", 0.18}, std::pair{"white paper, 80 %", 0.8},
              std::pair{"asphalt, 7 %", 0.07}}) {
            for (const double lx : {level_lx, facing_lx}) {
                const float nit = nit_from_lx_lambertian(float(lx), float(reflectance));
                const float exposed = nit * exposure_from_ev100(ev100);
                if (shutter == 125.0 && lx == level_lx && reflectance == 0.18) {
                    grey_level = double(exposed);
                    metered_off = double(ev100_from_luminance(nit) - ev100);
                }
                if (shutter == 125.0 && lx == level_lx && reflectance == 0.8) white_level = double(exposed);
                table.rows.push_back({"1/" + number(shutter) + " s", subject, number(lx, 7),
                                      fixed(double(nit), 0), fixed(double(exposed), 3),
                                      fixed(255.0 * double(srgb_from_linear(saturate(exposed))), 0)});
            }
        }
    }
    const double ev100 = double(ev100_from_camera(16.0f, 1.0f / 125.0f, 100.0f));
    const double rule_lx = double(illuminance_from_ev100(float(ev100)));
    Findings out;
    out.text = "f/16 at 1/125 s and ISO 100 is EV100 " + fixed(ev100, 2) +
               ", which an incident meter asks for at " + fixed(rule_lx, 0) +
               " lx. With the paper's own daylight of Table 11 (" + number(level_lx, 6) +
               " lx on level ground at 1 pm) a grey card of 18 % comes out at " + fixed(grey_level, 3) +
               " of saturation and white paper at " + fixed(white_level, 3) + ", facing the sun (" +
               number(facing_lx, 6) + " lx) at " + fixed(white_level * facing_lx / level_lx, 3) +
               ": nothing of that clips (at 1/100 s the last would), and grey is near the middle "
               "of the curve. A spot meter on the card would "
               "differ from the rule by " +
               fixed(metered_off, 2) + " stops.";
    out.measured = {
        within("EV100 of f/16, 1/125 s, ISO 100", ev100, 14.95, 14.98),
        within("grey card of 18 % on level ground, exposed", grey_level, 0.168, 0.171),
        within("white paper of 80 % on level ground, exposed", white_level, 0.745, 0.76),
        within("white paper of 80 % across the sun's rays, exposed", white_level * facing_lx / level_lx, 0.99,
               1.0),
        within("spot meter on the grey card minus the rule", metered_off, 0.68, 0.72, "EV"),
        within("illuminance that an incident meter asks the rule for", rule_lx, 79900.0, 80100.0, "lx")};
    out.tables = {table};
    return out;
}

}  // namespace

Experiment frostbite_sunny16() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Section 5.1.4", "Sunny 16",
            "What the rule's exposure makes of a grey card and white paper in the daylight that the paper "
            "measured (Table 11).",
            run};
}

}  // namespace candela::measure::experiments
