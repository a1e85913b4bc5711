#include "candela/measure/numerics.hpp"
#include "shading/bsdf.glsl"
#include "shading/dfg.glsl"

namespace candela::measure::experiments {
namespace {

using namespace shading;

Surface surface(float metallic, float f0) {
    Surface s{};
    s.base_color = vec3(metallic > 0.0f ? f0 : 0.0f);
    s.metallic = metallic;
    s.perceptual_roughness = 0.3f;
    s.dielectric_f0 = vec3(f0);
    s.dielectric_f90 = vec3(1.0f);
    return s;
}

/// Reflectance at grazing angle that the profile frostbite takes.
double f90(float metallic, float f0) {
    return double(
        prepare_surface(surface(metallic, f0), techniques_frostbite(), 1.0f, vec4(1.0f)).specular_f90.x);
}

/// What a uniform surrounding of luminance 1 shows on it, by the table's integral.
double furnace(float NoV, float f0, double grazing) {
    const vec2 ab = integrate_ggx_albedo(NoV, 0.3f, 256);
    return double(f0 * ab.x) + grazing * double(ab.y);
}

Findings run() {
    const double metal = f90(1.0f, 0.005f);
    Findings out;
    out.text =
        "Below f0 = 2 %, which no real surface has, the paper takes the value for baked micro-occlusion and "
        "lowers the grazing "
        "reflectance with it, for dielectrics and metals alike (its list of corrections, section 3.2.1): a "
        "metal of base colour "
        "0.005 keeps " +
        number(metal, 4) + " of it. In a uniform surrounding, roughness 0.3, n.v 0.1, it shows " +
        number(furnace(0.1f, 0.005f, metal), 3) + " instead of " + number(furnace(0.1f, 0.005f, 1.0), 3) +
        ".";
    out.measured = {within("f90 of a metal of base colour 0.005", metal, 0.2474, 0.2476),
                    within("f90 of a dielectric of f0 0.005", f90(0.0f, 0.005f), 0.2474, 0.2476),
                    within("f90 of a metal of base colour 0.9", f90(1.0f, 0.9f), 1.0, 1.0),
                    within("f90 of a black metal", f90(1.0f, 0.0f), 0.0, 0.0)};
    const auto x = linspace(0.0, 0.05, 101);
    out.plots = {{"Reflectance at grazing angle",
                  "",
                  {"f0", 0.0, 0.05},
                  {"f90", 0.0, 1.05},
                  {curve("metal", x, [](double f) { return f90(1.0f, float(f)); }),
                   curve(
                       "dielectric", x, [](double f) { return f90(0.0f, float(f)); }, Stroke::dashed)}}};
    return out;
}

}  // namespace

Experiment frostbite_listing27() {
    return {"Lagarde & de Rousiers 2014 (Frostbite)", "Listing 27",
            "Micro-occlusion in the reflectance at grazing angle",
            "f90 of dielectrics and metals below f0 = 2 %, and what it makes of a metal in a uniform "
            "surrounding.",
            run};
}

}  // namespace candela::measure::experiments
