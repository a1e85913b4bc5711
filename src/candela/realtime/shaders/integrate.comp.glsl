#version 460
#extension GL_GOOGLE_include_directive : require
// The lighting pass of --mode integrate: one sample of the integrals themselves.
#include "frame.glsl"
#include "integrate.glsl"

#define LIGHT_FORMAT rgba32f
const bool kNeedsPosition = true;

Lit light_surface(GBuffer g, vec3 position, vec3 v, uvec2 pixel) { return integrate(g, position, v, pixel); }

#include "light_pixels.glsl"
