#include "candela/measure/numerics.hpp"
#include "shading/lights/units.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

constexpr double kPower_lm = 1000.0;

double degrees(double deg) {
    return deg * kPi / 180.0;
}

/// Solid angle of the directions within a cone, by integrating over the sphere.
double cone_sr(double half_angle_rad) {
    return 2.0 * kPi * integrate([](double t) { return std::sin(t); }, 0.0, half_angle_rad);
}

/// Solid angle of a rectangular pyramid: the rectangle at distance 1, seen from its apex.
double frustum_sr(double a_rad, double b_rad) {
    const double x_end = std::tan(0.5 * a_rad);
    const double y_end = std::tan(0.5 * b_rad);
    return 4.0 * integrate(
                     [&](double x) {
                         return integrate([&](double y) { return std::pow(1.0 + x * x + y * y, -1.5); }, 0.0,
                                          y_end, 16);
                     },
                     0.0, x_end, 16);
}

Findings run() {
    ErrorStatistics spot;
    ErrorStatistics frustum;
    Table table{"Intensity of 1000 lm", {"light", "formula, cd", "emitted again by quadrature, lm"}, {}};
    const double point_cd = double(point_cd_from_lm(float(kPower_lm)));
    table.rows.push_back({"point", fixed(point_cd, 3), fixed(point_cd * cone_sr(kPi), 3)});
    for (const double angle : {5.0, 20.0, 60.0, 90.0, 180.0}) {
        const double cd = double(spot_cd_from_lm_exact(float(kPower_lm), float(degrees(0.5 * angle))));
        const double lm = cd * cone_sr(degrees(0.5 * angle));
        spot.add(lm / kPower_lm - 1.0);
        table.rows.push_back(
            {"spot, exact, opening " + number(angle) + " degrees", fixed(cd, 2), fixed(lm, 3)});
    }
    for (const auto& [a, b] :
         {std::pair{10.0, 10.0}, std::pair{40.0, 25.0}, std::pair{90.0, 60.0}, std::pair{120.0, 100.0}}) {
        const double cd = double(frustum_cd_from_lm(float(kPower_lm), float(degrees(a)), float(degrees(b))));
        const double lm = cd * frustum_sr(degrees(a), degrees(b));
        frustum.add(lm / kPower_lm - 1.0);
        table.rows.push_back(
            {"frustum, " + number(a) + " by " + number(b) + " degrees", fixed(cd, 2), fixed(lm, 3)});
    }
    const double spot_cd = double(spot_cd_from_lm(float(kPower_lm)));
    const double equal_at_deg = 2.0 * std::acos(0.5) * 180.0 / kPi;
    table.rows.push_back({"spot, Frostbite's convention, any opening", fixed(spot_cd, 2), "-"});
    const auto x = linspace(5.0, 180.0, 176);
    Findings out;
    out.text =
        "Integrated over their solid angles, the point, exact spot and frustum formulas give back the power "
        "they were made from. Frostbite's convention for spots, power / pi, keeps the "
        "intensity whatever the opening; it agrees with the exact one at an opening of " +
        number(equal_at_deg) + " degrees only, where the cone holds pi sr.";
    out.measured = {
        at_most("point: power back, relative error", std::abs(point_cd * cone_sr(kPi) / kPower_lm - 1.0),
                1e-6),
        at_most("spot: power back, largest relative error", spot.max(), 1e-5),
        at_most("frustum: power back, largest relative error", frustum.max(), 1e-5),
        within("opening at which power / pi is exact", equal_at_deg, 119.99, 120.01, "degrees"),
        at_most(
            "power / pi against the exact form there, relative",
            std::abs(spot_cd / double(spot_cd_from_lm_exact(float(kPower_lm), float(degrees(60.0)))) - 1.0),
            1e-5)};
    out.plots = {
        {"Intensity of a spot of 1000 lm",
         "",
         {"opening angle, degrees", 0.0, 180.0, Scale::linear, 30.0},
         {"intensity, cd", 100.0, 1e6, Scale::logarithmic},
         {curve("exact", x,
                [](double a) { return spot_cd_from_lm_exact(float(kPower_lm), float(degrees(0.5 * a))); }),
          curve(
              "Frostbite's convention", x, [&](double) { return spot_cd; }, Stroke::dashed)}}};
    out.tables = {table};
    return out;
}

}  // namespace

Experiment frostbite_table09() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Table 9", "Luminous power to intensity",
            "Each formula's intensity, integrated over the solid angle that the light fills.", run};
}

}  // namespace candela::measure::experiments
