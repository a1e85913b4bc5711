// Rays through the scene's triangles, without ray-tracing hardware. The tree is walked in one order for all rays, past
// the boxes that a ray misses: what is in the way of light needs no nearest hit, and so no stack. C++: ray_scene.cpp.
#ifndef CANDELA_RAY_SCENE_GLSL
#define CANDELA_RAY_SCENE_GLSL

#include "ray_origin.glsl"
#include "octahedral.glsl"
#include "tables.glsl"

// Further away than anything.
const float kNoEnd = 1.0e30;

vec3 ray_inverse(vec3 direction) {
    vec3 safe = mix(direction, vec3(1.0e-20), lessThan(abs(direction), vec3(1.0e-20)));
    return 1.0 / safe;
}

// Whether the ray from `origin` is within the box somewhere in [0, t_max]. The far side is widened by the rounding of the
// three products, so that no box is missed that holds a hit.
bool meets_box(vec3 box_min, vec3 box_max, vec3 origin, vec3 inverse, float t_max) {
    vec3 a = (box_min - origin) * inverse;
    vec3 b = (box_max - origin) * inverse;
    vec3 enter = min(a, b);
    vec3 leave = max(a, b) * 1.0000004;
    return max(max(enter.x, enter.y), max(enter.z, 0.0)) <= min(min(leave.x, leave.y), min(leave.z, t_max));
}

// Distance along the ray, and where on the triangle; negative when missed: Moeller & Trumbore 1997.
float meet_triangle(vec3 origin, vec3 direction, vec3 a, vec3 b, vec3 c, out vec2 at) {
    vec3 ab = b - a;
    vec3 ac = c - a;
    vec3 p = cross(direction, ac);
    float determinant = dot(ab, p);
    at = vec2(0.0);
    if (determinant == 0.0) return -1.0;
    float scale = 1.0 / determinant;
    vec3 from_a = origin - a;
    at.x = dot(from_a, p) * scale;
    vec3 q = cross(from_a, ab);
    at.y = dot(direction, q) * scale;
    if (at.x < 0.0 || at.y < 0.0 || at.x + at.y > 1.0) return -1.0;
    return dot(ac, q) * scale;
}

// The next leaf from `node` on whose box the ray is in before t_max, as first triangle << 3 | count, and the node after
// it; false: there is none. Boxes are passed in a loop of their own, so that the lanes of a SIMD device come to their
// triangles together (Aila & Laine 2009, "Understanding the Efficiency of Ray Traversal on GPUs").
bool next_leaf(vec3 origin, vec3 inverse, float t_max, inout uint node, out uint leaf) {
    uint nodes = ray_node_first();
    uint count = ray_node_count();
    leaf = 0u;
    while (node < count && leaf == 0u) {
        uvec4 low = table_quads[nodes + 2u * node];
        uvec4 high = table_quads[nodes + 2u * node + 1u];
        bool met = meets_box(uintBitsToFloat(low.xyz), uintBitsToFloat(high.xyz), origin, inverse, t_max);
        if (met && (high.w & 7u) != 0u) leaf = high.w;
        node = met ? node + 1u : low.w;
    }
    return leaf != 0u;
}

// Part of the light that gets through to t_max along the unit direction: 0 behind anything opaque.
float transmitted(vec3 origin, vec3 direction, float t_max) {
    vec3 inverse = ray_inverse(direction);
    float through = 1.0;
    uint node = 0u;
    uint leaf;
    while (next_leaf(origin, inverse, t_max, node, leaf)) {
        uint end = (leaf >> 3u) + (leaf & 7u);
        for (uint i = leaf >> 3u; i < end; ++i) {
            uint first = ray_triangle_first() + 4u * i;
            uvec4 a = table_quads[first];
            vec2 at;
            float t = meet_triangle(origin, direction, uintBitsToFloat(a.xyz), quad_vec3(first + 1u),
                                    quad_vec3(first + 2u), at);
            if (t > 0.0 && t < t_max) through *= kHasTransparency ? transparency(a.w, at) : 0.0;
        }
        if (through <= 0.0) return 0.0;
    }
    return through;
}

// Where the rays start that leave a surface.
struct RayOrigins {
    vec3 position;   // on the triangle
    vec3 geometric;  // its unit normal on the side of the viewer
    vec3 flat_origin;
    vec3 smooth_origin;  // for those that leave close to, or below, the triangle's plane
};

// The triangle under a point that the rasterizer found, seen along unit v: the depth buffer's rounding and the facets
// must not decide what is in shadow.
RayOrigins ray_origins(vec3 position, vec3 v, vec3 n) {
    RayOrigins r;
    r.position = position;
    r.geometric = n;
    float reach = 1.0e-3 * distance(position, frame.camera_position.xyz) + 1.0e-6;
    vec3 start = position + reach * v;
    vec3 inverse = ray_inverse(-v);
    float nearest = reach;
    uint found = kNoRecord;
    vec2 found_at = vec2(0.0);
    uint node = 0u;
    uint leaf;
    while (next_leaf(start, inverse, 2.0 * reach, node, leaf)) {
        uint end = (leaf >> 3u) + (leaf & 7u);
        for (uint i = leaf >> 3u; i < end; ++i) {
            uint first = ray_triangle_first() + 4u * i;
            vec2 at;
            float t = meet_triangle(start, -v, quad_vec3(first), quad_vec3(first + 1u), quad_vec3(first + 2u), at);
            if (t > 0.0 && abs(t - reach) < nearest) {
                nearest = abs(t - reach);
                found = first;
                found_at = at;
            }
        }
    }
    r.flat_origin = offset_from_surface(position, n);
    r.smooth_origin = r.flat_origin;
    if (found == kNoRecord) return r;
    vec3 a = quad_vec3(found);
    vec3 b = quad_vec3(found + 1u);
    vec3 c = quad_vec3(found + 2u);
    vec3 weight = vec3(1.0 - found_at.x - found_at.y, found_at);
    r.position = weight.x * a + weight.y * b + weight.z * c;
    vec3 across = cross(b - a, c - a);
    float facing = dot(across, v) < 0.0 ? -1.0 : 1.0;
    r.geometric = across * (facing * inversesqrt(max(dot(across, across), 1.0e-38)));
    uvec4 normals = table_quads[found + 3u];
    vec3 smooth_position = smooth_surface(r.position, weight, a, b, c, facing * octahedral_decode(unpackSnorm2x16(normals.x)),
                                          facing * octahedral_decode(unpackSnorm2x16(normals.y)),
                                          facing * octahedral_decode(unpackSnorm2x16(normals.z)));
    r.flat_origin = offset_from_surface(r.position, r.geometric);
    r.smooth_origin = offset_from_surface(smooth_position, r.geometric);
    return r;
}

// Part of the light that reaches the surface from distance_m away along unit l; kNoEnd: from infinitely far.
float visible(RayOrigins r, vec3 l, float distance_m) {
    vec3 origin = dot(r.geometric, l) >= kGrazingCosine ? r.flat_origin : r.smooth_origin;
    if (distance_m >= kNoEnd) return transmitted(origin, l, kNoEnd);
    vec3 way = r.position + l * distance_m - origin;
    float length_m = length(way);
    return transmitted(origin, way / max(length_m, 1.0e-20), length_m * (1.0 - 1.0e-4));
}

#endif
