#version 460
#extension GL_GOOGLE_include_directive : require
// The lighting pass with all that it can do; lighting_variant.hpp has the choice.
#include "lighting.glsl"
