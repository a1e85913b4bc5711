#version 460
#extension GL_GOOGLE_include_directive : require
// The lighting pass of interactive frames, whose light buffer is of half floats, for lights without extent, without shadows.
#define CANDELA_HALF_LIGHT
#define CANDELA_WITHOUT_AREA_LIGHTS
#define CANDELA_WITHOUT_SHADOWS
#include "lighting.glsl"
