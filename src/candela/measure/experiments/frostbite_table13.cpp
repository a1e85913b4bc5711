#include "candela/measure/numerics.hpp"
#include "shading/exposure.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

struct Rule {
    double aperture_f;
    const char* conditions;
};

constexpr std::array<Rule, 6> kRules{Rule{22.0, "snow and sand"},     Rule{16.0, "sunny"},
                                     Rule{11.0, "slightly overcast"}, Rule{8.0, "overcast"},
                                     Rule{5.6, "heavily overcast"},   Rule{4.0, "open shade or sunset"}};

Findings run() {
    ErrorStatistics from_stop;
    Table table{"ISO 100, 1/125 s",
                {"aperture", "conditions", "EV100", "spot meter, cd/m^2", "incident meter, lx",
                 "saturates at, cd/m^2"},
                {}};
    Series ev{"EV100", {}, {}, Stroke::points};
    double last = 0.0;
    for (const Rule& rule : kRules) {
        const float ev100 = ev100_from_camera(float(rule.aperture_f), 1.0f / 125.0f, 100.0f);
        if (last != 0.0) from_stop.add(last - double(ev100) - 1.0);
        last = double(ev100);
        table.rows.push_back({"f/" + number(rule.aperture_f), rule.conditions, fixed(double(ev100), 2),
                              fixed(double(luminance_from_ev100(ev100)), 0),
                              fixed(double(illuminance_from_ev100(ev100)), 0),
                              fixed(double(max_luminance_from_ev100(ev100)), 0)});
    }
    Findings out;
    out.text =
        "The rows are one stop apart, within the rounding of the f-numbers engraved on lenses (f/22 stands "
        "for 22.6, f/11 for 11.3, f/5.6 for 5.66).";
    out.measured = {
        at_most("steps between rows, largest distance from one stop", from_stop.max(), 0.12, "EV"),
        within("EV100 of f/16", double(ev100_from_camera(16.0f, 0.008f, 100.0f)), 14.9, 15.0),
        within("EV100 of f/4", double(ev100_from_camera(4.0f, 0.008f, 100.0f)), 10.9, 11.0)};
    out.tables = {table};
    return out;
}

}  // namespace

Experiment frostbite_table13() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Table 13", "The Sunny 16 rule in other light",
            "Exposure values of the table's apertures, and the luminance and illuminance that a meter would "
            "need to ask for them.",
            run};
}

}  // namespace candela::measure::experiments
