#version 460
#extension GL_GOOGLE_include_directive : require
// The forward pass of the real-time frame.
#include "frame.glsl"
#include "material.glsl"
#include "shade.glsl"

const float kLightLimit = 65504.0;

Lit light_surface(GBuffer g, vec3 position, vec3 v, uvec2 pixel) {
    return shade(g, position, v, kHasLights ? lights_of_cell(vec2(pixel), position) : 0u);
}

#include "blended_surface.glsl"
