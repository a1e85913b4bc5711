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

// A leaf of one instance of a shared primitive says so in place of a count of triangles.
const uint kInstanceLeaf = 7u;

// The next leaf from `node` to `end_node` on whose box the ray is in before t_max, as first triangle << 3 | count, or
// instance << 3 | kInstanceLeaf, and the node after it; false: there is none. Boxes are passed in a loop of their own, so that the lanes of a SIMD device come to their
// triangles together (Aila & Laine 2009, "Understanding the Efficiency of Ray Traversal on GPUs").
bool next_leaf(vec3 origin, vec3 inverse, float t_max, uint end_node, inout uint node, out uint leaf) {
    uint nodes = ray_node_first();
    leaf = 0u;
    while (node < end_node && leaf == 0u) {
        uvec4 low = table_quads[nodes + 2u * node];
        uvec4 high = table_quads[nodes + 2u * node + 1u];
        bool met = meets_box(uintBitsToFloat(low.xyz), uintBitsToFloat(high.xyz), origin, inverse, t_max);
        if (met && (high.w & 7u) != 0u) leaf = high.w;
        node = met ? node + 1u : low.w;
    }
    return leaf != 0u;
}

// Of the triangles of one leaf: what gets through.
float leaf_transmitted(uint leaf, vec3 origin, vec3 direction, float t_max) {
    float through = 1.0;
    uint end = (leaf >> 3u) + (leaf & 7u);
    for (uint i = leaf >> 3u; i < end; ++i) {
        uint first = ray_triangle_first() + 4u * i;
        uvec4 a = table_quads[first];
        vec2 at;
        float t = meet_triangle(origin, direction, uintBitsToFloat(a.xyz), quad_vec3(first + 1u), quad_vec3(first + 2u), at);
        if (t > 0.0 && t < t_max) through *= kHasTransparency ? transparency(a.w, at) : 0.0;
    }
    return through;
}

// An instance of a shared primitive: rows of the matrices to its own space and to the world, and its tree.
struct Instance {
    uint first;      // its first quad
    uint node;       // of its tree
    uint end_node;
    float handedness;  // -1: mirrored
};
Instance instance_at(uint index) {
    uint first = ray_instance_first() + 7u * index;
    uvec4 tree = table_quads[first + 6u];
    return Instance(first, tree.x, tree.y, uintBitsToFloat(tree.z));
}
vec4 quad_vec4(uint index) { return uintBitsToFloat(table_quads[index]); }
vec3 times_rows(uint first, vec4 v) {
    return vec3(dot(quad_vec4(first), v), dot(quad_vec4(first + 1u), v), dot(quad_vec4(first + 2u), v));
}

// The direction keeps the instance's scale, so that distances along the ray are those of the world.
float instance_transmitted(uint index, vec3 origin, vec3 direction, float t_max) {
    Instance instance = instance_at(index);
    vec3 own_origin = times_rows(instance.first, vec4(origin, 1.0));
    vec3 own_direction = times_rows(instance.first, vec4(direction, 0.0));
    vec3 inverse = ray_inverse(own_direction);
    float through = 1.0;
    uint leaf;
    while (through > 0.0 && next_leaf(own_origin, inverse, t_max, instance.end_node, instance.node, leaf))
        through *= leaf_transmitted(leaf, own_origin, own_direction, t_max);
    return through;
}

