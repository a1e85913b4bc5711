#include "candela/measure/numerics.hpp"
#include "shading/microfacet.glsl"
#include "shading/occlusion.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

/// Part of the lobe D V n.l that is seen where everything further than a cone about the normal is hidden, the
/// cone that lets this share `ao` of diffuse light in.
double part_in_cone(float NoV, float ao, float alpha) {
    const vec3 v = at_cosine(NoV);
    const float edge = std::sqrt(std::max(1.0f - ao, 0.0f));  // sin^2 of the half angle is ao
    const auto lobe = [&](const vec3& l) {
        const vec3 h = normalize(v + l);
        return D_GGX(vec3(0, 0, 1), h, alpha) * V_SmithGGXCorrelated(NoV, l.z, alpha);
    };
    const double seen =
        integrate_hemisphere(v, alpha, 96, [&](const vec3& l) { return l.z >= edge ? lobe(l) : 0.0f; });
    return seen / integrate_hemisphere(v, alpha, 96, lobe);
}

/// A coat over a rough base: occluded by its own n.v and width, or by the base's.
struct Coats {
    ErrorStatistics own;
    ErrorStatistics of_base;
};
Coats coats() {
    Coats out;
    for (const float ao : {0.25f, 0.5f, 0.75f}) {
        for (const float alpha : {0.01f, 0.05f, 0.1f, 0.25f}) {
            for (const float base_alpha : {0.3f, 0.6f, 1.0f}) {
                for (const double NoV : linspace(0.05, 1.0, 20)) {
                    const double truth = part_in_cone(float(NoV), ao, alpha);
                    out.own.add(double(specular_occlusion(float(NoV), ao, alpha)) - truth);
                    out.of_base.add(double(specular_occlusion(float(NoV), ao, base_alpha)) - truth);
                }
            }
        }
    }
    return out;
}

Findings run() {
    const Coats coat = coats();
    ErrorStatistics listing;
    ErrorStatistics plain;  // ao itself
    for (const float ao : {0.25f, 0.5f, 0.75f}) {
        for (const float alpha : {0.01f, 0.05f, 0.1f, 0.25f, 0.5f, 1.0f}) {
            for (const double NoV : linspace(0.05, 1.0, 20)) {
                const double truth = part_in_cone(float(NoV), ao, alpha);
                listing.add(double(specular_occlusion(float(NoV), ao, alpha)) - truth);
                plain.add(double(ao) - truth);
            }
        }
    }
    Findings out;
    out.text =
        "On rough surfaces the function is the ambient occlusion itself, on smooth ones it hides less "
        "head-on and more at "
        "grazing angles, as printed. Against the part of the lobe within the cone that lets in as much "
        "diffuse light it is "
        "off by " +
        number(listing.mean(), 2) + " on average, where the plain ambient occlusion is by " +
        number(plain.mean(), 2) +
        ": it has no physical ground, as its authors say, and a smooth surface would see all or nothing. "
        "A coat has a lobe of its own and is occluded by its own n.v and roughness: off by " +
        number(coat.own.mean(), 3) + ", where the rougher base's values are off by " +
        number(coat.of_base.mean(), 3) + ".";
    out.measured = {
        within("n.v 1, ao 0.5, alpha 0", double(specular_occlusion(1.0f, 0.5f, 0.0f)), 0.724, 0.725),
        within("n.v 0, ao 0.5, alpha 0", double(specular_occlusion(0.0f, 0.5f, 0.0f)), 0.207, 0.208),
        within("n.v 0.5, ao 0.5, alpha 1", double(specular_occlusion(0.5f, 0.5f, 1.0f)), 0.4999, 0.5001),
        within("against the part of the lobe in the cone, mean error", listing.mean(), 0.19, 0.198),
        within("over the error of the plain ambient occlusion", listing.mean() / plain.mean(), 0.82, 0.855),
        within("coat by its own roughness, mean error", coat.own.mean(), 0.25, 0.262),
        within("over the error by its base's roughness", coat.own.mean() / coat.of_base.mean(), 0.81, 0.84)};
    const auto x = linspace(0.02, 1.0, 50);
    Plot plot{
        "Specular occlusion for an ambient occlusion of 0.5",
        "Solid: listing 26. Dashed: part of the lobe in the cone that lets in half of the diffuse light.",
        {"n.v", 0.0, 1.0},
        {"part that is seen", 0.0, 1.0},
        {}};
    int color = 0;
    for (const float alpha : {0.01f, 0.1f, 0.25f, 1.0f}) {
        plot.series.push_back(curve(
            "alpha " + number(double(alpha)), x,
            [alpha](double c) { return specular_occlusion(float(c), 0.5f, alpha); }, Stroke::solid, color));
        plot.series.push_back(curve(
            "", x, [alpha](double c) { return part_in_cone(float(c), 0.5f, alpha); }, Stroke::dashed, color));
        ++color;
    }
    out.plots = {plot};
    out.techniques = {
        {"specular_occlusion", "Frostbite section 4.10.2, listing 26", "how much of the lobe is not hidden",
         "part of D V n.l in the cone of the same ambient occlusion; ao 0.25 to 0.75, alpha 0.01 to 1", "",
         listing.mean(), listing.max(),
         [] { return cost_ns([](const vec4& u) { return specular_occlusion(u.x, u.y, u.z); }); }},
        {"specular_occlusion of a coat, its own roughness", "Frostbite listing 26; for a coat own",
         "how much of a coat's lobe is not hidden",
         "part of the coat's lobe in the cone; alpha 0.01 to 0.25 over bases of 0.3 to 1", "",
         coat.own.mean(), coat.own.max(),
         [] { return cost_ns([](const vec4& u) { return specular_occlusion(u.x, u.y, u.z); }); }}};
    return out;
}

}  // namespace

Experiment frostbite_figure65() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Figure 65 and listing 26", "Specular occlusion",
            "The function against the part of the lobe that a cone of the same ambient occlusion leaves, and "
            "a coat "
            "by its own roughness and by its base's.",
            run};
}

}  // namespace candela::measure::experiments
