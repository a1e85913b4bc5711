// Conversions between the photometric units that hold for every emitter. Shapes: lights/units.glsl; EV100:
// exposure.glsl, included here so that one include gives all units.
// Source: Lagarde & de Rousiers 2014 ("Frostbite"), sections 4.3, 4.4 and 4.7.1.
#ifndef CANDELA_PHOTOMETRY_GLSL
#define CANDELA_PHOTOMETRY_GLSL

#include "exposure.glsl"
#include "language.glsl"

CANDELA_SHADING_BEGIN

// lm per W at 555 nm, the definition of the candela; also what is assumed of a light whose efficacy is
// unknown (Frostbite equation 10).
CONSTANT float kMaxLuminousEfficacy = 683.0f;
// Punctual lights have a size of 1 cm, so that illuminance stays finite at the light (Frostbite equation 14).
CONSTANT float kPunctualMinDistance_m = 0.01f;

// Frostbite equation 9. efficacy in lm/W, 0 to 683.
FN float lm_from_watt(float power_w, float efficacy_lm_per_w) {
    return efficacy_lm_per_w * power_w;
}
FN float watt_from_lm(float power_lm, float efficacy_lm_per_w) {
    return power_lm / efficacy_lm_per_w;
}

// Luminous efficiency (Frostbite Table 6), 0 to 1, to efficacy in lm/W.
FN float efficacy_from_efficiency(float efficiency) {
    return kMaxLuminousEfficacy * efficiency;
}

// Frostbite equation 14: illuminance at normal incidence of a punctual light of intensity_cd.
FN float lx_from_cd(float intensity_cd, float distance_m) {
    return intensity_cd / max(square(distance_m), square(kPunctualMinDistance_m));
}

// Intensity from an illuminance measured at normal incidence (Frostbite section 4.3, the remark on meters).
FN float cd_from_lx(float illuminance_lx, float distance_m) {
    return illuminance_lx * max(square(distance_m), square(kPunctualMinDistance_m));
}

// Luminance of a Lambertian surface of this reflectance (0 to 1) under illuminance_lx.
FN float nit_from_lx_lambertian(float illuminance_lx, float reflectance) {
    return illuminance_lx * reflectance * INV_PI;
}

// Illuminance on a surface whose whole hemisphere shines with luminance_nit.
FN float lx_from_uniform_sky(float luminance_nit) {
    return PI * luminance_nit;
}

// Frostbite equation 33: a Lambertian emitter of power_lm spread over area_m2.
FN float nit_from_lm_area(float power_lm, float area_m2) {
    return power_lm / (area_m2 * PI);
}
FN float lm_from_nit_area(float luminance_nit, float area_m2) {
    return luminance_nit * area_m2 * PI;
}

CANDELA_SHADING_END

#endif
