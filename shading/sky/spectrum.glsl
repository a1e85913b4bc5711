// The spectrum that a clear sky is computed in: 16 bands of 20 nm from 400 to 720 nm, with what lies beyond folded into
// the first and the last. Sunlight and the observer are in the weights of the bands, so that everything between is a
// number without a unit: what share of the sun's light of this band arrives.
#ifndef CANDELA_SKY_SPECTRUM_GLSL
#define CANDELA_SKY_SPECTRUM_GLSL

#include "../color_temperature.glsl"
#include "../photometry.glsl"

CANDELA_SHADING_BEGIN

CONSTANT int kSkyBands = 16;
// Bins of 10 nm that the tables hold; the first is 380 to 390 nm.
CONSTANT int kSkyBins = 40;
CONSTANT float kSkyBin_nm = 10.0f;

// W/(m^2 nm) of the sun outside the atmosphere at 1 astronomical unit: ASTM G-173, extraterrestrial column, means of
// bins as Bruneton 2017 ("A Qualitative and Quantitative Evaluation of 8 Clear Sky Models") took them.
CONSTANT float kSunIrradiance[40] = {
    1.01249f, 1.14716f, 1.72765f, 1.73054f, 1.68870f, 1.61253f, 1.91198f, 2.03474f, 2.02042f, 2.02212f,
    1.93377f, 1.95809f, 1.91686f, 1.82980f, 1.86850f, 1.89310f, 1.85149f, 1.85040f, 1.83410f, 1.83450f,
    1.81470f, 1.78158f, 1.75330f, 1.69650f, 1.68194f, 1.64654f, 1.60480f, 1.52143f, 1.55622f, 1.51130f,
    1.47400f, 1.44820f, 1.41018f, 1.36775f, 1.34188f, 1.31429f, 1.28303f, 1.26758f, 1.23670f, 1.20820f};

// 1e-26 m^2 a molecule of ozone at 233 K: Serdyuchenko et al. 2014, means of bins (Bruneton 2017).
CONSTANT float kOzoneCrossSection[40] = {
    0.02818f, 0.06636f, 0.1527f, 0.2763f, 0.552f, 0.8451f, 1.582f, 2.316f, 3.669f, 4.924f,
    7.752f,   9.016f,   14.80f,  16.02f,  21.39f, 27.55f,  30.91f, 35.00f, 42.66f, 46.72f,
    43.98f,   47.01f,   50.19f,  43.05f,  37.40f, 32.15f,  26.62f, 22.38f, 18.52f, 14.73f,
    12.09f,   9.423f,   7.455f,  6.566f,  5.105f, 4.150f,  4.228f, 3.237f, 2.451f, 2.801f};

// One number a band.
struct SkyBands {
    float of[16];
};

// The band that a bin belongs to.
FN int sky_band_of_bin(int bin) {
    return clamp(bin / 2 - 1, 0, kSkyBands - 1);
}

FN float sky_bin_center_um(int bin) {
    return 1.0e-3f * (kObserverFirst_nm + kSkyBin_nm * (float(bin) + 0.5f));
}

// lx of unattenuated sunlight at normal incidence in a bin, as CIE XYZ: the observer is the mean over the bin.
FN vec3 sky_bin_xyz_lx(int bin) {
    vec3 observer = 0.5f * (kObserver1931[bin] + kObserver1931[bin + 1]);
    return kMaxLuminousEfficacy * kSkyBin_nm * kSunIrradiance[bin] * observer;
}

// Vertical optical depth of the air above sea level (1013.25 hPa, 45 degrees north): Bodhaine, Wood, Dutton & Slusser
// 1999, "On Rayleigh Optical Depth Calculations", equation 30.
FN float rayleigh_optical_depth(float wavelength_um) {
    float w2 = square(wavelength_um);
    return 0.0021520f * (1.0455996f - 341.29061f / w2 - 0.90230850f * w2) /
           (1.0f + 0.0027059889f / w2 - 85.968563f * w2);
}

// Vertical optical depth of the aerosol above sea level by turbidity (1: none, 2: very clear, 3: clear, 6: hazy): Preetham,
// Shirley & Smits 1999, appendix A.1, Angstrom's formula with exponent 1.3 and their fit of its factor. Their fit leaves
// 2e-4 at turbidity 1; here it is no aerosol.
FN float aerosol_optical_depth(float wavelength_um, float turbidity) {
    float beta = max(0.04608f * turbidity - 0.04586f, 0.0f);
    return turbidity > 1.0f ? beta * pow(wavelength_um, -1.3f) : 0.0f;
}

CANDELA_SHADING_END

#endif
