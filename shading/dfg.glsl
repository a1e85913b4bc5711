// Directional albedos of the lobes as a table over NoV and roughness: the second factor of the split sum, and
// the input of energy compensation.
#ifndef CANDELA_DFG_GLSL
#define CANDELA_DFG_GLSL

#include "diffuse.glsl"
#include "microfacet.glsl"
#include "sampling.glsl"
#include "sequence.glsl"
#include "sheen.glsl"

CANDELA_SHADING_BEGIN

// Texels a side.
CONSTANT int kDfgSize = 64;

// Texture coordinates: u = NoV, v = perceptual roughness, kept within the outer texel centres.
FN vec2 dfg_uv(float NoV, float perceptual_roughness) {
    float half_texel = 0.5f / float(kDfgSize);
    return clamp(vec2(NoV, perceptual_roughness), vec2(half_texel), vec2(1.0f - half_texel));
}

// Scale of f0 and bias by f90 of GGX with height-correlated Smith, Frostbite equation 58: f0 x + f90 y is the
// directional albedo with Schlick's Fresnel. Changed from Frostbite: visible normals are drawn instead of
// all, so what is averaged, G2 / G1(v), stays within [0,1] at any angle. Error below 1e-3 with 1024 samples.
// NoV in (0,1].
FN vec2 integrate_ggx_albedo(float NoV, float perceptual_roughness, uint sample_count) {
    float alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    float cosine = clamp(NoV, 1.0e-4f, 1.0f);
    vec3 v = vec3(sqrt(1.0f - cosine * cosine), 0.0f, cosine);
    float root_v = smith_ggx_root(cosine, alpha);
    vec2 sum = vec2(0.0f);
    for (uint i = 0u; i < sample_count; ++i) {
        vec3 h = sample_ggx_vndf(hammersley(i, sample_count), v, alpha);
        float VoH = saturate(dot(v, h));
        float NoL = 2.0f * VoH * h.z - cosine;
        if (NoL <= 0.0f) continue;
        float root_l = smith_ggx_root(NoL, alpha);
        float g2_over_g1 = NoL * (cosine + root_v) / (NoL * root_v + cosine * root_l);
        float fresnel = pow5(1.0f - VoH);
        sum += vec2(1.0f - fresnel, fresnel) * g2_over_g1;
    }
    return sum / float(sample_count);
}

// Directional albedo of D_Charlie V_Charlie for white sheen.
FN float integrate_sheen_albedo(float NoV, float sheen_perceptual_roughness, uint sample_count) {
    float alpha = sheen_alpha(sheen_perceptual_roughness);
    float cosine = clamp(NoV, 1.0e-4f, 1.0f);
    vec3 v = vec3(sqrt(1.0f - cosine * cosine), 0.0f, cosine);
    float sum = 0.0f;
    for (uint i = 0u; i < sample_count; ++i) {
        vec3 l = sample_uniform_hemisphere(hammersley(i, sample_count));
        float NoH = normalize(v + l).z;
        sum += D_Charlie(NoH, alpha) * V_Charlie(cosine, l.z, alpha) * l.z;
    }
    return sum * TWO_PI / float(sample_count);
}

// One texel: x, y as integrate_ggx_albedo; z albedo of Fd_DisneyRenormalized (closed form); w albedo of white
// sheen of this roughness.
FN vec4 integrate_dfg(float NoV, float perceptual_roughness, uint sample_count) {
    vec2 specular = integrate_ggx_albedo(NoV, perceptual_roughness, sample_count);
    return vec4(specular.x, specular.y, albedo_DisneyRenormalized(NoV, perceptual_roughness),
                integrate_sheen_albedo(NoV, perceptual_roughness, sample_count));
}

// Scale and bias with Schlick's visibility at k = alpha / 2: Karis 2013, "Environment BRDF". Samples
// half-vectors of the whole distribution, as there.
FN vec2 integrate_ggx_albedo_ue4(float NoV, float perceptual_roughness, uint sample_count) {
    float alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    float cosine = clamp(NoV, 1.0e-4f, 1.0f);
    vec3 v = vec3(sqrt(1.0f - cosine * cosine), 0.0f, cosine);
    float k = k_image_based(alpha);
    vec2 sum = vec2(0.0f);
    for (uint i = 0u; i < sample_count; ++i) {
        vec3 h = sample_ggx_vndf(hammersley(i, sample_count), v, alpha);
        float VoH = saturate(dot(v, h));
        float NoL = 2.0f * VoH * h.z - cosine;
        if (NoL <= 0.0f) continue;
        float weight = V_SchlickSmith(cosine, NoL, k) * 2.0f * NoL * (cosine + smith_ggx_root(cosine, alpha));
        float fresnel = pow5(1.0f - VoH);
        sum += vec2(1.0f - fresnel, fresnel) * weight;
    }
    return sum / float(sample_count);
}

// One texel as integrate_dfg, of the UE4 model; z: Lambert, 1.
FN vec4 integrate_dfg_ue4(float NoV, float perceptual_roughness, uint sample_count) {
    vec2 specular = integrate_ggx_albedo_ue4(NoV, perceptual_roughness, sample_count);
    return vec4(specular.x, specular.y, 1.0f,
                integrate_sheen_albedo(NoV, perceptual_roughness, sample_count));
}

// Scale and bias without a table: Karis 2014, EnvBRDFApprox (after Lazarov 2013).
FN vec2 env_brdf_approx(float perceptual_roughness, float NoV) {
    vec4 r =
        perceptual_roughness * vec4(-1.0f, -0.0275f, -0.572f, 0.022f) + vec4(1.0f, 0.0425f, 1.04f, -0.04f);
    float a004 = min(r.x * r.x, exp2(-9.28f * NoV)) * r.x + r.y;
    return vec2(-1.04f, 1.04f) * a004 + vec2(r.z, r.w);
}

// Karis 2014.
FN vec3 EnvBRDFApprox(vec3 specular_color, float perceptual_roughness, float NoV) {
    vec2 ab = env_brdf_approx(perceptual_roughness, NoV);
    return specular_color * ab.x + vec3(ab.y);
}

// All four entries of the table without it: Karis 2014, the closed form of the diffuse albedo, the fit of the
// sheen's.
FN vec4 dfg_approx(float NoV, float perceptual_roughness) {
    vec2 ab = env_brdf_approx(perceptual_roughness, NoV);
    return vec4(ab.x, ab.y, albedo_DisneyRenormalized(NoV, perceptual_roughness),
                sheen_directional_albedo(NoV, perceptual_roughness));
}

CANDELA_SHADING_END

#endif
