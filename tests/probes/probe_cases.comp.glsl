#version 460
#extension GL_GOOGLE_include_directive : require
#include "probe_cases.glsl"
#define AGREEMENT_CASES(X) PROBE_CASES(X)
#include "../shading/agreement_kernel.glsl"
