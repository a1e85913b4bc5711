// The GGX microfacet model: distribution D and visibility V = G / (4 NoV NoL).
#ifndef CANDELA_MICROFACET_GLSL
#define CANDELA_MICROFACET_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Below this width the peak of D, 1 / (pi alpha^2), times a sun's illuminance leaves the range of a half
// float, and 1 - NoH^2 has too few bits in single precision. Perceptual roughness 0.045.
CONSTANT float kMinAlpha = 0.002f;

// alpha = perceptual_roughness^2 (Burley 2012, section 5.4), kept where the formulas below are good.
FN float alpha_from_perceptual_roughness(float perceptual_roughness) {
    return clamp(perceptual_roughness * perceptual_roughness, kMinAlpha, 1.0f);
}

// Height of GGX at squared cosine and squared sine of the half-vector's angle; 1/sr. Walter et al. 2007,
// equation 33. The sum has no cancellation, unlike NoH^2 (alpha^2 - 1) + 1.
FN float D_GGX_cos2_sin2(float NoH2, float sin2, float alpha) {
    float a2 = alpha * alpha;
    float d = sin2 + a2 * NoH2;
    return a2 * INV_PI / (d * d);
}

// As above from NoH alone, in [0,1]. (1 - NoH)(1 + NoH) is exact, but NoH itself was rounded: 3 % of the peak
// at alpha 0.002. Use the other form where n and h are at hand.
FN float D_GGX(float NoH, float alpha) {
    return D_GGX_cos2_sin2(NoH * NoH, (1.0f - NoH) * (1.0f + NoH), alpha);
}

// As above from the unit vectors: |n x h|^2 = 1 - NoH^2 without its loss of digits.
FN float D_GGX(vec3 n, vec3 h, float alpha) {
    vec3 c = cross(n, h);
    float NoH = max(dot(n, h), 0.0f);
    return D_GGX_cos2_sin2(NoH * NoH, dot(c, c), alpha);
}

// sqrt(alpha^2 + (1 - alpha^2) c^2): Smith's masking for GGX is G1 = 2 c / (c + this). Walter et al. 2007,
// equation 34.
FN float smith_ggx_root(float cosine, float alpha) {
    float a2 = alpha * alpha;
    return sqrt(a2 + (1.0f - a2) * cosine * cosine);
}

// Smith masking of one direction, in [0,1].
FN float G1_SmithGGX(float cosine, float alpha) {
    return 2.0f * cosine / max(cosine + smith_ggx_root(cosine, alpha), 1.0e-12f);
}

// Smith with height-correlated masking and shadowing: Heitz 2014, equation 99; Frostbite section 3.1.5,
// listing 2. The guard prevents 0/0 where both directions graze.
FN float V_SmithGGXCorrelated(float NoV, float NoL, float alpha) {
    float sum = NoL * smith_ggx_root(NoV, alpha) + NoV * smith_ggx_root(NoL, alpha);
    return 0.5f / max(sum, 1.0e-12f);
}

// Smith with independent masking and shadowing, G1(v) G1(l), exact: Walter et al. 2007, equation 23.
FN float V_SmithGGXUncorrelated(float NoV, float NoL, float alpha) {
    return 1.0f / max((NoV + smith_ggx_root(NoV, alpha)) * (NoL + smith_ggx_root(NoL, alpha)), 1.0e-12f);
}

// Schlick's rational masking of one direction, in [0,1]: Karis 2013, equation 4.
FN float G1_Schlick(float cosine, float k) {
    return cosine / max(cosine * (1.0f - k) + k, 1.0e-12f);
}

// Schlick's rational G1 = c / (c (1 - k) + k), twice: Karis 2013, equation 4.
FN float V_SchlickSmith(float NoV, float NoL, float k) {
    return 0.25f / max((NoV * (1.0f - k) + k) * (NoL * (1.0f - k) + k), 1.0e-12f);
}

// k for light from points: Disney's remapping of the roughness to (r + 1) / 2, Karis 2013, equation 4.
FN float k_analytic(float perceptual_roughness) {
    return square(perceptual_roughness + 1.0f) * 0.125f;
}

// k for image-based light, the fit to Smith itself: Karis 2013, "Specular G".
FN float k_image_based(float alpha) {
    return alpha * 0.5f;
}

CANDELA_SHADING_END

#endif
