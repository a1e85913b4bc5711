#include "candela/measure/numerics.hpp"
#include "shading/fresnel.glsl"
#include "shading/transfer.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

float schlick(float f0, double u) {
    return F_Schlick(f0, 1.0f, float(u));
}

float gaussian(float f0, double u) {
    return F_SphericalGaussian(vec3(f0), float(u)).x;
}

/// Difference in 8-bit sRGB codes of a surface that mirrors display white.
double codes(float f0, double u) {
    return 255.0 * (double(srgb_from_linear(gaussian(f0, u))) - double(srgb_from_linear(schlick(f0, u))));
}

Findings run() {
    const auto grid = linspace(0.0, 1.0, 2001);
    ErrorStatistics weight;
    ErrorStatistics relative_dielectric;
    ErrorStatistics code_dielectric;
    ErrorStatistics code_metal;
    for (const double u : grid) {
        weight.add(double(spherical_gaussian_weight(float(u))) - double(pow5(1.0f - float(u))));
        relative_dielectric.add(double(gaussian(0.04f, u)) / double(schlick(0.04f, u)) - 1.0);
        code_dielectric.add(codes(0.04f, u));
        code_metal.add(codes(0.9f, u));
    }
    Findings out;
    out.text = "The paper calls the difference imperceptible. As reflectance it is at most " +
               number(weight.max(), 2) +
               ". But where little is reflected that is a large part: for a dielectric of 4 % it is " +
               number(100.0 * relative_dielectric.mean(), 2) + " % of the reflectance on average and " +
               number(100.0 * relative_dielectric.max(), 2) + " % at worst, which is " +
               number(code_dielectric.max(), 2) +
               " codes of an 8-bit sRGB picture in which white is mirrored. A contrast of 1 % can be seen "
               "side by side, so for "
               "dielectrics the word does not hold strictly; for a metal of 90 % it does (" +
               number(code_metal.max(), 1) + " codes).";
    out.measured = {
        at_most("weight (1 - u)^5, largest difference", weight.max(), 0.004),
        at_most("reflectance of f0 = 0.04, mean relative difference", 100.0 * relative_dielectric.mean(), 2.5,
                "%"),
        at_most("reflectance of f0 = 0.04, largest relative difference", 100.0 * relative_dielectric.max(),
                7.0, "%"),
        at_most("f0 = 0.04 mirroring white, largest difference", code_dielectric.max(), 2.5, "8-bit codes"),
        at_most("f0 = 0.9 mirroring white, largest difference", code_metal.max(), 0.5, "8-bit codes")};
    out.plots = {
        {"Reflectance of a dielectric, f0 = 0.04",
         "",
         {"v.h", 0.0, 1.0},
         {"reflectance", 0.01, 1.0, Scale::logarithmic},
         {curve("Schlick", grid, [](double u) { return schlick(0.04f, u); }),
          curve(
              "spherical Gaussian, equation 5", grid, [](double u) { return gaussian(0.04f, u); },
              Stroke::dashed)}},
        {"Relative difference, spherical Gaussian against Schlick",
         "",
         {"v.h", 0.0, 1.0},
         {"difference, %"},
         {curve("f0 = 0.04", grid,
                [](double u) {
                    return 100.0 * (double(gaussian(0.04f, u)) / double(schlick(0.04f, u)) - 1.0);
                }),
          curve(
              "f0 = 0.9", grid,
              [](double u) { return 100.0 * (double(gaussian(0.9f, u)) / double(schlick(0.9f, u)) - 1.0); },
              Stroke::dashed)}}};
    out.techniques = {{"spherical_gaussian_weight", "Karis 2013, equation 5", "Schlick's fifth power",
                       "pow5(1 - u), u 0 to 1", "", weight.mean(), weight.max(),
                       [] { return cost_ns([](const vec4& u) { return spherical_gaussian_weight(u.x); }); }}};
    return out;
}

}  // namespace

Experiment karis2013_equation5() {
    return {"Karis 2013", "Equation 5",
            "The spherical-Gaussian Fresnel against Schlick's: how imperceptible is it?",
            "Both over the cosine v.h, as reflectance, as contrast and in 8-bit sRGB codes.", run};
}

}  // namespace candela::measure::experiments
