#include "candela/measure/numerics.hpp"
#include "shading/lights/units.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

/// Area of the surface of revolution of radius r(z) over [z0, z1]; slope: dr/dz.
template <class R, class Slope>
double revolution_area(R r, Slope slope, double z0, double z1) {
    // z = middle + half sin(t) takes away the infinite slope at the poles.
    const double middle = 0.5 * (z0 + z1);
    const double half = 0.5 * (z1 - z0);
    return integrate(
        [&](double t) {
            const double z = middle + half * std::sin(t);
            return 2.0 * kPi * r(z) * std::sqrt(1.0 + slope(z) * slope(z)) * half * std::cos(t);
        },
        -0.5 * kPi, 0.5 * kPi);
}

double sphere_quadrature(double radius) {
    return revolution_area([&](double z) { return std::sqrt(radius * radius - z * z); },
                           [&](double z) { return -z / std::sqrt(radius * radius - z * z); }, -radius,
                           radius);
}

/// Power of one side of a patch of 1 m^2 of this luminance: the cosine-weighted hemisphere.
double lambertian_lm(double luminance_nit) {
    return luminance_nit * 2.0 * kPi *
           integrate([](double t) { return std::cos(t) * std::sin(t); }, 0.0, 0.5 * kPi);
}

Findings run() {
    const double r = 0.15;
    const double width = 0.8;
    const double height = 0.4;
    struct Row {
        const char* shape;
        double luminance_nit;
        double area_m2;
    };
    const std::array<Row, 4> rows{
        Row{"sphere, radius 15 cm", double(sphere_nit_from_lm(1500.0f, float(r))), sphere_quadrature(r)},
        Row{"disk, radius 15 cm", double(disk_nit_from_lm(1500.0f, float(r))),
            2.0 * kPi * integrate([](double x) { return x; }, 0.0, r)},
        Row{"tube, radius 15 cm, 80 cm between the ends' centres",
            double(tube_nit_from_lm(1500.0f, float(r), float(width))),
            sphere_quadrature(r) + 2.0 * kPi * r * width},
        Row{"rectangle, 80 x 40 cm", double(rectangle_nit_from_lm(1500.0f, float(width), float(height))),
            width * height}};
    ErrorStatistics power;
    Table table{"1500 lm",
                {"shape", "luminance, cd/m^2", "area by quadrature, m^2", "emitted again by quadrature, lm"},
                {}};
    for (const Row& row : rows) {
        const double lm = lambertian_lm(row.luminance_nit) * row.area_m2;
        power.add(lm / 1500.0 - 1.0);
        table.rows.push_back({row.shape, fixed(row.luminance_nit, 2), fixed(row.area_m2, 5), fixed(lm, 3)});
    }
    const double example = rows[0].luminance_nit;
    Findings out;
    out.text = "The printed example, 1500 lm from a sphere of 15 cm, computes to " + fixed(example, 2) +
               " cd/m^2; 1688 is that number cut off after the point, rounded it is 1689. All four formulas "
               "give back "
               "their power when the emission is integrated over area and hemisphere.";
    out.measured = {within("sphere of 15 cm, 1500 lm (printed: 1688)", example, 1688.0, 1689.0, "cd/m^2"),
                    at_most("power back, largest relative error over the four shapes", power.max(), 1e-5)};
    out.tables = {table};
    return out;
}

}  // namespace

Experiment frostbite_table12() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Table 12", "Luminous power to luminance",
            "The luminance of each shape, integrated over its area (by quadrature) and the hemisphere.", run};
}

}  // namespace candela::measure::experiments
