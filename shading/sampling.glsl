// Directions drawn for Monte Carlo, and their densities. Local frame: z along the normal; u in [0,1)^2.
#ifndef CANDELA_SAMPLING_GLSL
#define CANDELA_SAMPLING_GLSL

#include "anisotropy.glsl"

CANDELA_SHADING_BEGIN

FN vec3 sample_uniform_hemisphere(vec2 u) {
    float phi = TWO_PI * u.y;
    float sine = sqrt(max(1.0f - u.x * u.x, 0.0f));
    return vec3(sine * cos(phi), sine * sin(phi), u.x);
}
FN float pdf_uniform_hemisphere() {
    return 1.0f / TWO_PI;
}

// Density cos / pi: Malley's method, a uniform disk projected up.
FN vec3 sample_cosine_hemisphere(vec2 u) {
    float phi = TWO_PI * u.y;
    float sine = sqrt(u.x);
    return vec3(sine * cos(phi), sine * sin(phi), sqrt(max(1.0f - u.x, 0.0f)));
}
FN float pdf_cosine_hemisphere(float NoL) {
    return max(NoL, 0.0f) * INV_PI;
}

// Density of the light direction when h was drawn with density pdf_h and v mirrored in it: Walter et al.
// 2007, equation 14.
FN float pdf_reflected(float pdf_h, float VoH) {
    return VoH > 0.0f ? pdf_h / (4.0f * VoH) : 0.0f;
}

// Half-vector with density D NoH: Walter et al. 2007, equations 35 and 36. alpha along x and y.
FN vec3 sample_ggx_ndf(vec2 u, vec2 alpha) {
    float phi = TWO_PI * u.y;
    float tangent = sqrt(u.x / (1.0f - u.x));
    return normalize(vec3(alpha.x * tangent * cos(phi), alpha.y * tangent * sin(phi), 1.0f));
}
FN vec3 sample_ggx_ndf(vec2 u, float alpha) {
    return sample_ggx_ndf(u, vec2(alpha));
}
FN float pdf_ggx_ndf(vec3 h, vec2 alpha) {
    return h.z > 0.0f ? D_GGXAnisotropic(h.z, h.x, h.y, alpha.x, alpha.y) * h.z : 0.0f;
}
FN float pdf_ggx_ndf(vec3 h, float alpha) {
    return pdf_ggx_ndf(h, vec2(alpha));
}

// Half-vector with the density of GGX normals visible from v (v.z > 0): a uniform point of the spherical cap
// that the stretched view leaves, Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps",
// listing 3.
FN vec3 sample_ggx_vndf(vec2 u, vec3 v, vec2 alpha) {
    vec3 stretched = normalize(vec3(alpha.x * v.x, alpha.y * v.y, v.z));
    float phi = TWO_PI * u.x;
    float z = (1.0f - u.y) * (1.0f + stretched.z) - stretched.z;
    float sine = sqrt(max((1.0f - z) * (1.0f + z), 0.0f));
    vec3 h = vec3(sine * cos(phi), sine * sin(phi), z) + stretched;
    return normalize(vec3(alpha.x * h.x, alpha.y * h.y, max(h.z, 1.0e-7f)));
}
FN vec3 sample_ggx_vndf(vec2 u, vec3 v, float alpha) {
    return sample_ggx_vndf(u, v, vec2(alpha));
}
// G1(v) D / NoV: the density of visible normals over VoH.
FN float ggx_visible_normals(vec3 v, vec3 h, vec2 alpha) {
    if (v.z <= 0.0f || h.z <= 0.0f) return 0.0f;
    float masking_over_cosine = 2.0f / (v.z + length(vec3(alpha.x * v.x, alpha.y * v.y, v.z)));
    return masking_over_cosine * D_GGXAnisotropic(h.z, h.x, h.y, alpha.x, alpha.y);
}
// G1(v) D VoH / NoV: Heitz 2018, equation 3.
FN float pdf_ggx_vndf(vec3 v, vec3 h, vec2 alpha) {
    return ggx_visible_normals(v, h, alpha) * max(dot(v, h), 0.0f);
}
FN float pdf_ggx_vndf(vec3 v, vec3 h, float alpha) {
    return pdf_ggx_vndf(v, h, vec2(alpha));
}

// Half-vector with density D_Charlie NoH, by inverting sin^(2 + 1/alpha).
FN vec3 sample_charlie_ndf(vec2 u, float alpha) {
    float phi = TWO_PI * u.y;
    float sine = pow(u.x, alpha / (2.0f * alpha + 1.0f));
    return vec3(sine * cos(phi), sine * sin(phi), sqrt(max((1.0f - sine) * (1.0f + sine), 0.0f)));
}

CANDELA_SHADING_END

#endif
