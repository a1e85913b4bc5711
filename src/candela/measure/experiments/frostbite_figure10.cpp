#include "candela/measure/numerics.hpp"
#include "candela/measure/spheres.hpp"
#include "shading/diffuse.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

/// A sphere lit from the viewer: n.l = n.v = cosine, l.h = 1.
float lit(int model, float cosine, float roughness) {
    const float f = model == 0   ? Fd_Lambert()
                    : model == 1 ? Fd_Disney(cosine, cosine, 1.0f, roughness)
                                 : Fd_DisneyRenormalized(cosine, cosine, 1.0f, roughness);
    return f * PI * cosine;
}

Findings run() {
    Panel picture = sphere_grid(3, 5, 88, [](int row, int column, const vec3& n) {
        return vec3(0.75f * lit(row, n.z, 0.25f * float(column)));
    });
    picture.title = "Spheres of albedo 0.75 lit from the viewer; roughness 0, 0.25, 0.5, 0.75, 1";
    picture.caption = "Top to bottom: Lambert, Disney, renormalized.";
    Plot plot{"Brightness over the sphere, light at the viewer",
              "Solid: Disney. Dashed: renormalized.",
              {"distance from the centre of the sphere, radii", 0.0, 1.0},
              {"fraction of the incident light", 0.0, 1.1},
              {}};
    const auto x = linspace(0.0, 1.0, 201);
    const auto cosine = [](double r) { return float(std::sqrt(std::max(1.0 - r * r, 0.0))); };
    plot.series.push_back(curve(
        "Lambert", x, [&](double r) { return lit(0, cosine(r), 0.0f); }, Stroke::dotted, 0));
    int color = 1;
    for (const float roughness : {0.0f, 0.5f, 1.0f}) {
        plot.series.push_back(curve(
            "roughness " + number(double(roughness)), x,
            [&](double r) { return lit(1, cosine(r), roughness); }, Stroke::solid, color));
        plot.series.push_back(curve(
            "", x, [&](double r) { return lit(2, cosine(r), roughness); }, Stroke::dashed, color));
        ++color;
    }
    ErrorStatistics lambert;
    ErrorStatistics change;
    for (const double roughness : linspace(0.0, 1.0, 21)) {
        for (const double r : linspace(0.0, 0.99, 100)) {
            lambert.add(double(lit(1, cosine(r), float(roughness)) - lit(0, cosine(r), 0.0f)));
            change.add(double(lit(2, cosine(r), float(roughness)) - lit(1, cosine(r), float(roughness))));
        }
    }
    const double centre = double(lit(2, 1.0f, 1.0f)) / double(lit(1, 1.0f, 1.0f));
    const double edge_disney = double(lit(1, 0.2f, 1.0f)) / double(lit(1, 0.2f, 0.0f));
    const double edge_renormalized = double(lit(2, 0.2f, 1.0f)) / double(lit(2, 0.2f, 0.0f));
    Findings out;
    out.text = "Disney's term differs from Lambert by " + number(lambert.mean(), 2) +
               " of the incident light on average and " + number(lambert.max(), 2) +
               " at most: darker edges when smooth, brighter when rough. Renormalization darkens rough "
               "spheres (to " +
               number(centre, 3) +
               " of their value at the centre, 1/1.51) and keeps the rise towards the edge: at n.v = 0.2 the "
               "rough sphere is " +
               number(edge_renormalized, 3) + " times as bright as the smooth one (" +
               number(edge_disney, 3) + " before).";
    out.measured = {
        at_most("Disney against Lambert, mean difference", lambert.mean(), 0.1),
        at_most("Disney against Lambert, largest difference", lambert.max(), 0.5),
        at_most("renormalized against Disney, mean difference", change.mean(), 0.2),
        within("renormalized over Disney at the centre, roughness 1 (1/1.51)", centre, 0.6622, 0.6623),
        at_least("retro-reflection kept: edge at roughness 1 over roughness 0", edge_renormalized, 1.0)};
    out.pictures = {picture};
    out.plots = {plot};
    return out;
}

}  // namespace

Experiment frostbite_figure10() {
    return {
        "Lagarde & de Rousiers 2014 (Frostbite)", "Figure 10",
        "Lambert, Disney's diffuse term, and its renormalization",
        "Spheres with the light at the viewer: how each term shades, and what the renormalization changes.",
        run};
}

}  // namespace candela::measure::experiments
