// From what artists set to what formulas take. Reflectance to f0: fresnel.glsl.
#ifndef CANDELA_REMAPPING_GLSL
#define CANDELA_REMAPPING_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Frostbite section 3.2.1, Figure 12: smoothness in [0,1] to the GGX width; Burley's square of the perceptual roughness.
FN float alpha_from_smoothness(float smoothness) {
    return square(1.0f - smoothness);
}

// Frostbite Figure 12: the remapping of Crytek's Ryse.
FN float alpha_from_smoothness_ryse(float smoothness) {
    float x = 1.0f - 0.7f * smoothness;
    float x2 = x * x;
    return x2 * x2 * x2;
}

// Frostbite Figure 12: the fourth power, which is close to Ryse's.
FN float alpha_from_smoothness_fourth(float smoothness) {
    return square(square(1.0f - smoothness));
}

CANDELA_SHADING_END

#endif
