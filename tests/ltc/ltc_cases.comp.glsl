#version 460
#extension GL_GOOGLE_include_directive : require
#include "ltc_cases.glsl"
#define AGREEMENT_CASES(X) LTC_CASES(X)
#include "../shading/agreement_kernel.glsl"
