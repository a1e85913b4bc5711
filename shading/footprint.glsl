// Roughness that stands for the normals that a pixel or a texel averages over.
#ifndef CANDELA_FOOTPRINT_GLSL
#define CANDELA_FOOTPRINT_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Variance of the pixel's reconstruction filter in pixels^2, and the most that alpha^2 may grow by: Tokuyoshi
// & Kaplanyan 2019, "Improved Geometric Specular Antialiasing", section 4.
CONSTANT float kPixelFilterVariance = 0.25f;
CONSTANT float kMaxFootprintAlpha2 = 0.18f;

// alpha widened by the change of the normal across the pixel; dndx, dndy: derivatives of the unit normal per
// pixel. Tokuyoshi & Kaplanyan 2019, their isotropic form for deferred shading: slope variance adds to
// alpha^2 / 2.
FN float alpha_filtered(float alpha, vec3 dndx, vec3 dndy) {
    float variance = kPixelFilterVariance * (dot(dndx, dndx) + dot(dndy, dndy));
    return sqrt(saturate(alpha * alpha + min(2.0f * variance, kMaxFootprintAlpha2)));
}

// alpha widened by the spread of the normals behind a mip-mapped normal map's texel, which shows in the
// length of their average in (0,1]: Frostbite section 5.3, listing 32 (von Mises-Fisher concentration from
// the length, Banerjee et al. 2005; variance 1 / (2 kappa)). A length of 1 or more leaves alpha as it is.
FN float alpha_from_average_normal(float alpha, float average_length) {
    float length2 = average_length * average_length;
    float one_minus = max((1.0f - average_length) * (1.0f + average_length), 0.0f);
    float variance = one_minus / (2.0f * average_length * (3.0f - length2));
    return average_length > 0.0f ? sqrt(saturate(alpha * alpha + variance)) : 1.0f;
}

FN float perceptual_roughness_from_average_normal(float perceptual_roughness, float average_length) {
    return sqrt(alpha_from_average_normal(perceptual_roughness * perceptual_roughness, average_length));
}

CANDELA_SHADING_END

#endif
