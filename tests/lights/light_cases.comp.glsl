#version 460
#extension GL_GOOGLE_include_directive : require
#include "light_cases.glsl"
#define AGREEMENT_CASES(X) LIGHT_CASES(X)
#include "../shading/agreement_kernel.glsl"
