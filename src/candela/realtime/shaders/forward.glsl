// The forward pass of the real-time frame.
#ifndef CANDELA_FORWARD_GLSL
#define CANDELA_FORWARD_GLSL

#ifndef CANDELA_WITHOUT_SHADOWS
#define CANDELA_SHADOWS_BY_LOOKUP
#endif

#include "frame.glsl"
#include "material.glsl"
#include "shade.glsl"

Lit light_surface(GBuffer g, vec3 position, vec3 v, uvec2 pixel) {
    vec3 facet = g.surface_normal;
    if (kShadowKinds != 0u) {
        vec3 across = cross(dFdx(position), dFdy(position));
        float area2 = dot(across, across);
        if (area2 > 0.0) facet = across * ((dot(across, v) < 0.0 ? -1.0 : 1.0) * inversesqrt(area2));
    }
    return shade(g, position, v, kHasLights ? lights_of_cell(vec2(pixel), position) : 0u, vec4(facet, 0.0), ivec2(pixel));
}

#include "blended_surface.glsl"

#endif
