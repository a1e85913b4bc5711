// The one lighting pass of the real-time frame: the profile's techniques.
#ifndef CANDELA_LIGHTING_GLSL
#define CANDELA_LIGHTING_GLSL

#include "frame.glsl"
#include "shade.glsl"

#define LIGHT_FORMAT rgba16f
const float kLightLimit = 65504.0;
const bool kNeedsPosition = kHasLights || kLocalLight != 0u;

#include "light_pixels.glsl"

const ivec2 kRightwards = ivec2(1, 0);
const ivec2 kDownwards = ivec2(0, 1);

// Way to the neighbour pixel along `step` or against it, whichever lies flatter on the shading normal's plane: that one is
// likely on the same facet.
vec3 way_along(ivec2 pixel, ivec2 step, vec3 position, vec3 n, out ivec2 neighbour) {
    ivec2 after = min(pixel + step, frame.size.xy - 1);
    ivec2 before = max(pixel - step, ivec2(0));
    vec3 forward = world_position(vec2(after) + 0.5, texelFetch(depth_image, after, 0).r) - position;
    vec3 backward = position - world_position(vec2(before) + 0.5, texelFetch(depth_image, before, 0).r);
    float forward2 = dot(forward, forward);
    float backward2 = dot(backward, backward);
    float rise = dot(n, forward);
    float fall = dot(n, backward);
    bool use_forward = rise * rise * backward2 < fall * fall * forward2;
    if (!(forward2 > 0.0 && forward2 < 1e30)) use_forward = false;
    if (!(backward2 > 0.0 && backward2 < 1e30)) use_forward = true;
    neighbour = use_forward ? after : before;
    return use_forward ? forward : backward;
}

// 1/m: how fast the shading normal turns on the way to a neighbour.
float curvature(ivec2 neighbour, vec3 way, vec3 n) {
    vec3 turned = octahedral_decode(unpackSnorm2x16(texelFetch(gbuffer_image, neighbour, 0).x));
    return distance(turned, n) * inversesqrt(max(dot(way, way), 1e-20));
}

// The facet that the pixel shows, from the depth about it: its normal, and as far as it stands for a smooth surface how
// high its neighbours may rise above it. At an edge the normal is uncertain by the angle between facet and smooth
// surface, and a neighbour as long as twice that angle times the radius of curvature. Where there is no facet, as on a
// blade of grass, the shading normal must do.
vec4 facet_at(ivec2 pixel, vec3 position, vec3 n, vec3 v) {
    ivec2 right;
    ivec2 down;
    vec3 way_right = way_along(pixel, kRightwards, position, n, right);
    vec3 way_down = way_along(pixel, kDownwards, position, n, down);
    vec3 across = cross(way_right, way_down);
    float area2 = dot(across, across);
    if (!(area2 > 0.0)) return vec4(n, 0.0);
    across *= (dot(across, v) < 0.0 ? -1.0 : 1.0) * inversesqrt(area2);
    if (dot(across, n) < 0.7) return vec4(n, 0.0);
    float lean = distance(across, n);
    if (lean < 0.01) return vec4(across, 0.0);
    float bend = max(curvature(right, way_right, n), curvature(down, way_down, n));
    return vec4(across, 3.0 * lean * lean / max(bend, 1e-3));
}

Lit light_surface(GBuffer g, vec3 position, vec3 v, uvec2 pixel) {
    vec4 facet = kShadowKinds != 0u ? facet_at(ivec2(pixel), position, g.normal, v) : vec4(g.normal, 0.0);
    return shade(g, position, v, kHasLights ? lights_of_tile(pixel / 8u) : 0u, facet, ivec2(pixel));
}

#endif
