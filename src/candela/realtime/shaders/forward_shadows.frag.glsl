#version 460
#extension GL_GOOGLE_include_directive : require
// The forward pass for lights without extent, with shadows.
#define CANDELA_WITHOUT_AREA_LIGHTS
#include "forward.glsl"
