// The one lighting pass of the real-time frame: the profile's techniques.
#ifndef CANDELA_LIGHTING_GLSL
#define CANDELA_LIGHTING_GLSL

#include "frame.glsl"
#include "shade.glsl"

// Of the light buffer (C++: FrameResources::light_format()).
#ifdef CANDELA_HALF_LIGHT
#define LIGHT_FORMAT rgba16f
#else
#define LIGHT_FORMAT rgba32f
#endif
const bool kNeedsPosition = kHasLights || kLocalLight != 0u;

#include "light_pixels.glsl"

Lit light_surface(GBuffer g, vec3 position, vec3 v, uvec2 pixel) {
    return shade(g, position, v, kHasLights ? lights_of_tile(pixel / 8u) : 0u, vec4(g.normal, 0.0), ivec2(pixel));
}

#endif
