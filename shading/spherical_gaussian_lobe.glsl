// A light from one direction through the lobe that prefiltered environments are read with: Karis 2014.
#ifndef CANDELA_SPHERICAL_GAUSSIAN_LOBE_GLSL
#define CANDELA_SPHERICAL_GAUSSIAN_LOBE_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// GGX as Blinn, Blinn as Phong, Phong as a spherical Gaussian: Karis 2014, "Directional Light". RoL: cosine between the
// mirror direction and the light. alpha > 0, the square of the perceptual roughness. Times 1/pi it is a density per sr of
// half-vectors, not of light directions: its integral over the sphere is 4 for small alpha, so 1/(4 pi) makes it a lobe of
// energy 1.
FN float D_Approx(float alpha, float RoL) {
    float inverse_a2 = 1.0f / (alpha * alpha);
    // 1/(2 ln 2) and 0.275/ln 2: the exponent n + 0.775 of the Gaussian for Phong's n = (1/alpha^2 - 1)/2, in base 2.
    float c = 0.72134752f * inverse_a2 + 0.39674113f;
    return inverse_a2 * exp2(c * RoL - c);
}

CANDELA_SHADING_END

#endif
