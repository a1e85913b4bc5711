#version 460
#extension GL_GOOGLE_include_directive : require
#include "photometry_cases.glsl"
#define AGREEMENT_CASES(X) PHOTOMETRY_CASES(X)
#include "../shading/agreement_kernel.glsl"
