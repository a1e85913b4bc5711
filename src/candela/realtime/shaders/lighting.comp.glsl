#version 460
#extension GL_GOOGLE_include_directive : require
// The one lighting pass of the real-time frame: the profile's techniques.
#include "frame.glsl"
#include "shade.glsl"

#define LIGHT_FORMAT rgba16f
const float kLightLimit = 65504.0;

#include "light_pixels.glsl"

// Way to the neighbour pixel along `step` or against it, whichever lies flatter on the shading normal's plane: that one is
// likely on the same facet.
vec3 way_along(ivec2 pixel, ivec2 step, vec3 position, vec3 n) {
    ivec2 after = min(pixel + step, frame.size.xy - 1);
    ivec2 before = max(pixel - step, ivec2(0));
    vec3 forward = world_position(vec2(after) + 0.5, texelFetch(depth_image, after, 0).r) - position;
    vec3 backward = position - world_position(vec2(before) + 0.5, texelFetch(depth_image, before, 0).r);
    float forward2 = dot(forward, forward);
    float backward2 = dot(backward, backward);
    if (!(forward2 > 0.0 && forward2 < 1e30)) return backward;
    if (!(backward2 > 0.0 && backward2 < 1e30)) return forward;
    float rise = dot(n, forward);
    float fall = dot(n, backward);
    return rise * rise * backward2 < fall * fall * forward2 ? forward : backward;
}

// Normal of the facet that the pixel shows, from the depth about it. Where that is no surface, as on a blade of grass, the
// shading normal must do.
vec3 facet_normal(ivec2 pixel, vec3 position, vec3 n, vec3 v) {
    vec3 across = cross(way_along(pixel, ivec2(1, 0), position, n), way_along(pixel, ivec2(0, 1), position, n));
    float area2 = dot(across, across);
    if (!(area2 > 0.0)) return n;
    across *= (dot(across, v) < 0.0 ? -1.0 : 1.0) * inversesqrt(area2);
    return dot(across, n) > 0.7 ? across : n;
}

Lit light_surface(GBuffer g, vec3 position, vec3 v, uvec2 pixel) {
    vec3 facet = kShadowKinds != 0u ? facet_normal(ivec2(pixel), position, g.normal, v) : g.normal;
    return shade(g, position, v, facet, ivec2(pixel));
}
