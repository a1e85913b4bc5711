// Between linear light and code values, exactly: a power of 2.2 in place of sRGB is badly wrong near black
// (Frostbite 5.1.5).
#ifndef CANDELA_TRANSFER_GLSL
#define CANDELA_TRANSFER_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// IEC 61966-2-1:1999. linear in [0,1]; negative values pass through the linear part.
FN float srgb_from_linear(float linear_value) {
    if (linear_value <= 0.0031308f) return 12.92f * linear_value;
    return 1.055f * pow(linear_value, 1.0f / 2.4f) - 0.055f;
}

// IEC 61966-2-1:1999, inverse.
FN float linear_from_srgb(float encoded) {
    if (encoded <= 0.04045f) return encoded / 12.92f;
    return pow((encoded + 0.055f) / 1.055f, 2.4f);
}

// ITU-R BT.709-6, item 1.2: the camera's opto-electronic transfer function.
FN float rec709_oetf_from_linear(float linear_value) {
    if (linear_value < 0.018f) return 4.5f * linear_value;
    return 1.099f * pow(linear_value, 0.45f) - 0.099f;
}

// Inverse of rec709_oetf_from_linear. This is not the display's BT.1886. The two pieces meet at 0.018 only
// within the rounding of BT.709's constants (1.099 and 0.018), so the breakpoint is where the linear piece
// ends: 4.5 * 0.018.
FN float linear_from_rec709_oetf(float encoded) {
    if (encoded < 0.081f) return encoded / 4.5f;
    return pow((encoded + 0.099f) / 1.099f, 1.0f / 0.45f);
}

// The sRGB curve for an 8 bit display, without logarithms: own fit in square roots, within 0.1 code values of 255 on [0,1].
FN float srgb_from_linear_8bit(float linear_value) {
    float root = sqrt(max(linear_value, 0.0f));
    float curve = -0.07690595f + 0.8337335f * root + 0.2981216f * sqrt(root) - 0.05530729f * linear_value;
    return linear_value <= 0.0031308f ? 12.92f * linear_value : curve;
}
FN vec3 srgb_from_linear_8bit(vec3 linear_value) {
    return vec3(srgb_from_linear_8bit(linear_value.x), srgb_from_linear_8bit(linear_value.y),
                srgb_from_linear_8bit(linear_value.z));
}

FN vec3 srgb_from_linear(vec3 linear_value) {
    return vec3(srgb_from_linear(linear_value.x), srgb_from_linear(linear_value.y),
                srgb_from_linear(linear_value.z));
}
FN vec3 linear_from_srgb(vec3 encoded) {
    return vec3(linear_from_srgb(encoded.x), linear_from_srgb(encoded.y), linear_from_srgb(encoded.z));
}
FN vec3 rec709_oetf_from_linear(vec3 linear_value) {
    return vec3(rec709_oetf_from_linear(linear_value.x), rec709_oetf_from_linear(linear_value.y),
                rec709_oetf_from_linear(linear_value.z));
}
FN vec3 linear_from_rec709_oetf(vec3 encoded) {
    return vec3(linear_from_rec709_oetf(encoded.x), linear_from_rec709_oetf(encoded.y),
                linear_from_rec709_oetf(encoded.z));
}

// The short cut that Frostbite section 5.1.5 warns of, listing 30: a power in place of sRGB. Only to be measured.
FN float gamma22_from_linear(float linear_value) {
    return pow(linear_value, 1.0f / 2.2f);
}
FN float linear_from_gamma22(float encoded) {
    return pow(encoded, 2.2f);
}

CANDELA_SHADING_END

#endif
