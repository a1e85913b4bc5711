#version 460
#extension GL_GOOGLE_include_directive : require
// The one lighting pass of the real-time frame: the profile's techniques.
#include "frame.glsl"
#include "shade.glsl"

#define LIGHT_FORMAT rgba16f
const float kLightLimit = 65504.0;

#include "light_pixels.glsl"

// Way to the neighbour pixel along `step` or against it, whichever is nearer in depth: it is likely on the same facet.
vec3 way_along(ivec2 pixel, ivec2 step, vec3 position, float depth) {
    ivec2 last = frame.size.xy - 1;
    ivec2 after = min(pixel + step, last);
    ivec2 before = max(pixel - step, ivec2(0));
    float depth_after = after == pixel ? -1.0 : texelFetch(depth_image, after, 0).r;
    float depth_before = before == pixel ? -1.0 : texelFetch(depth_image, before, 0).r;
    if (abs(depth_after - depth) < abs(depth_before - depth)) {
        return world_position(vec2(after) + 0.5, depth_after) - position;
    }
    return position - world_position(vec2(before) + 0.5, depth_before);
}

// Normal of the facet that the pixel shows, from the depth about it. Where that is no surface, as on a blade of grass, the
// shading normal must do.
vec3 facet_normal(ivec2 pixel, vec3 position, vec3 n, vec3 v) {
    float depth = texelFetch(depth_image, pixel, 0).r;
    vec3 across = cross(way_along(pixel, ivec2(1, 0), position, depth), way_along(pixel, ivec2(0, 1), position, depth));
    float area2 = dot(across, across);
    if (!(area2 > 0.0)) return n;
    across *= (dot(across, v) < 0.0 ? -1.0 : 1.0) * inversesqrt(area2);
    return dot(across, n) > 0.5 ? across : n;
}

Lit light_surface(GBuffer g, vec3 position, vec3 v, uvec2 pixel) {
    vec3 facet = kShadowKinds != 0u ? facet_normal(ivec2(pixel), position, g.normal, v) : g.normal;
    return shade(g, position, v, facet, ivec2(pixel));
}
