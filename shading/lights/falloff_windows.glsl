// Falloffs with distance beside distance_attenuation() of punctual.glsl, and the choice of a profile among them.
// Source: Lagarde & de Rousiers 2014 ("Frostbite"), section 4.4, equations 23 to 25 and Figure 25; Karis 2013, equation 9 and
// Figure 9.
#ifndef CANDELA_LIGHTS_FALLOFF_WINDOWS_GLSL
#define CANDELA_LIGHTS_FALLOFF_WINDOWS_GLSL

#include "punctual.glsl"

CANDELA_SHADING_BEGIN

// Equation 23, Window2: 1 minus the 20th power of distance over range, which leaves most of the range as it is and reaches 0
// at a steep angle.
FN float window_attenuation_cutoff(float distance_m, float range_m) {
    float x4 = square(square(distance_m / range_m));
    return saturate(1.0f - square(square(x4)) * x4);
}

// Figure 25, Window3.
FN float window_attenuation_smoothstep(float distance_m, float range_m) {
    return 1.0f - smoothstep(0.0f, 1.0f, distance_m / range_m);
}

// Equations 24 and 25 (Madams 2011): 1/m^2, the inverse square lowered by what it is at the range and scaled to be 1 at 1 m.
FN float distance_attenuation_scale_bias(float distance_m, float range_m) {
    float threshold = 1.0f / square(range_m);
    return max(1.0f / square(distance_m) - threshold, 0.0f) / (1.0f - threshold);
}

// Karis 2013, equation 9: 1/m^2, the windowed inverse square with an offset under it that keeps it finite. He adds 1 squared
// unit of his engine, which is 1 cm^2 (1e-4 m^2), and has artists change it where physical correctness is not wanted.
// offset_m2 >= 0.
FN float distance_attenuation_offset(float distance_m, float range_m, float offset_m2) {
    float distance2 = square(distance_m);
    return window_of_square(distance2 / square(range_m)) / max(distance2 + offset_m2, 1.0e-12f);
}

// What Unreal Engine had before equation 9, left in Figure 9: a power of what the squared share of the range leaves, 1 at the
// light whatever its range. A pure number: the engine's brightness has no unit. The paper does not print it; form and exponent
// (2; 8 in Unreal Engine 4) are those of the engine's "Light Falloff Exponent". exponent > 0.
FN float falloff_exponent(float distance_m, float range_m, float exponent) {
    return pow(saturate(1.0f - square(distance_m / range_m)), exponent);
}

// distance_attenuation() of punctual.glsl: Frostbite equation 26.
CONSTANT int kFalloffInverseSquare = 0;
// Karis 2013, equation 9, with Falloff::offset_m2.
CONSTANT int kFalloffOffset = 1;
// Karis 2013, Figure 9, left, with the exponents of Unreal Engine 3 and 4.
CONSTANT int kFalloffExponent2 = 2;
CONSTANT int kFalloffExponent8 = 3;

// How lights without extent fade with distance.
struct Falloff {
    int technique;
    float offset_m2;  // of kFalloffOffset, >= 0
};

// 1/m^2, from cd to lx at normal incidence. The powers have no unit; here a light of 1 cd gives 1 lx at its place, as the inverse
// square does at 1 m, and without a range they do not fade. All are 0 from the range on.
FN float distance_attenuation(Falloff f, vec3 to_light, float range_m) {
    if (f.technique == kFalloffInverseSquare) return distance_attenuation(to_light, range_m);
    float distance_m = length(to_light);
    if (f.technique == kFalloffOffset) return distance_attenuation_offset(distance_m, range_m, f.offset_m2);
    return falloff_exponent(distance_m, range_m, f.technique == kFalloffExponent2 ? 2.0f : 8.0f);
}

CANDELA_SHADING_END

#endif
