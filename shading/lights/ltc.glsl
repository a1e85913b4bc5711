// Specular area lights by linearly transformed cosines: Heitz, Dupuy, Hill & Neubelt 2016, "Real-Time Polygonal-Light Shading
// with Linearly Transformed Cosines"; Heitz & Hill 2017, "Real-Time Line- and Disk-Light Shading". The lobe D V cos of
// height-correlated GGX, divided by its directional albedo, is close to a cosine lobe whose directions a matrix has moved;
// the integral over a light is that of a plain cosine over the light seen through the inverse matrix.
//
// Each ltc_<shape> returns that integral, in [0,1]. Times the light's luminance in cd/m^2, times f0 x + f90 y of the table in
// dfg.glsl (the same coordinates), it is the reflected luminance.
//
// Changed from the papers: the matrix is kept in the frame of the mirror direction, whose turn with the view is exact and not
// interpolated, so that a smooth surface mirrors the light where it is; its third row is along the surface's normal, so
// that the transform keeps the horizon: what is below the surface is cut off by the clipping that the cosine needs anyway, and
// lights nothing. Clipping is exact for all shapes, not the proxy sphere's.
#ifndef CANDELA_LIGHTS_LTC_GLSL
#define CANDELA_LIGHTS_LTC_GLSL

#include "../basis.glsl"
#include "../dfg.glsl"
#include "elliptic_cone.glsl"
#include "rectangle.glsl"

CANDELA_SHADING_BEGIN

// Texels a side of the table; the grid of dfg.glsl's.
CONSTANT int kLtcSize = kDfgSize;

// The plain cosine's normal.
CONSTANT vec3 kCosineNormal = vec3(0.0f, 0.0f, 1.0f);

// Texture coordinates: those of the table of albedos, so that one pair serves both.
FN vec2 ltc_uv(float NoV, float perceptual_roughness) {
    return dfg_uv(NoV, perceptual_roughness);
}

// The inverse matrix of a texel, up to a factor, for ltc_world_to_cosine: rows for the direction across the mirror direction in
// the plane of incidence, across both, and the normal. x: width in the plane of incidence over that across it; y: shift of the
// lobe from the mirror direction, over the sine of the view's angle, of which it is an odd function; z: width. For a smooth
// surface (NoV, 0, 2 alpha), with which the lobe is D_GGX's own to first order.
FN mat3 ltc_inverse_matrix(vec4 table_texel) {
    return mat3(vec3(table_texel.x, 0.0f, 0.0f), vec3(0.0f, 1.0f, 0.0f),
                vec3(table_texel.y, 0.0f, table_texel.z));
}

// From world directions to those of the plain cosine, whose z is the normal's height times a factor. n and v: unit; v at
// or above the horizon.
FN mat3 ltc_world_to_cosine(mat3 inverse_matrix, vec3 n, vec3 v) {
    float NoV = dot(n, v);
    vec3 away = n * NoV - v;  // where the mirror direction leans
    float sine = length(away);
    vec3 any;
    vec3 other;
    orthonormal_basis(n, any, other);
    vec3 t = sine > 1.0e-6f ? away / sine : any;
    vec3 mirror = sine * t + NoV * n;
    vec3 row0 = inverse_matrix[0].x * (NoV * t - sine * n) + (inverse_matrix[2].x * sine) * mirror;
    vec3 row2 = inverse_matrix[2].z * n;
    return transpose(mat3(row0, cross(n, t), row2));
}

// Rectangle of uniform luminance that shines to where right x up points away from. Heitz et al. 2016, section 4.
FN float ltc_rectangle(mat3 inverse_matrix, vec3 n, vec3 v, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                       float half_height_m) {
    mat3 to_cosine = ltc_world_to_cosine(inverse_matrix, n, v);
    vec3 center = to_cosine * to_center_m;
    vec3 x = to_cosine * (right * half_width_m);
    vec3 y = to_cosine * (up * half_height_m);
    float sr = quad_projected_solid_angle(kCosineNormal, center - x - y, center + x - y, center + x + y, center - x + y);
    return saturate(sr * INV_PI);
}

