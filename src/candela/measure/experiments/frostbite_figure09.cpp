#include "candela/measure/numerics.hpp"
#include "shading/dfg.glsl"
#include "shading/diffuse.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

constexpr float kF0 = 0.04f;

template <class F>
double diffuse_albedo(double NoV, F model) {
    const vec3 v = at_cosine(float(NoV));
    return integrate_hemisphere(v, 0.5f, 96,
                                [&](const vec3& l) { return model(v.z, l.z, dot(l, normalize(v + l))); });
}

double original(double NoV, double roughness) {
    return diffuse_albedo(NoV,
                          [&](float v, float l, float h) { return Fd_Disney(v, l, h, float(roughness)); });
}
double renormalized(double NoV, double roughness) {
    return diffuse_albedo(
        NoV, [&](float v, float l, float h) { return Fd_DisneyRenormalized(v, l, h, float(roughness)); });
}
double specular(double NoV, double roughness) {
    const vec2 ab = integrate_ggx_albedo(float(NoV), float(roughness), 2048);
    return double(kF0 * ab.x + ab.y);
}

Plot plot_of(const char* title, const char* caption, double (*f)(double, double)) {
    Plot plot{title,
              caption,
              {"angle of the view to the normal, degrees", 0.0, 90.0, Scale::linear, 15.0},
              {"hemispherical-directional reflectance", 0.0, 1.6},
              {}};
    for (const double roughness : {0.0, 0.25, 0.5, 0.75, 1.0})
        plot.series.push_back(curve("roughness " + number(roughness), linspace(0.0, 88.0, 45),
                                    [&](double a) { return f(std::cos(a * kPi / 180.0), roughness); }));
    return plot;
}

double total(double NoV, double roughness) {
    return renormalized(NoV, roughness) + specular(NoV, roughness);
}

Findings run() {
    double largest_original = 0.0;
    double largest_renormalized = 0.0;
    double largest_total = 0.0;
    double at_80 = 0.0;
    ErrorStatistics original_excess;  // above what is received
    ErrorStatistics total_excess;
    double lowest_total = 10.0;
    ErrorStatistics renormalized_from_one;
    ErrorStatistics total_from_one;
    ErrorStatistics closed_form;
    for (const double roughness : linspace(0.0, 1.0, 21)) {
        for (const double angle : linspace(0.0, 88.0, 23)) {
            const double c = std::cos(angle * kPi / 180.0);
            const double o = original(c, roughness);
            const double r = renormalized(c, roughness);
            const double t = r + specular(c, roughness);
            original_excess.add(std::max(o - 1.0, 0.0));
            total_excess.add(std::max(t - 1.0, 0.0));
            lowest_total = std::min(lowest_total, t);
            renormalized_from_one.add(r - 1.0);
            total_from_one.add(t - 1.0);
            closed_form.add(double(albedo_DisneyRenormalized(float(c), float(roughness))) - r);
            largest_original = std::max(largest_original, o);
            largest_renormalized = std::max(largest_renormalized, r);
            largest_total = std::max(largest_total, t);
            if (angle <= 80.0) at_80 = std::max(at_80, t);
        }
    }
    Findings out;
    out.text =
        "Disney's diffuse alone reflects up to " + number(largest_original, 3) +
        " of what it receives; renormalized, up to " + number(largest_renormalized, 3) +
        ". With the specular term of f0 = 0.04 the sum reaches " + number(at_80, 3) +
        " up to 80 degrees and " + number(largest_total, 3) + " at 88, and is least, " +
        number(lowest_total, 3) +
        ", for rough surfaces, which the factor 1/1.51 darkens at all but grazing angles. The paper calls "
        "the sum close to one and wants it not above: over, it is by a few per cent; under, by " +
        number(100.0 * (1.0 - lowest_total), 2) + " %.";
    out.measured = {
        within("9a, Disney diffuse, largest reflectance (above 1 in the paper)", largest_original, 1.01, 1.7),
        at_most("9b, renormalized, largest reflectance", largest_renormalized, 1.0),
        at_most("9b, renormalized, mean distance from 1", renormalized_from_one.mean(), 0.21),
        at_most("9c, renormalized with specular, largest reflectance up to 80 degrees", at_80, 1.05),
        at_most("9c, renormalized with specular, largest reflectance up to 88 degrees", largest_total, 1.06),
        at_most("9c, renormalized with specular, mean distance from 1", total_from_one.mean(), 0.13),
        at_least("9c, renormalized with specular, smallest reflectance", lowest_total, 0.68),
        at_most("closed form of the albedo against quadrature", closed_form.max(), 5e-4)};
    out.plots = {plot_of("9a: Disney diffuse", "", original), plot_of("9b: renormalized", "", renormalized),
                 plot_of("9c: renormalized, with specular, f0 = 0.04", "", total)};
    const std::string truth = "energy above what is received, albedo 1; roughness 0 to 1, 0 to 88 degrees";
    out.techniques = {
        {"Fd_Disney", "Burley 2012, section 5.3", "rough diffuse reflection", truth, "",
         original_excess.mean(), original_excess.max(),
         [] { return cost_ns([](const vec4& u) { return Fd_Disney(u.x, u.y, u.z, u.w); }); }},
        {"Fd_DisneyRenormalized", "Frostbite section 3.1.3, listing 1",
         "diffuse that leaves room for specular",
         "energy above what is received, with specular of f0 = 0.04; same range", "", total_excess.mean(),
         total_excess.max(),
         [] { return cost_ns([](const vec4& u) { return Fd_DisneyRenormalized(u.x, u.y, u.z, u.w); }); }},
        {"albedo_DisneyRenormalized", "own derivation", "the DFG table's third channel",
         "quadrature of 18432 points, same range", "", closed_form.mean(), closed_form.max(),
         [] { return cost_ns([](const vec4& u) { return albedo_DisneyRenormalized(u.x, u.y); }); }}};
    return out;
}

}  // namespace

Experiment frostbite_figure09() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 9a-c", "Energy of Disney's diffuse term",
            "Reflectance under a uniform hemisphere over view angle and roughness: original, renormalized, "
            "and with the specular term.",
            run};
}

}  // namespace candela::measure::experiments
