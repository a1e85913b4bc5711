// The ways to end the inverse square's falloff that Frostbite weighs before it picks window_attenuation() (punctual.glsl).
// Source: Lagarde & de Rousiers 2014 ("Frostbite"), section 4.4, equations 23 to 25 and Figure 25.
#ifndef CANDELA_LIGHTS_FALLOFF_WINDOWS_GLSL
#define CANDELA_LIGHTS_FALLOFF_WINDOWS_GLSL

#include "../language.glsl"

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

CANDELA_SHADING_END

#endif
