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

// Over the printed lobe, which with the 1/pi that Karis moves into the light's colour integrates to 4 for smooth surfaces.
CONSTANT float kSunLobePrintedFactor = 4.0f;

// The lobe of prefiltered environments in the sun's direction, in 1/sr: D_Approx with the factor that makes its energy 1. What it
// is multiplied by is the illuminance on a plane that faces the sun, without a cosine, for it integrates the light's radiance as
// the prefilter does; below the horizon there is none. NoL: cosine between normal and light.
FN float sun_lobe_gaussian(float alpha, float RoL, float NoL) {
    return NoL > 0.0f ? D_Approx(alpha, RoL) * (0.25f * INV_PI) : 0.0f;
}

CANDELA_SHADING_END

#endif
