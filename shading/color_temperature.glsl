// Colour temperature to linear Rec.709 of luminance 1. Multiply a light's photometric value by it.
#ifndef CANDELA_COLOR_TEMPERATURE_GLSL
#define CANDELA_COLOR_TEMPERATURE_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// CIE 1931 2 degree colour-matching functions at 380, 390 ... 780 nm (CIE 15, Table T.4; ISO/CIE 11664-1).
// The multi-lobe fit of Wyman, Sloan & Shirley 2013 was tried: it is off by 0.003 in x and y at 2000 K, more
// than ten times as far as the sum over this table.
CONSTANT int kObserverCount = 41;
CONSTANT float kObserverFirst_nm = 380.0f;
CONSTANT float kObserverStep_nm = 10.0f;
CONSTANT vec3 kObserver1931[41] = {
    vec3(0.001368f, 0.000039f, 0.006450f), vec3(0.004243f, 0.000120f, 0.020050f),
    vec3(0.014310f, 0.000396f, 0.067850f), vec3(0.043510f, 0.001210f, 0.207400f),
    vec3(0.134380f, 0.004000f, 0.645600f), vec3(0.283900f, 0.011600f, 1.385600f),
    vec3(0.348280f, 0.023000f, 1.747060f), vec3(0.336200f, 0.038000f, 1.772110f),
    vec3(0.290800f, 0.060000f, 1.669200f), vec3(0.195360f, 0.090980f, 1.287640f),
    vec3(0.095640f, 0.139020f, 0.812950f), vec3(0.032010f, 0.208020f, 0.465180f),
    vec3(0.004900f, 0.323000f, 0.272000f), vec3(0.009300f, 0.503000f, 0.158200f),
    vec3(0.063270f, 0.710000f, 0.078250f), vec3(0.165500f, 0.862000f, 0.042160f),
    vec3(0.290400f, 0.954000f, 0.020300f), vec3(0.433450f, 0.994950f, 0.008750f),
    vec3(0.594500f, 0.995000f, 0.003900f), vec3(0.762100f, 0.952000f, 0.002100f),
    vec3(0.916300f, 0.870000f, 0.001650f), vec3(1.026300f, 0.757000f, 0.001100f),
    vec3(1.062200f, 0.631000f, 0.000800f), vec3(1.002600f, 0.503000f, 0.000340f),
    vec3(0.854450f, 0.381000f, 0.000190f), vec3(0.642400f, 0.265000f, 0.000050f),
    vec3(0.447900f, 0.175000f, 0.000020f), vec3(0.283500f, 0.107000f, 0.000000f),
    vec3(0.164900f, 0.061000f, 0.000000f), vec3(0.087400f, 0.032000f, 0.000000f),
    vec3(0.046770f, 0.017000f, 0.000000f), vec3(0.022700f, 0.008210f, 0.000000f),
    vec3(0.011359f, 0.004102f, 0.000000f), vec3(0.005790f, 0.002091f, 0.000000f),
    vec3(0.002899f, 0.001047f, 0.000000f), vec3(0.001440f, 0.000520f, 0.000000f),
    vec3(0.000690f, 0.000249f, 0.000000f), vec3(0.000332f, 0.000120f, 0.000000f),
    vec3(0.000166f, 0.000060f, 0.000000f), vec3(0.000083f, 0.000030f, 0.000000f),
    vec3(0.000042f, 0.000015f, 0.000000f)};

// Planck's law relative to its value at 560 nm, where photopic vision peaks: of order 1 at every temperature,
// so that single precision neither overflows nor vanishes. Second radiation constant 1.4388e-2 m K (CIE 15).
FN float planck_relative(float wavelength_nm, float kelvin) {
    float x = 1.4388e7f / (wavelength_nm * kelvin);
    float x560 = 1.4388e7f / (560.0f * kelvin);
    float ratio = 560.0f / wavelength_nm;
    return square(ratio * ratio) * ratio * exp(x560 - x) * (1.0f - exp(-x560)) / (1.0f - exp(-x));
}

// CIE 1931 x, y of a black body. kelvin 800 to 1e6 (below, all of the visible lies in the sum's last bits).
FN vec2 black_body_xy(float kelvin) {
    vec3 xyz = vec3(0.0f);
    for (int i = 0; i < kObserverCount; ++i)
        xyz += kObserver1931[i] * planck_relative(kObserverFirst_nm + kObserverStep_nm * float(i), kelvin);
    return vec2(xyz.x, xyz.y) / (xyz.x + xyz.y + xyz.z);
}

// CIE 1931 x, y of the CIE daylight illuminant D (CIE 15, section 4.1.2): defined by this locus, from which
// the spectra S0, S1, S2 are mixed, so no integration is needed. Clamped to its range, 4000 to 25000 K. D65
// is 6504 K.
FN vec2 daylight_xy(float kelvin) {
    float m = 1000.0f / clamp(kelvin, 4000.0f, 25000.0f);
    float x = kelvin <= 7000.0f ? ((-4.6070f * m + 2.9678f) * m + 0.09911f) * m + 0.244063f
                                : ((-2.0064f * m + 1.9018f) * m + 0.24748f) * m + 0.237040f;
    return vec2(x, (-3.000f * x + 2.870f) * x - 0.275f);
}

// CIE XYZ to linear Rec.709: the inverse of the primaries and D65 white of ITU-R BT.709-6, item 1.3,
// unrounded.
FN vec3 rec709_from_xyz(vec3 xyz) {
    return mat3(3.24096994f, -0.96924364f, 0.05563008f, -1.53738318f, 1.87596750f, -0.20397696f, -0.49861076f,
                0.04155506f, 1.05697151f) *
           xyz;
}

// A colour that the gamut may not hold, as none of its channels negative: mixed with white of the same luminance until it
// fits, so that luminance and, nearly, hue stay. luminance(c) > 0 or c = 0.
FN vec3 rec709_into_gamut(vec3 c) {
    float y = luminance(c);
    float lowest = min(c.x, min(c.y, c.z));
    float white = lowest < 0.0f ? lowest / (lowest - y) : 0.0f;
    return max(mix(c, vec3(y), vec3(white)), vec3(0.0f));
}

// Chromaticity to linear Rec.709 of luminance 1, within the gamut (black bodies under about 1900 K are not). y > 0.
FN vec3 rec709_from_xy(vec2 xy) {
    vec3 c = rec709_from_xyz(vec3(xy.x, xy.y, 1.0f - xy.x - xy.y) / xy.y);
    return rec709_into_gamut(c / luminance(c));
}

// Incandescent light: linear Rec.709 with luminance 1.
FN vec3 rec709_from_black_body(float kelvin) {
    return rec709_from_xy(black_body_xy(kelvin));
}

// Daylight: linear Rec.709 with luminance 1; 6504 K gives white.
FN vec3 rec709_from_daylight(float kelvin) {
    return rec709_from_xy(daylight_xy(kelvin));
}

// What a correlated colour temperature alone means, as the reference illuminant of ANSI/IES TM-30: black body
// up to 4000 K, daylight from 5000 K, chromaticities mixed between.
FN vec3 rec709_from_temperature(float kelvin) {
    vec2 xy = mix(black_body_xy(min(kelvin, 5000.0f)), daylight_xy(kelvin),
                  vec2(saturate((kelvin - 4000.0f) / 1000.0f)));
    return rec709_from_xy(xy);
}

CANDELA_SHADING_END

#endif
