#include "candela/measure/numerics.hpp"
#include "shading/probes/parallax.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

/// Section 4.9.3: the cone that holds the part `energy` of the distribution of normals.
double cone_rad(double alpha, double energy) {
    return std::atan(alpha * std::sqrt(energy / (1.0 - energy)));
}

/// Width of the lobe that from the probe makes the same circle on the wall, by the construction of the
/// figure.
double alpha_from_probe(double alpha, double to_surface_m, double to_probe_m, double energy) {
    const double radius_m = to_surface_m * std::tan(cone_rad(alpha, energy));
    return radius_m / to_probe_m / std::sqrt(energy / (1.0 - energy));
}

Findings run() {
    ErrorStatistics energies;
    ErrorStatistics excess;
    for (const double alpha : linspace(0.01, 1.0, 20)) {
        for (const double ratio : linspace(0.0, 2.0, 21)) {
            energies.add(alpha_from_probe(alpha, ratio, 1.0, 0.9) - alpha_from_probe(alpha, ratio, 1.0, 0.5));
            energies.add(alpha_from_probe(alpha, ratio, 1.0, 0.75) - ratio * alpha);
            excess.add(
                std::max(0.0, double(distance_based_roughness(float(ratio), 1.0f, float(alpha))) - alpha));
        }
    }
    Findings out;
    out.text =
        "The circle that a lobe casts on the wall, seen from the probe, belongs to a lobe whose alpha is "
        "scaled by the "
        "two distances, whatever part of the energy the cone is to hold: all other terms cancel, as the "
        "paper says. "
        "Listing 25 scales the perceptual roughness instead, never above what it was, and goes back to it as "
        "roughness grows.";
    out.measured = {
        at_most("construction against alpha times the ratio of distances, largest difference", energies.max(),
                1e-6),
        at_most("listing 25 above the surface's own roughness, largest excess", excess.max(), 1e-6),
        within("listing 25 at a quarter of the distance, roughness 0.2",
               double(distance_based_roughness(0.25f, 1.0f, 0.2f)), 0.05, 0.1)};
    const auto x = linspace(0.0, 1.5, 151);
    Plot plot{"Perceptual roughness with which the probe is read",
              "Solid: listing 25. Dashed: the construction, by alpha.",
              {"distance from the surface over distance from the probe", 0.0, 1.5},
              {"perceptual roughness", 0.0, 1.0},
              {}};
    int color = 0;
    for (const double roughness : {0.2, 0.5, 0.8}) {
        plot.series.push_back(curve(
            "roughness " + number(roughness), x,
            [&](double ratio) { return distance_based_roughness(float(ratio), 1.0f, float(roughness)); },
            Stroke::solid, color));
        plot.series.push_back(curve(
            "", x,
            [&](double ratio) {
                return std::sqrt(std::min(1.0, alpha_from_probe(roughness * roughness, ratio, 1.0, 0.75)));
            },
            Stroke::dashed, color));
        ++color;
    }
    out.plots = {plot};
    return out;
}

}  // namespace

Experiment frostbite_figure60() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 60",
            "Distance-based roughness: the construction",
            "The lobe's circle on a wall, seen from the surface and from the probe.", run};
}

}  // namespace candela::measure::experiments
