#version 460
#extension GL_GOOGLE_include_directive : require
#include "sky_cases.glsl"
#define AGREEMENT_CASES(X) SKY_CASES(X)
#include "../shading/agreement_kernel.glsl"
