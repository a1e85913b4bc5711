#version 460
#extension GL_GOOGLE_include_directive : require
#include "bsdf_cases.glsl"
#define AGREEMENT_CASES(X) BSDF_CASES(X)
#include "agreement_kernel.glsl"
