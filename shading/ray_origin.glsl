// Where rays that leave a surface of triangles start, so that they do not meet it again by mistake.
#ifndef CANDELA_RAY_ORIGIN_GLSL
#define CANDELA_RAY_ORIGIN_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Cosine to the triangle's plane where the facets of a coarse mesh begin to shadow themselves: rays below it start from
// the smooth surface. Everywhere else the true surface is better.
CONSTANT float kGrazingCosine = 0.1f;

// One coordinate moved by `step` units in its last place; near the origin of the world, where such units are too small,
// by a fixed step instead.
FN float offset_coordinate(float p, float n) {
    int ulps = int(256.0f * n);
    uint bits = floatBitsToUint(p) + uint(p < 0.0f ? -ulps : ulps);
    return abs(p) < 1.0f / 32.0f ? p + n / 65536.0f : uintBitsToFloat(bits);
}

// A point of a surface moved off it along the unit normal n, just far enough for a ray in single precision: Waechter &
// Binder 2019 ("A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems, chapter 6).
FN vec3 offset_from_surface(vec3 p, vec3 n) {
    return vec3(offset_coordinate(p.x, n.x), offset_coordinate(p.y, n.y), offset_coordinate(p.z, n.z));
}

// What one corner adds to smooth_surface(): corner_n is its unit normal on the side of the viewer.
FN vec3 smooth_surface_shift(vec3 p, vec3 corner, vec3 corner_n) {
    return -min(dot(p - corner, corner_n), 0.0f) * corner_n;
}

// Hanika 2021 ("Hacking the Shadow Terminator", Ray Tracing Gems II, chapter 4): the mean of a point's projections onto
// the planes at the corners a, b, c, which bulges as their normals do. weight: barycentric coordinates of p.
FN vec3 smooth_surface(vec3 p, vec3 weight, vec3 a, vec3 b, vec3 c, vec3 normal_a, vec3 normal_b, vec3 normal_c) {
    // Of a flat face nothing bulges; rounding would say otherwise.
    if (all(equal(normal_a, normal_b)) && all(equal(normal_a, normal_c))) return p;
    return p + weight.x * smooth_surface_shift(p, a, normal_a) + weight.y * smooth_surface_shift(p, b, normal_b) +
           weight.z * smooth_surface_shift(p, c, normal_c);
}

CANDELA_SHADING_END

#endif
