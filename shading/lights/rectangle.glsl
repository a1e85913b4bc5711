// One-sided rectangles as area lights: illuminance per luminance, that is the projected solid angle in sr. right and up are
// unit and perpendicular; the light shines along -(right cross up), as a node of glTF does along -Z.
#ifndef CANDELA_LIGHTS_RECTANGLE_GLSL
#define CANDELA_LIGHTS_RECTANGLE_GLSL

#include "contour.glsl"

CANDELA_SHADING_BEGIN

// A convex quadrilateral that turns counterclockwise as the receiver sees it, clipped at the receiver's horizon: exact.
FN float quad_projected_solid_angle(vec3 n, vec3 p0, vec3 p1, vec3 p2, vec3 p3) {
    vec3 leaves = vec3(0.0f);
    vec3 returns = vec3(0.0f);
    float h0 = dot(n, p0);
    float h1 = dot(n, p1);
    float h2 = dot(n, p2);
    float h3 = dot(n, p3);
    float sum = contour_edge_above(n, p0, p1, h0, h1, leaves, returns);
    sum += contour_edge_above(n, p1, p2, h1, h2, leaves, returns);
    sum += contour_edge_above(n, p2, p3, h2, h3, leaves, returns);
    sum += contour_edge_above(n, p3, p0, h3, h0, leaves, returns);
    return sum + contour_edge(n, leaves, returns);
}

// Exact, by the outline's integral after clipping at the horizon. Under 1/300 of the distance the outline's edges
// cancel to four digits and fewer, and the light is as good as a point.
FN float rectangle_projected_solid_angle(vec3 n, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                                         float half_height_m) {
    float height_m = dot(cross(right, up), to_center_m);  // of the receiver over the light's plane
    if (!(height_m > 0.0f)) return 0.0f;
    float distance2 = dot(to_center_m, to_center_m);
    if (square(half_width_m) + square(half_height_m) < 1.0e-5f * distance2)
        return 4.0f * half_width_m * half_height_m * height_m * max(dot(n, to_center_m), 0.0f) / square(distance2);
    vec3 x = right * half_width_m;
    vec3 y = up * half_height_m;
    float clipped = quad_projected_solid_angle(n, to_center_m - x - y, to_center_m + x - y, to_center_m + x + y,
                                               to_center_m - x + y);
    return max(clipped, 0.0f);
}

CANDELA_SHADING_END

#endif
