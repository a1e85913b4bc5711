// From exposed scene light to what a display shows. Input: linear Rec.709, 1 = sensor saturation
// (exposure.glsl). Output: display-linear Rec.709 in [0,1], to be encoded by transfer.glsl.
#ifndef CANDELA_TONE_CURVES_GLSL
#define CANDELA_TONE_CURVES_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

CONSTANT int kToneNone = 0;
CONSTANT int kToneAces = 1;
CONSTANT int kToneAgx = 2;
CONSTANT int kToneNeutral = 3;

// Stephen Hill's fit of the ACES 1.0 reference rendering transform and the 100 nit Rec.709 output transform
// (RRT+ODT; MJP's BakingLab, ACES.hlsl). Matrices: linear sRGB to AP1 with RRT saturation, and back with ODT
// saturation. No exposure gain is applied (some viewers divide by 0.6): 18 % grey comes out at 10.6 %.
FN vec3 tone_aces(vec3 exposed) {
    mat3 to_rrt =
        mat3(0.59719f, 0.07600f, 0.02840f, 0.35458f, 0.90834f, 0.13383f, 0.04823f, 0.01566f, 0.83777f);
    mat3 from_odt =
        mat3(1.60475f, -0.10208f, -0.00327f, -0.53108f, 1.10813f, -0.07276f, -0.07367f, -0.00605f, 1.07602f);
    // 65504 keeps the squares below finite; the curve is flat to 1e-5 long before.
    vec3 v = to_rrt * clamp(exposed, vec3(0.0f), vec3(65504.0f));
    vec3 numerator = v * (v + vec3(0.0245786f)) - vec3(0.000090537f);
    vec3 denominator = v * (0.983729f * v + vec3(0.4329510f)) + vec3(0.238081f);
    return saturate(from_odt * (numerator / denominator));
}

// One channel of AgX's contrast: a sigmoid in log exposure with slope 2 through 0.5 at middle grey. t in
// [0,1]. (Troy Sobotka's AgX, contrast 2, limits 3 and 3.25.) On each side of the pivot it is s / (1 + a
// |s/2|^p)^(1/p) with s = 2 (t - pivot); the a make it reach 0 at 0 and 1 at 1: a = ((4 d)^p - 1) / d^p, d
// the distance to that end.
FN float agx_contrast(float t) {
    float from_pivot = t - 0.606060606f;  // 10 / 16.5 stops
    float toe = 1.0f + 59.507875f * pow(max(-from_pivot, 0.0f), 3.0f);
    float shoulder = 1.0f + 69.862789f * pow(max(from_pivot, 0.0f), 3.25f);
    return 0.5f + 2.0f * from_pivot * pow(toe, -1.0f / 3.0f) * pow(shoulder, -1.0f / 3.25f);
}

// AgX base look: inset matrix, log2 from 10 stops below to 6.5 stops above middle grey (0.18), sigmoid,
// outset matrix, decoded with the 2.2 power of its display. (Sobotka's AgX configuration; Wrensch 2023,
// "Minimal AgX Implementation", which fits the sigmoid by a polynomial; here the sigmoid itself.)
FN vec3 tone_agx(vec3 exposed) {
    mat3 inset = mat3(0.842479062f, 0.0423282423f, 0.0423756549f, 0.0784336000f, 0.878468636f, 0.0784336000f,
                      0.0792237451f, 0.0791661275f, 0.879142974f);
    mat3 outset = mat3(1.19687900512f, -0.0528968518f, -0.0529716355f, -0.0980208811f, 1.15190312990f,
                       -0.0980434501f, -0.0990297441f, -0.0989611768f, 1.15107367264f);
    // 2^-20 is far below the curve's black and keeps the logarithm finite.
    vec3 v = max(inset * max(exposed, vec3(0.0f)), vec3(9.5367432e-7f));
    vec3 t = saturate((log2(v) + vec3(12.4739311883f)) / 16.5f);
    vec3 encoded = outset * vec3(agx_contrast(t.x), agx_contrast(t.y), agx_contrast(t.z));
    return pow(saturate(encoded), vec3(2.2f));
}

// Khronos PBR Neutral (KhronosGroup/ToneMapping, PBR_Neutral specification): subtracts the 4 % Fresnel
// reflection of a dielectric so that base colours come out as authored, then compresses what lies above 0.8 -
// 0.04 towards 1 while desaturating it.
FN vec3 tone_neutral(vec3 exposed) {
    float f90 = 0.04f;
    float compression_start = 0.8f - f90;
    float desaturation = 0.15f;
    vec3 c = max(exposed, vec3(0.0f));
    float x = min(c.x, min(c.y, c.z));
    float offset = x <= 2.0f * f90 ? x - x * x / (4.0f * f90) : f90;
    c = c - vec3(offset);
    float peak = max_component(c);
    if (peak <= compression_start) return c;
    float headroom = 1.0f - compression_start;
    float new_peak = 1.0f - headroom * headroom / (peak + headroom - compression_start);
    float g = 1.0f / (desaturation * (peak - new_peak) + 1.0f);
    return mix(vec3(new_peak), c * (new_peak / peak), vec3(g));
}

// kind: one of kTone*; anything else is treated as kToneNone, which clips each channel at saturation.
FN vec3 tone_curve(int kind, vec3 exposed) {
    if (kind == kToneAces) return tone_aces(exposed);
    if (kind == kToneAgx) return tone_agx(exposed);
    if (kind == kToneNeutral) return tone_neutral(exposed);
    return saturate(exposed);
}

// The factor before a curve by which 18 % grey comes out as 18 %: a metered grey card is equally bright under every
// curve. Neutral: its offset of 0.04 added. ACES and AgX: solved for the green channel.
FN float tone_grey_gain(int kind) {
    if (kind == kToneAces) return 1.461926f;
    if (kind == kToneAgx) return 0.789357f;
    if (kind == kToneNeutral) return 0.22f / 0.18f;
    return 1.0f;
}

// What a display shows of exposed light, linear.
FN vec3 display_from_exposed(int kind, vec3 exposed) {
    return tone_curve(kind, exposed * tone_grey_gain(kind));
}

// The same where unlit surfaces cover part of a pixel. exposed: light summed over the rest, a its fraction of the pixel in
// [0,1]. unlit: the surfaces' colour, display-linear, times the fraction they cover; KHR_materials_unlit shows it as it is.
FN vec3 display_with_unlit(int kind, vec4 exposed, vec3 unlit) {
    vec3 lit = vec3(exposed.x, exposed.y, exposed.z);
    if (exposed.w <= 0.001f) return saturate(unlit + lit);
    return saturate(exposed.w * display_from_exposed(kind, lit / exposed.w) + unlit);
}

CANDELA_SHADING_END

#endif
