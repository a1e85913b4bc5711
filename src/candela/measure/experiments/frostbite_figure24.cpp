#include <glm/geometric.hpp>

#include "candela/measure/area_truth.hpp"
#include "candela/measure/numerics.hpp"
#include "shading/lights/units.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;
using glm::dvec3;

/// The distances of the set-up in m, from the bulb's centre to the meter; the last one touches the bulb.
constexpr std::array<double, 5> kDistance_m{1.0, 0.5, 0.25, 0.1, 0.055};
/// The light meter's readings for 625 lm (Table 10).
constexpr std::array<double, 5> kMeter_lx{57, 213, 940, 5800, 17000};
constexpr double kPower_lm = 625.0;
constexpr double kBulb_m = 0.03;  ///< a household bulb's radius
const dvec3 kUp(0.0, 0.0, 1.0);

double point_lx(double d) {
    return double(lx_from_cd(point_cd_from_lm(float(kPower_lm)), float(d)));
}
double bulb_lx(double d) {
    return double(sphere_nit_from_lm(float(kPower_lm), float(kBulb_m))) *
           illuminance_truth(kUp, SphereLight{d * kUp, kBulb_m});
}
/// A tubular lamp of the same power and 10 cm, seen from the side.
double tube_lx(double d) {
    const TubeLight tube{d * kUp, dvec3(1.0, 0.0, 0.0), 0.05, 0.015};
    return double(tube_nit_from_lm(float(kPower_lm), 0.015f, 0.1f)) * illuminance_truth(kUp, tube);
}

Findings run() {
    ErrorStatistics bulb;
    Table table{"625 lm in a black room, lx",
                {"distance, m", "point", "bulb of 3 cm radius", "tube of 10 cm", "meter (Table 10)"},
                {}};
    Series meter{"light meter", {}, {}, Stroke::points};
    for (std::size_t i = 0; i < kDistance_m.size(); ++i) {
        const double d = kDistance_m[i];
        bulb.add(bulb_lx(d) / point_lx(d) - 1.0);
        meter.x.push_back(d);
        meter.y.push_back(kMeter_lx[i]);
        table.rows.push_back({number(d), readable(point_lx(d)), readable(bulb_lx(d)), readable(tube_lx(d)),
                              readable(kMeter_lx[i])});
    }
    const auto x = logspace(0.05, 1.2, 60);
    const double tube_at_1m = tube_lx(1.0) / point_lx(1.0);
    const double tube_near = tube_lx(0.055) / point_lx(0.055);
    Findings out;
    out.text =
        "In the set-up of the figure (a black room, the meter facing the bulb) a round bulb of any size "
        "gives "
        "what the point gives, down to the glass, so the meter's readings can test the units alone; a "
        "tubular lamp, seen "
        "from the side, goes from " +
        number(tube_at_1m, 3) + " of the point at 1 m to " + number(tube_near, 3) +
        " next to the glass. The readings are 3 to 18 % above the point: lamps send less down their socket "
        "and more to "
        "the front.";
    out.measured = {at_most("bulb against point, largest relative error", bulb.max(), 1e-5),
                    within("tube over point at 1 m", tube_at_1m, 1.1, 1.3),
                    within("tube over point at 5.5 cm", tube_near, 0.6, 0.9)};
    out.plots = {{"Illuminance facing the lamp",
                  "",
                  {"distance, m", 0.05, 1.2, Scale::logarithmic},
                  {"illuminance, lx", 30.0, 5e4, Scale::logarithmic},
                  {curve("point", x, point_lx), curve("bulb", x, bulb_lx, Stroke::dotted),
                   curve("tube of 10 cm", x, tube_lx, Stroke::dashed), meter}}};
    out.tables = {table};
    return out;
}

}  // namespace

Experiment frostbite_figure24() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 24", "The set-up of the light meter",
            "The paper's measurement in a black room, computed with a point, with a bulb of a bulb's size "
            "and with a tube.",
            run};
}

}  // namespace candela::measure::experiments
