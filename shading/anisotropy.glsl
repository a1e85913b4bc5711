// Anisotropic GGX. alpha_t along the tangent, alpha_b along the bitangent; ToX = dot(tangent, x).
#ifndef CANDELA_ANISOTROPY_GLSL
#define CANDELA_ANISOTROPY_GLSL

#include "microfacet.glsl"

CANDELA_SHADING_BEGIN

// KHR_materials_anisotropy: strength in [0,1] widens the lobe along the tangent up to 1. Returns (alpha_t,
// alpha_b).
FN vec2 anisotropic_alpha(float perceptual_roughness, float anisotropy) {
    float alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    return vec2(mix(alpha, 1.0f, anisotropy * anisotropy), alpha);
}

// Burley 2012, equation 13, in the form that does not divide by small widths.
FN float D_GGXAnisotropic(float NoH, float ToH, float BoH, float alpha_t, float alpha_b) {
    float a2 = alpha_t * alpha_b;
    vec3 d = vec3(alpha_b * ToH, alpha_t * BoH, a2 * NoH);
    float w = a2 / dot(d, d);
    return a2 * w * w * INV_PI;
}

// Height-correlated Smith: Heitz 2014, equations 86 and 99.
FN float V_SmithGGXCorrelatedAnisotropic(float NoV, float ToV, float BoV, float NoL, float ToL, float BoL,
                                         float alpha_t, float alpha_b) {
    float root_v = length(vec3(alpha_t * ToV, alpha_b * BoV, NoV));
    float root_l = length(vec3(alpha_t * ToL, alpha_b * BoL, NoL));
    return 0.5f / max(NoL * root_v + NoV * root_l, 1.0e-12f);
}

// Smith masking of one local direction (z along the normal), in [0,1]; 0 below the horizon.
FN float G1_SmithGGXAnisotropic(vec3 w, vec2 alpha) {
    if (w.z <= 0.0f) return 0.0f;
    return 2.0f * w.z / (w.z + length(vec3(alpha.x * w.x, alpha.y * w.y, w.z)));
}

CANDELA_SHADING_END

#endif