// One-sided disk, `direction` (unit) being the way it shines. Heitz & Hill 2017, section 4; here with the exact horizon.
FN float ltc_disk(mat3 inverse_matrix, vec3 n, vec3 v, vec3 to_center_m, vec3 direction, float radius_m) {
    vec3 t;
    vec3 b;
    orthonormal_basis(direction, t, b);
    mat3 to_cosine = ltc_world_to_cosine(inverse_matrix, n, v);
    OrientedCone o = oriented_cone(kCosineNormal, to_cosine * to_center_m, to_cosine * (t * radius_m),
                                   to_cosine * (b * radius_m));
    float facing = dot(direction, to_center_m) < 0.0f ? 1.0f : 0.0f;
    return facing * saturate(elliptic_cone_projected_solid_angle(o.cone) * INV_PI);
}

// The cone of directions in which a sphere is seen, through a matrix. At its surface, or within, half of all directions; one
// part in a thousand less, for a cone's sake.
FN OrientedCone ltc_sphere_cone(mat3 to_cosine, vec3 to_center_m, float radius_m) {
    float distance_m = max(length(to_center_m), 1.0e-20f);
    vec3 axis = to_center_m / distance_m;
    float sine = min(radius_m / distance_m, 0.9999995f);
    float cosine = sqrt((1.0f - sine) * (1.0f + sine));
    vec3 t;
    vec3 b;
    orthonormal_basis(axis, t, b);
    return oriented_cone(kCosineNormal, to_cosine * (axis * cosine), to_cosine * (t * sine), to_cosine * (b * sine));
}

// Sphere: the disk that fills the same directions. Heitz & Hill 2017, section 4.
FN float ltc_sphere(mat3 inverse_matrix, vec3 n, vec3 v, vec3 to_center_m, float radius_m) {
    OrientedCone o = ltc_sphere_cone(ltc_world_to_cosine(inverse_matrix, n, v), to_center_m, radius_m);
    return saturate(elliptic_cone_projected_solid_angle(o.cone) * INV_PI);
}

// Capsule: a cylinder of length 2 half_length_m about the unit axis, between two half spheres. tube.glsl's outline (an arc of
// either end's cone and the two planes through the receiver that touch both spheres) through the matrix.
FN float ltc_tube(mat3 inverse_matrix, vec3 n, vec3 v, vec3 to_center_m, vec3 axis, float half_length_m, float radius_m) {
    mat3 to_cosine = ltc_world_to_cosine(inverse_matrix, n, v);
    float along_m = dot(to_center_m, axis);
    vec3 across = to_center_m - along_m * axis;
    float distance_m = length(across);
    // From within the lengthened cylinder the nearest sphere hides the rest.
    if (distance_m <= 1.0001f * radius_m || distance_m <= 0.0f) {
        vec3 nearest = to_center_m + clamp(-along_m, -half_length_m, half_length_m) * axis;
        OrientedCone o = ltc_sphere_cone(to_cosine, nearest, radius_m);
        return saturate(elliptic_cone_projected_solid_angle(o.cone) * INV_PI);
    }
    vec3 w = across / distance_m;
    vec3 side = cross(w, axis);
    float cosine = radius_m / distance_m;
    float sine = sqrt((1.0f - cosine) * (1.0f + cosine));
    vec3 end1 = to_center_m - half_length_m * axis;
    vec3 end2 = to_center_m + half_length_m * axis;
    vec3 to_touch = (-radius_m * cosine) * w;
    vec3 to_side = (radius_m * sine) * side;
    vec3 plus1 = to_cosine * (end1 + to_touch + to_side);
    vec3 minus1 = to_cosine * (end1 + to_touch - to_side);
    vec3 plus2 = to_cosine * (end2 + to_touch + to_side);
    vec3 minus2 = to_cosine * (end2 + to_touch - to_side);
    OrientedCone cone1 = ltc_sphere_cone(to_cosine, end1, radius_m);
    OrientedCone cone2 = ltc_sphere_cone(to_cosine, end2, radius_m);
    vec3 leaves = vec3(0.0f);
    vec3 returns = vec3(0.0f);
    float sr = oriented_cone_arc_above(cone2, minus2, plus2, minus2.z, plus2.z, leaves, returns);
    sr += contour_edge_above(kCosineNormal, plus2, plus1, plus2.z, plus1.z, leaves, returns);
    sr += oriented_cone_arc_above(cone1, plus1, minus1, plus1.z, minus1.z, leaves, returns);
    sr += contour_edge_above(kCosineNormal, minus1, minus2, minus1.z, minus2.z, leaves, returns);
    return saturate((sr + contour_edge(kCosineNormal, leaves, returns)) * INV_PI);
}

CANDELA_SHADING_END

#endif
