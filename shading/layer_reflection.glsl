// What anisotropic metal and sheen see of a prefiltered environment: reads of it, as in stretched_reflection.glsl.
#ifndef CANDELA_LAYER_REFLECTION_GLSL
#define CANDELA_LAYER_REFLECTION_GLSL

#include "anisotropy.glsl"
#include "stretched_reflection.glsl"

CANDELA_SHADING_BEGIN

CONSTANT int kAnisotropicReads = 5;

// The lobe of anisotropic GGX as a row of narrow reads. Slopes of half-vectors have the covariance that alpha says; the mirror
// doubles them in the plane of incidence and shortens them by NoV across it. The longer axis of the ellipse that comes out is
// where the reads stand, the shorter one is how wide they are.
struct AnisotropicLobe {
    vec3 n;
    vec3 v;
    vec3 slope;   // of a half-vector, tangent to n: one step along the lobe
    float alpha;  // of each read
    vec3 n_scaled_v;  // alpha_t (t.v), alpha_b (b.v), n.v
    vec3 t;
    vec3 b;
    vec2 surface_alpha;
};

// Own fit (`candela bake lobes`; bake/layer_fit.hpp says by which measure). How much of the difference of the ellipse's squared
// axes each read is wider than the shorter one; where the inner and the outer reads stand, in steps along the lobe; their shares
// over the middle one's. That fit finds others that err 1 % less by its own measure, and 9 % more under the lights of
// image_light_layers; these stay.
CONSTANT float kAnisotropicWidening = 0.041f;
CONSTANT vec2 kAnisotropicPlaces = vec2(0.631f, 1.853f);
CONSTANT vec2 kAnisotropicShares = vec2(0.766f, 0.363f);

// Own work. v, n, t, b: unit; NoV in (0,1].
FN AnisotropicLobe anisotropic_lobe_widened(vec3 n, vec3 t, vec3 b, vec3 v, float NoV, vec2 alpha, float widening) {
    // In the plane of incidence, away from the viewer, and across it; along the tangent where there is no plane.
    vec3 away = NoV * n - v;
    float sine2 = dot(away, away);
    away = sine2 > 1.0e-8f ? away * inversesqrt(sine2) : t;
    vec3 across = cross(n, away);
    float cosine = dot(t, away);
    float sine = dot(t, across);
    vec2 a2 = alpha * alpha;
    float in_plane = a2.x * cosine * cosine + a2.y * sine * sine;
    float mixed = (a2.x - a2.y) * sine * cosine;
    float across_reflected = (a2.x * sine * sine + a2.y * cosine * cosine) * NoV * NoV;
    float half_sum = 0.5f * (in_plane + across_reflected);
    float half_difference = 0.5f * (in_plane - across_reflected);
    float root = sqrt(half_difference * half_difference + mixed * mixed * NoV * NoV);
    float longer = half_sum + root;
    float shorter = max(half_sum - root, 0.0f);
    // Of the two forms of the eigenvector the one that does not cancel; the second number is over NoV, as a slope is.
    vec2 axis = half_difference >= 0.0f ? vec2(half_difference + root, mixed)
                                        : vec2(mixed * NoV, (root - half_difference) / NoV);
    float norm = length(vec2(axis.x, axis.y * NoV));
    axis = norm > 1.0e-12f ? axis / norm : vec2(1.0f, 0.0f);
    AnisotropicLobe lobe;
    lobe.n = n;
    lobe.v = v;
    lobe.slope = sqrt(longer - shorter) * (axis.x * away + axis.y * across);
    lobe.alpha = sqrt(shorter + widening * (longer - shorter));
    lobe.n_scaled_v = vec3(alpha.x * dot(t, v), alpha.y * dot(b, v), NoV);
    lobe.t = t;
    lobe.b = b;
    lobe.surface_alpha = alpha;
    return lobe;
}
FN AnisotropicLobe anisotropic_lobe(vec3 n, vec3 t, vec3 b, vec3 v, float NoV, vec2 alpha) {
    return anisotropic_lobe_widened(n, t, b, v, NoV, alpha, kAnisotropicWidening);
}

