#version 460
#extension GL_GOOGLE_include_directive : require
// The lighting pass for lights without extent, without shadows.
#define CANDELA_WITHOUT_AREA_LIGHTS
#define CANDELA_WITHOUT_SHADOWS
#include "lighting.glsl"
