// The directional albedo of GGX whose masking and shadowing are independent, for renderers that shade so.
#ifndef CANDELA_DFG_UNCORRELATED_GLSL
#define CANDELA_DFG_UNCORRELATED_GLSL

#include "dfg.glsl"

CANDELA_SHADING_BEGIN

// Scale and bias as integrate_ggx_albedo's, Frostbite equation 58, with G1(v) G1(l), Walter et al. 2007, equation 23: over
// visible normals the average of G1(l).
FN vec2 integrate_ggx_albedo_uncorrelated(float NoV, float perceptual_roughness, uint sample_count) {
    float alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    float cosine = clamp(NoV, 1.0e-4f, 1.0f);
    vec3 v = vec3(sqrt(1.0f - cosine * cosine), 0.0f, cosine);
    vec2 sum = vec2(0.0f);
    for (uint i = 0u; i < sample_count; ++i) {
        vec3 u = vndf_point(i, sample_count);
        vec3 h = sample_ggx_vndf(vec2(u.x, u.y), v, alpha);
        float VoH = saturate(dot(v, h));
        float NoL = 2.0f * VoH * h.z - cosine;
        if (NoL <= 0.0f) continue;
        float fresnel = pow5(1.0f - VoH);
        sum += vec2(1.0f - fresnel, fresnel) * (G1_SmithGGX(NoL, alpha) * u.z);
    }
    return sum / float(sample_count);
}

CANDELA_SHADING_END

#endif