// The read `place` steps along the lobe. Its weight is relative: G2 / G1 of the density of visible normals, 0 below the horizon;
// the middle one's is never 0.
FN LobeRead anisotropic_read_at(AnisotropicLobe lobe, float place, float share) {
    vec3 h = normalize(lobe.n + place * lobe.slope);
    float VoH = dot(lobe.v, h);
    vec3 l = 2.0f * VoH * h - lobe.v;
    float NoV = lobe.n_scaled_v.z;
    float NoL = max(dot(lobe.n, l), 0.0f);
    float root_v = length(lobe.n_scaled_v);
    float root_l = length(vec3(lobe.surface_alpha.x * dot(lobe.t, l), lobe.surface_alpha.y * dot(lobe.b, l), NoL));
    float g2_over_g1 = NoL * (NoV + root_v) / max(NoL * root_v + NoV * root_l, 1.0e-7f);
    return LobeRead(l, sqrt(min(lobe.alpha, 1.0f)), share * max(VoH, 0.0f) * g2_over_g1);
}
// Read i of kAnisotropicReads.
FN LobeRead anisotropic_read(AnisotropicLobe lobe, int i) {
    bool inner = i == 1 || i == 3;
    float place = i == 2 ? 0.0f : (inner ? kAnisotropicPlaces.x : kAnisotropicPlaces.y) * (i < 2 ? -1.0f : 1.0f);
    float share = i == 2 ? 1.0f : (inner ? kAnisotropicShares.x : kAnisotropicShares.y);
    return anisotropic_read_at(lobe, place, share);
}

// The usual stand-in: the mirror direction about a normal that is bent towards the viewer across the grain, with the width of
// the narrow side. Revie 2011 ("Implementing Fur Using Deferred Shading"), as KHR_materials_anisotropy's sample renderer has it.
FN vec3 anisotropic_bent_normal(vec3 n, vec3 b, vec3 v, float anisotropy, float perceptual_roughness) {
    vec3 bent = cross(cross(b, v), b);
    return normalize(mix(n, normalize(bent), anisotropy * saturate(5.0f * perceptual_roughness)));
}

// Own fit (`candela bake lobes`; bake/layer_fit.hpp says by which measure): polynomials in NoV (c) and sheen roughness (r), by
// 1, c, r and c c, c r, r r.
CONSTANT vec3 kSheenTilt = vec3(1.9477f, 0.7512f, -6.8963f);
CONSTANT vec3 kSheenTiltSquares = vec3(1.3103f, -0.7637f, 3.6233f);
CONSTANT vec3 kSheenWidth = vec3(1.0871f, -3.0722f, 3.2829f);
CONSTANT vec3 kSheenWidthSquares = vec3(2.8589f, -2.5834f, -0.3481f);

// log_tilt: of the direction towards the viewer, over the sine of the view's angle.
FN LobeRead sheen_read_at(vec3 n, vec3 v, float NoV, float log_tilt, float width) {
    return LobeRead(normalize(n + exp(log_tilt) * (v - NoV * n)), saturate(width), 1.0f);
}

// One read for sheen, whose lobe lies along the horizon and leans to the viewer's side, where a prefiltered map has no such
// shape.
FN LobeRead sheen_read(vec3 n, vec3 v, float NoV, float sheen_perceptual_roughness) {
    float c = NoV;
    float r = sheen_perceptual_roughness;
    vec3 low = vec3(1.0f, c, r);
    vec3 squares = vec3(c * c, c * r, r * r);
    return sheen_read_at(n, v, NoV, dot(kSheenTilt, low) + dot(kSheenTiltSquares, squares),
                         dot(kSheenWidth, low) + dot(kSheenWidthSquares, squares));
}

CANDELA_SHADING_END

#endif
