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

// Points of the quadrature behind a texel: within 2e-3 (candela validate --only karis2013_figure3).
CONSTANT uint kDfgSamples = 256u;

// Texture coordinates: sqrt(NoV) and perceptual roughness, 0 and 1 at the centres of the outer texels. The
// root is for smooth metals at grazing angles: with NoV itself, bilinear reading is off by 3 % there instead
// of 0.4 %.
FN vec2 dfg_uv(float NoV, float perceptual_roughness) {
    float size = float(kDfgSize);
    vec2 at = vec2(sqrt(saturate(NoV)), saturate(perceptual_roughness));
    return at * ((size - 1.0f) / size) + vec2(0.5f / size);
}

// NoV and perceptual roughness that texel (x, y) stands for: the inverse of dfg_uv at texel centres.
FN vec2 dfg_parameters(uint x, uint y) {
    vec2 at = vec2(float(x), float(y)) / float(kDfgSize - 1);
    return vec2(at.x * at.x, at.y);
}

// Hammersley's points, moved so that their mean is the centre of the square: as quadrature, an order better.
FN vec2 centred_hammersley(uint i, uint n) {
    return hammersley(i, n) + vec2(0.5f / float(n));
}

// Quadrature point for sample_ggx_vndf with the view in the plane that halves the integrand, so that half a
// turn of azimuth will do; u.y is spaced quadratically towards the flanks of the lobe, where masking changes
// fastest and one point of equal weight would decide over 1/n of the energy. z: weight.
FN vec3 vndf_point(uint i, uint n) {
    vec2 u = centred_hammersley(i, n);
    return vec3(0.5f * u.x, u.y * (2.0f - u.y), 2.0f * (1.0f - u.y));
}

// How masking and shadowing go together in integrate_ggx_albedo_masked.
CONSTANT int kMaskingCorrelated = 0;
CONSTANT int kMaskingIndependent = 1;
CONSTANT int kMaskingSchlick = 2;

// What a visible normal of GGX brings of its energy to the directional albedo, before Fresnel: G2 / G1(v) for Smith's masking.
FN float visible_normal_weight(int masking, float NoV, float NoL, float alpha) {
    if (masking == kMaskingIndependent) return G1_SmithGGX(NoL, alpha);
    float root_v = smith_ggx_root(NoV, alpha);
    if (masking == kMaskingSchlick) return V_SchlickSmith(NoV, NoL, k_image_based(alpha)) * 2.0f * NoL * (NoV + root_v);
    float root_l = smith_ggx_root(NoL, alpha);
    return NoL * (NoV + root_v) / (NoL * root_v + NoV * root_l);
}

// Scale of f0 and bias by f90 of GGX, Frostbite equation 58: f0 x + f90 y is the directional albedo with
// Schlick's Fresnel. Changed from Frostbite: visible normals are drawn instead of all, so what is averaged
// stays within [0,1] at any angle. Error below 1e-3 with 1024 samples. NoV in (0,1].
FN vec2 integrate_ggx_albedo_masked(int masking, float NoV, float perceptual_roughness, uint sample_count) {
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
        sum += vec2(1.0f - fresnel, fresnel) * (visible_normal_weight(masking, cosine, NoL, alpha) * u.z);
    }
    return sum / float(sample_count);
}

// With height-correlated Smith, as Frostbite has it.
FN vec2 integrate_ggx_albedo(float NoV, float perceptual_roughness, uint sample_count) {
    return integrate_ggx_albedo_masked(kMaskingCorrelated, NoV, perceptual_roughness, sample_count);
}

// With G1(v) G1(l), Walter et al. 2007, equation 23, for renderers that shade so: over visible normals the average of G1(l).
FN vec2 integrate_ggx_albedo_uncorrelated(float NoV, float perceptual_roughness, uint sample_count) {
    return integrate_ggx_albedo_masked(kMaskingIndependent, NoV, perceptual_roughness, sample_count);
}

// With Schlick's visibility at k = alpha / 2: Karis 2013, "Environment BRDF".
FN vec2 integrate_ggx_albedo_ue4(float NoV, float perceptual_roughness, uint sample_count) {
    return integrate_ggx_albedo_masked(kMaskingSchlick, NoV, perceptual_roughness, sample_count);
}

// Directional albedo of white sheen, evaluate_sheen, at most 1. A smooth sheen lights up within a band at
// grazing angles: the cosine is spaced quadratically into it; the azimuth has vanishing weight at its ends,
// which makes equidistant points converge an order faster.
FN float integrate_sheen_albedo(float NoV, float sheen_perceptual_roughness, uint sample_count) {
    float alpha = sheen_alpha(sheen_perceptual_roughness);
    float cosine = clamp(NoV, 1.0e-4f, 1.0f);
    vec3 v = vec3(sqrt(1.0f - cosine * cosine), 0.0f, cosine);
    float sum = 0.0f;
    for (uint i = 0u; i < sample_count; ++i) {
        vec2 u = centred_hammersley(i, sample_count);
        float NoL = u.x * u.x;
        float sine = sqrt(1.0f - NoL * NoL);
        float phi = PI * u.y * u.y * (3.0f - 2.0f * u.y);
        float jacobian = 2.0f * u.x * TWO_PI * 6.0f * u.y * (1.0f - u.y);
        vec3 l = vec3(sine * cos(phi), sine * sin(phi), NoL);
        sum += D_Charlie(normalize(v + l).z, alpha) * V_Charlie(cosine, NoL, alpha) * NoL * jacobian;
    }
    return min(sum / float(sample_count), 1.0f);
}

// One texel: x, y as integrate_ggx_albedo; z albedo of Fd_DisneyRenormalized (closed form); w albedo of white
// sheen of this roughness.
FN vec4 integrate_dfg(float NoV, float perceptual_roughness, uint sample_count) {
    vec2 specular = integrate_ggx_albedo(NoV, perceptual_roughness, sample_count);
    return vec4(specular.x, specular.y, albedo_DisneyRenormalized(NoV, perceptual_roughness),
                integrate_sheen_albedo(NoV, perceptual_roughness, sample_count));
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

// EnvBRDFApprox for a non-metal of f0 = 0.04, of which Karis 2014 says that it folds: the reflectance itself. Constants are those
// of env_brdf_approx, its tail by roughness (0.0016 - 0.00088 r) left out.
FN float env_brdf_approx_nonmetal(float perceptual_roughness, float NoV) {
    vec2 r = perceptual_roughness * vec2(-1.0f, -0.0275f) + vec2(1.0f, 0.0425f);
    return min(r.x * r.x, exp2(-9.28f * NoV)) * r.x + r.y;
}

// Diffuse colour of a "fully rough" surface, which has no specular lobe: Karis 2014.
FN vec3 fully_rough_color(vec3 diffuse_color, vec3 f0) {
    return diffuse_color + 0.45f * f0;
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
