// Sheen of cloth: the Charlie model, Estevez & Kulla 2017 ("Production Friendly Microfacet Sheen BRDF"), with
// the parameters of KHR_materials_sheen.
#ifndef CANDELA_SHEEN_GLSL
#define CANDELA_SHEEN_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// alpha = perceptual_roughness^2. Below 0.07 the exponent 1 / alpha passes 200 and the lobe is a line at the
// silhouette that no sampling finds.
CONSTANT float kMinSheenPerceptualRoughness = 0.07f;

FN float sheen_alpha(float sheen_perceptual_roughness) {
    return square(clamp(sheen_perceptual_roughness, kMinSheenPerceptualRoughness, 1.0f));
}

// Estevez & Kulla 2017, equation 2; 1/sr.
FN float D_Charlie(float NoH, float alpha) {
    float sin2 = max((1.0f - NoH) * (1.0f + NoH), 0.0f);
    float inverse = 1.0f / alpha;
    return (2.0f + inverse) * pow(sin2, 0.5f * inverse) * (0.5f * INV_PI);
}

// Fit of the Smith integral of D_Charlie: Estevez & Kulla 2017, equation 3 and Table 1.
FN float charlie_lambda_exponent(float x, float alpha) {
    float t = square(1.0f - alpha);
    float a = mix(21.5473f, 25.3245f, t);
    float b = mix(3.82987f, 3.32435f, t);
    float c = mix(0.19823f, 0.16801f, t);
    float d = mix(-1.97760f, -1.27393f, t);
    float e = mix(-4.32054f, -4.85967f, t);
    return a / (1.0f + b * pow(x, c)) + d * x + e;
}
FN float charlie_lambda(float cosine, float alpha) {
    if (cosine < 0.5f) return exp(charlie_lambda_exponent(cosine, alpha));
    return exp(2.0f * charlie_lambda_exponent(0.5f, alpha) - charlie_lambda_exponent(1.0f - cosine, alpha));
}

// 1 / ((1 + Lambda(v) + Lambda(l)) 4 NoV NoL), without the artistic softening of the terminator, which is not
// reciprocal. The guard prevents infinity at the horizon.
FN float V_Charlie(float NoV, float NoL, float alpha) {
    return 1.0f /
           max((1.0f + charlie_lambda(NoV, alpha) + charlie_lambda(NoL, alpha)) * 4.0f * NoV * NoL, 1.0e-7f);
}

// Directional albedo of D_Charlie V_Charlie: own fit to its quadrature for perceptual roughness 0.07 to 1 and
// NoV 0.002 to 1, error at most 0.0035 (relative above 1). exp of a polynomial in roughness and in cube roots
// of NoV, because the fit of Lambda has the power 0.2 of the cosine in it. It is above 1 where a smooth sheen
// grazes: 2.9 at the worst.
FN float charlie_albedo(float NoV, float sheen_perceptual_roughness) {
    float r = clamp(sheen_perceptual_roughness, kMinSheenPerceptualRoughness, 1.0f);
    float x = clamp(NoV, 0.002f, 1.0f);
    float root = pow(x, 1.0f / 3.0f);
    float p0 =
        ((((-3.607475f * r + 7.699121f) * r - 4.839626f) * r + 0.316953f) * r + 0.060223f) * r - 0.000266f;
    float p1 =
        ((((1.212921f * r - 5.710231f) * r + 7.981888f) * r - 0.794763f) * r + 0.722902f) * r - 0.026596f;
    float p2 =
        ((((0.247678f * r + 9.815656f) * r - 22.041098f) * r + 4.190720f) * r - 3.287924f) * r + 0.106536f;
    float p3 =
        ((((3.098705f * r - 21.312958f) * r + 36.227791f) * r - 12.907782f) * r + 3.717944f) * r - 0.138192f;
    float p4 =
        ((((-8.518498f * r + 35.766049f) * r - 50.099014f) * r + 23.821178f) * r - 4.619421f) * r - 0.018401f;
    float p5 =
        ((((7.573906f * r - 26.532972f) * r + 31.746247f) * r - 12.366993f) * r + 0.481881f) * r + 0.242419f;
    float p = p0 + root * (p1 + root * p2) + x * (p3 + x * (p4 + x * p5));
    return exp(p / (r * r));
}

// Directional albedo of the lobe below, for white sheen; at most 1.
FN float sheen_directional_albedo(float NoV, float sheen_perceptual_roughness) {
    return min(charlie_albedo(NoV, sheen_perceptual_roughness), 1.0f);
}

// The lobe for white sheen in 1/sr. Changed from Estevez & Kulla: where D V would reflect more than it
// receives, it is scaled down to 1. Cosines in [0,1].
FN float evaluate_sheen(float NoV, float NoL, float NoH, float sheen_perceptual_roughness) {
    float alpha = sheen_alpha(sheen_perceptual_roughness);
    return D_Charlie(NoH, alpha) * V_Charlie(NoV, NoL, alpha) /
           max(charlie_albedo(NoV, sheen_perceptual_roughness), 1.0f);
}

// What is left for the layers below, so that they and the sheen stay within 1: KHR_materials_sheen, albedo
// scaling.
FN float sheen_transmittance(vec3 sheen_color, float sheen_albedo) {
    return 1.0f - saturate(max_component(sheen_color) * sheen_albedo);
}

CANDELA_SHADING_END

#endif
