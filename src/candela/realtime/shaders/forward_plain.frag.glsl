#version 460
#extension GL_GOOGLE_include_directive : require
// The forward pass for lights without extent, without shadows.
#define CANDELA_WITHOUT_AREA_LIGHTS
#define CANDELA_WITHOUT_SHADOWS
#include "forward.glsl"
