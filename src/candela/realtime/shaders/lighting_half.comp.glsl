#version 460
#extension GL_GOOGLE_include_directive : require
// The lighting pass of interactive frames, whose light buffer is of half floats, with all that it can do.
#define CANDELA_HALF_LIGHT
#include "lighting.glsl"
