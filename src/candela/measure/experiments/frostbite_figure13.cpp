#include "candela/measure/numerics.hpp"
#include "shading/fresnel.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

struct Material {
    const char* name;
    double ior;  ///< at 589 nm
};

constexpr std::array<Material, 6> kMaterials{Material{"ice", 1.31},  Material{"water", 1.333},
                                             Material{"glass", 1.5}, Material{"quartz", 1.544},
                                             Material{"ruby", 1.77}, Material{"diamond", 2.417}};

Findings run() {
    const auto x = linspace(0.0, 1.0, 201);
    Series marks{"materials", {}, {}, Stroke::points, 2};
    Table table{"Materials and the reflectance parameter that gives their f0",
                {"material", "index of refraction", "f0, %", "reflectance", "8-bit value"},
                {}};
    for (const Material& m : kMaterials) {
        const double f0 = double(f0_from_ior(float(m.ior)));
        const double reflectance = std::sqrt(f0 / 0.16);
        table.rows.push_back(
            {m.name, number(m.ior), fixed(100.0 * f0, 2),
             reflectance <= 1.0 ? fixed(reflectance, 3) : "out of range (" + fixed(reflectance, 3) + ")",
             reflectance <= 1.0 ? fixed(255.0 * reflectance, 0) : "-"});
        marks.x.push_back(reflectance);
        marks.y.push_back(100.0 * f0);
    }
    const double code_128 = 100.0 * double(f0_from_reflectance(128.0f / 255.0f));
    const double ruby = 100.0 * double(f0_from_ior(1.77f));
    const double diamond = 100.0 * double(f0_from_ior(2.417f));
    Findings out;
    out.text =
        "The code value 128 gives " + number(code_128, 4) +
        " % (the paper aims at 4 %), the end of the range 16 %. From the indices of refraction ruby has " +
        number(ruby, 3) + " % and diamond " + number(diamond, 3) +
        " %: the paper's 8 % and 17 %. Diamond is just out of range, as the paper accepts.";
    out.measured = {within("f0 of 8-bit 128 (printed: 4 %)", code_128, 3.95, 4.05, "%"),
                    within("f0 at reflectance 1 (printed: 16 %)", 100.0 * double(f0_from_reflectance(1.0f)),
                           15.999, 16.001, "%"),
                    within("ruby (printed: about 8 %)", ruby, 7.5, 8.5, "%"),
                    within("diamond (printed: about 17 %)", diamond, 16.5, 17.5, "%"),
                    within("water (printed: 2 %)", 100.0 * double(f0_from_ior(1.333f)), 1.9, 2.1, "%")};
    out.plots = {
        {"f0 = 0.16 reflectance^2",
         "",
         {"reflectance", 0.0, 1.1},
         {"f0, %", 0.0, 20.0},
         {curve("f0", x, [](double r) { return 100.0 * double(f0_from_reflectance(float(r))); }), marks}}};
    out.tables = {table};
    return out;
}

}  // namespace

Experiment frostbite_figure13() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 13", "Remapping reflectance to f0",
            "The remapping, the anchor at 8-bit 128, and real materials from their indices of refraction.",
            run};
}

}  // namespace candela::measure::experiments
