#version 460
#extension GL_GOOGLE_include_directive : require
// The forward pass of --mode integrate.
#include "frame.glsl"
#include "material.glsl"
#include "integrate.glsl"

Lit light_surface(GBuffer g, vec3 position, vec3 v, uvec2 pixel) { return integrate(g, position, v, pixel); }

#include "blended_surface.glsl"
