// How light that a clear sky scatters more than once is kept account of.
//
// Aerosol scatters mostly forward, and light that it scatters a little off its way goes on nearly as if it had not been.
// So a share of its scattering is taken for none at all ("narrowed" in atmosphere.glsl: Joseph, Wiscombe & Weinman 1976,
// delta-Eddington), which leaves a thinner air whose further scattering is nearly even. Towards the eye the last scattering
// has its own phase function again (Nakajima & Tanaka 1988, TMS), and here that of as many scatterings as the way holds.
#ifndef CANDELA_SKY_SCATTERING_GLSL
#define CANDELA_SKY_SCATTERING_GLSL

#include "atmosphere.glsl"

CANDELA_SHADING_BEGIN

// (1 - exp(-x)) / x with pass = exp(-x): the mean of what passes on a way of optical depth x. The series where the
// difference would be all rounding.
FN float mean_transmittance(float x, float pass) {
    float series = 1.0f - x * (0.5f - x * (0.16666667f - x * 0.041666667f));
    return x < 0.05f ? series : (1.0f - pass) / max(x, 1.0e-3f);
}

// Phase function, 1/sr, of light that aerosol scattered order + 1 times one after the other: functions of Henyey and
// Greenstein convolve to one whose asymmetry is the product.
FN float forward_phase(float cosine, int order) {
    float g = kAerosolAsymmetry;
    for (int i = 0; i < order; ++i) g *= kAerosolAsymmetry;
    return henyey_greenstein_phase(cosine, g);
}

// Of light that is scattered towards the eye, on a way whose forward scattering has this optical depth y: the shares that
// aerosol scattered once, twice, three times, and more often in all. The share kForwardShare of the last scattering is
// itself forward, so that its number on the way is one of n (y^(n-1)/n!), of the rest it is the last in any place
// (y^(n-1)/(n-1)!): both times exp(-y), their sums (1 - exp(-y))/y and 1. Nakajima & Tanaka's TMS has y = 0, which
// brightens the haze about a low sun twofold.
FN vec4 forward_shares(float y) {
    float none = exp_of_negative(-y);
    float f = kForwardShare;
    float once = none;
    float twice = none * y * 0.5f * (f + (1.0f - f) * 2.0f);
    float thrice = none * square(y) * (1.0f / 6.0f) * (f + (1.0f - f) * 3.0f);
    float all = (1.0f - f) + f * mean_transmittance(y, none);
    return vec4(once, twice, thrice, max(all - once - twice - thrice, 0.0f));
}

// Hillaire 2020, equations 7 and 8: all orders over the last one that was integrated, where each further one is the same
// share of the one before, the mean light where every source is 1.
FN float multiple_scattering_closure(float share) {
    return 1.0f / (1.0f - min(share, 0.99f));
}

CANDELA_SHADING_END

#endif