// Part of the light that gets through to t_max along the unit direction: 0 behind anything opaque.
float transmitted(vec3 origin, vec3 direction, float t_max) {
    vec3 inverse = ray_inverse(direction);
    float through = 1.0;
    uint node = 0u;
    uint leaf;
    while (next_leaf(origin, inverse, t_max, ray_node_count(), node, leaf)) {
        if (kHasInstances && (leaf & 7u) == kInstanceLeaf) {
            through *= instance_transmitted(leaf >> 3u, origin, direction, t_max);
        } else {
            through *= leaf_transmitted(leaf, origin, direction, t_max);
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

// The triangle that a search has found so far.
struct Nearest {
    float off;       // from where it was looked for
    uint triangle;   // its first quad, or kNoRecord
    uint instance;   // or kNoRecord
    vec2 at;
};

void find_nearest(uint leaf, uint instance, vec3 start, vec3 direction, float reach, inout Nearest nearest) {
    uint end = (leaf >> 3u) + (leaf & 7u);
    for (uint i = leaf >> 3u; i < end; ++i) {
        uint first = ray_triangle_first() + 4u * i;
        vec2 at;
        float t = meet_triangle(start, direction, quad_vec3(first), quad_vec3(first + 1u), quad_vec3(first + 2u), at);
        if (t > 0.0 && abs(t - reach) < nearest.off) nearest = Nearest(abs(t - reach), first, instance, at);
    }
}

// A triangle in the world, with the normals at its corners.
struct SurfaceTriangle {
    vec3 a;
    vec3 b;
    vec3 c;
    vec3 normal_a;
    vec3 normal_b;
    vec3 normal_c;
    float handedness;
};

SurfaceTriangle triangle_at(Nearest found) {
    uvec4 normals = table_quads[found.triangle + 3u];
    SurfaceTriangle t = SurfaceTriangle(quad_vec3(found.triangle), quad_vec3(found.triangle + 1u),
                                        quad_vec3(found.triangle + 2u), octahedral_decode(unpackSnorm2x16(normals.x)),
                                        octahedral_decode(unpackSnorm2x16(normals.y)),
                                        octahedral_decode(unpackSnorm2x16(normals.z)), 1.0);
    if (!kHasInstances || found.instance == kNoRecord) return t;
    Instance instance = instance_at(found.instance);
    uint world = instance.first + 3u;
    t.a = times_rows(world, vec4(t.a, 1.0));
    t.b = times_rows(world, vec4(t.b, 1.0));
    t.c = times_rows(world, vec4(t.c, 1.0));
    // Normals by the transposed inverse, whose rows are the columns of the matrix to its own space.
    mat3 to_normal = mat3(quad_vec3(instance.first), quad_vec3(instance.first + 1u), quad_vec3(instance.first + 2u));
    t.normal_a = normalize(to_normal * t.normal_a);
    t.normal_b = normalize(to_normal * t.normal_b);
    t.normal_c = normalize(to_normal * t.normal_c);
    t.handedness = instance.handedness;
    return t;
}

// The triangle under a point that the rasterizer found, seen along unit v: the depth buffer's rounding and the facets
// must not decide what is in shadow.
RayOrigins ray_origins(vec3 position, vec3 v, vec3 n) {
    RayOrigins r;
    r.position = position;
    r.geometric = n;
    float reach = 1.0e-3 * distance(position, frame.camera_position.xyz) + 1.0e-6;
    vec3 start = position + reach * v;
    Nearest nearest = Nearest(reach, kNoRecord, kNoRecord, vec2(0.0));
    vec3 inverse = ray_inverse(-v);
    uint node = 0u;
    uint leaf;
    while (next_leaf(start, inverse, 2.0 * reach, ray_node_count(), node, leaf)) {
        if (kHasInstances && (leaf & 7u) == kInstanceLeaf) {
            Instance instance = instance_at(leaf >> 3u);
            vec3 own_start = times_rows(instance.first, vec4(start, 1.0));
            vec3 own_direction = times_rows(instance.first, vec4(-v, 0.0));
            vec3 own_inverse = ray_inverse(own_direction);
            uint own_leaf;
            while (next_leaf(own_start, own_inverse, 2.0 * reach, instance.end_node, instance.node, own_leaf))
                find_nearest(own_leaf, leaf >> 3u, own_start, own_direction, reach, nearest);
        } else {
            find_nearest(leaf, kNoRecord, start, -v, reach, nearest);
        }
    }
    r.flat_origin = offset_from_surface(position, n);
    r.smooth_origin = r.flat_origin;
    if (nearest.triangle == kNoRecord) return r;
    SurfaceTriangle t = triangle_at(nearest);
    vec3 weight = vec3(1.0 - nearest.at.x - nearest.at.y, nearest.at);
    r.position = weight.x * t.a + weight.y * t.b + weight.z * t.c;
    vec3 across = cross(t.b - t.a, t.c - t.a) * t.handedness;
    float facing = dot(across, v) < 0.0 ? -1.0 : 1.0;
    r.geometric = across * (facing * inversesqrt(max(dot(across, across), 1.0e-38)));
    vec3 smooth_position = smooth_surface(r.position, weight, t.a, t.b, t.c, facing * t.normal_a, facing * t.normal_b,
                                          facing * t.normal_c);
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
