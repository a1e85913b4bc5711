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

// Directional albedo of D V for white sheen; FIT.
FN float sheen_directional_albedo(float NoV, float sheen_perceptual_roughness) {
    float r = clamp(sheen_perceptual_roughness, kMinSheenPerceptualRoughness, 1.0f);
    float c = 1.0f - NoV;
    return saturate(0.65584461f * c * c * c +
                    1.0f / (4.16526551f + exp(-7.97291361f * sqrt(r) + 6.33516894f)));
}

// What is left for the layers below, so that they and the sheen stay within 1: KHR_materials_sheen, albedo
// scaling.
FN float sheen_transmittance(vec3 sheen_color, float sheen_albedo) {
    return 1.0f - saturate(max_component(sheen_color) * sheen_albedo);
}

CANDELA_SHADING_END

#endif
