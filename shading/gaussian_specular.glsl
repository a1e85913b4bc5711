// The Gaussian highlight of the Unreal Engine 4 "Elemental" demo and factors that normalize it: Narkowicz, "Unreal
// Engine 4 Gaussian specular normalization".
#ifndef CANDELA_GAUSSIAN_SPECULAR_GLSL
#define CANDELA_GAUSSIAN_SPECULAR_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Narkowicz's shader: a Gaussian in 1 - NoH that has fallen to 1/e where NoH^power is 4 %. power in [1, 512]. The BRDF is
// this times a normalization below.
FN float gaussian_specular(float NoH, float power) {
    float cos_edge = pow(0.04f, 1.0f / power);
    float x = (NoH - 1.0f) / (cos_edge - 1.0f);
    return exp(-x * x);
}

// 1 over the integral of gaussian_specular cos(theta) over the hemisphere of a light seen along the normal; Narkowicz's
// straight line.
FN float gaussian_specular_normalization_line(float power) {
    return 0.17287429f + 0.01388682f * power;
}

// As above, by a hyperbola, after the comment there that the curve looks like one. Own fit: least squares of the relative
// error over a logarithmic grid of powers; `candela validate --only narkowicz_normalization` repeats it.
FN float gaussian_specular_normalization_hyperbola(float power) {
    return 0.132258f + 0.01402651f * sqrt(power * power + 183.65f);
}

CANDELA_SHADING_END

#endif
