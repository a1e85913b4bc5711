#version 460
#extension GL_GOOGLE_include_directive : require
// The forward pass with all that it can do; lighting_variant.hpp has the choice.
#include "forward.glsl"
