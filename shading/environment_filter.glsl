// The LD term of the split sum with n = v = r: a blur of the sphere that depends on the angle to the direction looked up alone.
#ifndef CANDELA_ENVIRONMENT_FILTER_GLSL
#define CANDELA_ENVIRONMENT_FILTER_GLSL

#include "environment.glsl"
#include "microfacet.glsl"

CANDELA_SHADING_BEGIN

// Squared sine of half the angle between unit vectors, which keeps its digits where they nearly coincide.
FN float half_sine2(vec3 a, vec3 b) {
    vec3 d = a - b;
    return 0.25f * dot(d, d);
}

// Integral over the sphere of ld_weight: D N.L of Frostbite equation 53, N = V, in s = sin^2 of half the angle; d omega is 4 pi ds.
// Near alpha = 1, where the closed form is 0/0, its series.
FN float ld_weight_integral(float alpha) {
    float a2 = alpha * alpha;
    float b = (1.0f - alpha) * (1.0f + alpha);
    if (b < 0.15f) return 1.0f + b * (2.0f / 3.0f + b * (11.0f / 24.0f + b * (0.325f + b * 0.2375f)));
    return 4.0f / (b * b) * (b - 2.0f * a2 * log(0.5f * (1.0f + a2) / a2));
}

// Weight of light from a direction at half_sine2 s: density of GGX half-vectors times N.L, Frostbite 4.9.2, equation 53 (Karis
// 2013, "Pre-Filtered Environment Map"), N = V. Not normalized.
FN float ld_weight(float s, float alpha) {
    return D_GGX_cos2_sin2(1.0f - s, s, alpha) * max(1.0f - 2.0f * s, 0.0f);
}

// half_sine2 below which the share u of the GGX half-vectors lies; the angle of the light is twice the half-vector's: Walter et
// al. 2007, equation 35.
FN float ggx_half_sine2(float u, float alpha) {
    float a2 = alpha * alpha;
    return u * a2 / (1.0f - u + u * a2);
}

// Exponent of the cosine lobe about the mirror direction that stands for a width of GGX: Blinn's exponent 2 / alpha^2 - 2 (Walter
// et al. 2007, section 5.2) by four, because the angle to the mirror direction is twice that to the normal, which is the
// exponent behind D_Approx of Karis 2014, and one more for N.L.
FN float cosine_power_from_alpha(float alpha) {
    return max(0.5f / (alpha * alpha) - 0.5f, 0.0f) + 1.0f;
}

// Arc tangent of y/x in the right quadrant within 2e-7 rad, without branches: a polynomial through the nodes of Chebyshev's of
// degree 8 in the square, on [0,1]; the rest by symmetry. atan2_close(0, 0) is 0.
FN float atan2_close(float y, float x) {
    float ax = abs(x);
    float ay = abs(y);
    float t = min(ax, ay) / max(max(ax, ay), 1.0e-30f);
    float s = t * t;
    float p = -0.00455979199f;
    p = p * s + 0.0237805186f;
    p = p * s - 0.0588297531f;
    p = p * s + 0.0986886546f;
    p = p * s - 0.140032902f;
    p = p * s + 0.199669618f;
    p = p * s - 0.333318127f;
    p = (p * s + 0.999999882f) * t;
    p = ay > ax ? 0.5f * PI - p : p;
    p = x < 0.0f ? PI - p : p;
    return y < 0.0f ? -p : p;
}

// equirect_uv within 1e-7, for loops over many directions that need not be unit.
FN vec2 equirect_uv_close(vec3 direction) {
    float across = sqrt(direction.x * direction.x + direction.z * direction.z);
    return vec2(0.5f + atan2_close(direction.x, -direction.z) * (1.0f / TWO_PI),
                atan2_close(across, direction.y) * INV_PI);
}

CANDELA_SHADING_END

#endif
