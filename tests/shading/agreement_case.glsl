// What a case of a GLSL-against-C++ test is: a function from kAgreementNumbers uniform numbers to four
// results. A case file includes this, defines cases and lists them in a macro LIST(X) of X(function,
// tolerance) entries; tolerance is relative to the larger of the result's component and the fourth part of
// the result's largest one.
#ifndef CANDELA_AGREEMENT_CASE_GLSL
#define CANDELA_AGREEMENT_CASE_GLSL

#include "../../shading/language.glsl"

CANDELA_SHADING_BEGIN

CONSTANT int kAgreementNumbers = 24;

#ifdef __cplusplus
struct Numbers {
    float values[kAgreementNumbers];
    float operator[](int i) const { return values[i]; }
};
#define NUMBERS const candela::shading::Numbers& u
#else
#define NUMBERS float u[kAgreementNumbers]
#endif

// 1 and 0 exactly, one time in 16 each: edges are where languages differ.
FN float with_edges(float x) {
    return saturate((x - 0.0625f) * 1.142857143f);
}

FN float between(float low, float high, float x) {
    return low + (high - low) * x;
}

// A unit vector of this z.
FN vec3 case_direction_of(float z, float turn) {
    float r = sqrt(max(1.0f - z * z, 0.0f));
    return vec3(r * cos(TWO_PI * turn), r * sin(TWO_PI * turn), z);
}

// Uniform on the sphere but for the poles, where angles have no digits.
FN vec3 case_sphere_direction(float a, float b) {
    return case_direction_of(between(-0.999f, 0.999f, a), b);
}

CANDELA_SHADING_END

#endif
