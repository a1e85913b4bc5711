#include "candela/measure/numerics.hpp"
#include "shading/footprint.glsl"
#include "shading/microfacet.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

/// Concentration of the von Mises-Fisher distribution of normals whose average has this length (listing 32).
double concentration(double length) {
    return 0.5 / double(variance_from_average_normal(float(length)));
}

/// D_GGX towards the mean normal, averaged over normals of this concentration.
double spread_peak(double alpha, double kappa) {
    const double norm = kappa / -std::expm1(-2.0 * kappa);
    // In the logarithm of 1 - z: lobe and spread may differ by orders of magnitude.
    return integrate(
        [&](double x) {
            const double t = std::exp(x);
            const double z = 1.0 - t;
            if (z <= 0.0) return 0.0;
            const double d = z * z * (alpha * alpha - 1.0) + 1.0;
            return norm * std::exp(-kappa * t) * alpha * alpha / (kPi * d * d) * t;
        },
        std::log(1e-9), 0.0, 128);
}

double peak(double alpha2) {
    return 1.0 / (kPi * std::min(alpha2, 1.0));
}

double error_stops(double alpha, double length, bool convolved) {
    const float added = convolved ? convolved_variance_from_average_normal(float(length))
                                  : variance_from_average_normal(float(length));
    return std::log2(peak(alpha * alpha + double(added)) / spread_peak(alpha, concentration(length)));
}

Findings run() {
    ErrorStatistics printed;
    ErrorStatistics convolved;
    for (const double roughness : {0.1, 0.2, 0.3, 0.4, 0.55, 0.7}) {
        for (const double length : {0.999, 0.995, 0.98, 0.95, 0.9}) {
            printed.add(error_stops(roughness * roughness, length, false));
            convolved.add(error_stops(roughness * roughness, length, true));
        }
    }
    Findings out;
    out.text =
        "The peak of GGX averaged over normals of a von Mises-Fisher distribution, against the peak of the "
        "widened "
        "lobe. The paper adds 1 / (2 kappa) to alpha^2 and leaves highlights " +
        number(printed.mean(), 3) + " stops too bright on average, " + number(printed.max(), 3) +
        " at most: normals of concentration kappa have the slope variance 1 / kappa, and alpha^2 is twice a "
        "slope "
        "variance, so 2 / kappa is what a narrow lobe needs, four times as much. With it they are off by " +
        number(convolved.mean(), 3) + " stops, at most " + number(convolved.max(), 3) +
        ". What is left is that the sum of a Gaussian and GGX is neither.";
    out.measured = {at_most("convolved, mean error of the peak", convolved.mean(), 0.2, "stops"),
                    at_most("convolved, largest error of the peak", convolved.max(), 0.4, "stops"),
                    within("listing 32, mean error of the peak", printed.mean(), 1.0, 1.4, "stops"),
                    at_most("listing 32, largest error of the peak", printed.max(), 2.1, "stops")};
    const auto lengths = linspace(0.9, 0.999, 40);
    Plot plot{"Peak of the widened lobe over that of the averaged one",
              "Solid: listing 32. Dashed: the convolution's variance.",
              {"length of the average normal", 0.9, 1.0},
              {"stops"},
              {}};
    int color = 0;
    for (const double roughness : {0.1, 0.3, 0.55}) {
        plot.series.push_back(curve(
            "roughness " + number(roughness), lengths,
            [&](double l) { return error_stops(roughness * roughness, l, false); }, Stroke::solid, color));
        plot.series.push_back(curve(
            "", lengths, [&](double l) { return error_stops(roughness * roughness, l, true); },
            Stroke::dashed, color));
        ++color;
    }
    out.plots = {plot};
    const std::string truth =
        "peak of D_GGX averaged over von Mises-Fisher normals; roughness 0.1 to 0.7, lengths 0.9 to 0.999";
    out.techniques = {
        {"variance_from_average_normal", "Frostbite section 5.3, listing 32", "a normal map from afar", truth,
         "stops", printed.mean(), printed.max(),
         [] {
             return cost_ns([](const vec4& u) { return variance_from_average_normal(0.9f + 0.1f * u.x); });
         }},
        {"convolved_variance_from_average_normal", "Wang et al. 2009, with listing 32's kappa",
         "a normal map from afar", truth, "stops", convolved.mean(), convolved.max(), [] {
             return cost_ns(
                 [](const vec4& u) { return convolved_variance_from_average_normal(0.9f + 0.1f * u.x); });
         }}};
    return out;
}

}  // namespace

Experiment frostbite_listing32() {
    return {
        "Lagarde & de Rousiers 2014 (Frostbite)", "Listing 32",
        "Roughness from the length of an average normal",
        "The peak of a lobe that is widened for the spread of normals, against the lobe averaged over them.",
        run};
}

}  // namespace candela::measure::experiments
