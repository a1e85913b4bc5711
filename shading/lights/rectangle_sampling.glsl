// A rectangle as seen from a point: directions drawn uniformly in the solid angle that it fills.
#ifndef CANDELA_LIGHTS_RECTANGLE_SAMPLING_GLSL
#define CANDELA_LIGHTS_RECTANGLE_SAMPLING_GLSL

#include "sampling.glsl"
#include "triangle.glsl"

CANDELA_SHADING_BEGIN

// Under this a rectangle is flat enough for a point drawn on its area, and single precision too coarse for its sides.
CONSTANT float kLeastSphericalRectangle_sr = 1.0e-3f;

// The rectangle from x0 to x1 and y0 to y1 in a plane at `height` from the point.
struct SeenRectangle {
    float x0;
    float x1;
    float y0;
    float y1;
    float height;       // <= 0: dark
    float solid_angle;  // sr
};

FN SeenRectangle see_rectangle(vec3 to_center_m, vec3 right, vec3 up, float half_width_m, float half_height_m) {
    SeenRectangle r;
    float x = dot(to_center_m, right);
    float y = dot(to_center_m, up);
    r.x0 = x - half_width_m;
    r.x1 = x + half_width_m;
    r.y0 = y - half_height_m;
    r.y1 = y + half_height_m;
    r.height = -dot(to_center_m, cross(up, right));
    r.solid_angle = 0.0f;
    if (!(r.height > 0.0f)) return r;
    r.solid_angle = parallelogram_solid_angle(4.0f * half_width_m * half_height_m * r.height,
                                              vec3(r.x0, r.y0, r.height), vec3(r.x1, r.y0, r.height),
                                              vec3(r.x1, r.y1, r.height), vec3(r.x0, r.y1, r.height));
    return r;
}

// Density in 1/sr of a direction; cos_plane: its cosine to the rectangle's normal.
FN float seen_rectangle_pdf(SeenRectangle r, float cos_plane) {
    if (!(r.solid_angle > 0.0f)) return 0.0f;
    if (r.solid_angle > kLeastSphericalRectangle_sr) return 1.0f / r.solid_angle;
    return square(r.height) / ((r.x1 - r.x0) * (r.y1 - r.y0) * max(cos_plane * cos_plane * cos_plane, 1.0e-30f));
}

FN float pdf_rectangle(vec3 direction, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                       float half_height_m) {
    return seen_rectangle_pdf(see_rectangle(to_center_m, right, up, half_width_m, half_height_m),
                              abs(dot(direction, cross(up, right))));
}

// asin of the product of the slopes (x over its distance, y over its) by a quotient that does not cancel: the solid angle of
// the corner rectangle from 0 to x and 0 to y, signed.
FN float corner_solid_angle(float x, float y, float height) {
    return atan(x * y, height * sqrt(square(height) + x * x + y * y));
}

// The point (x, y) such that a share u.x of the solid angle lies at smaller x, and of the slice at that x a share u.y at
// smaller y: Urena et al. 2013 ("An Area-Preserving Parametrization for Spherical Rectangles"), section 4, with the area
// measured from x = 0, which leaves two angles in place of four, and with the tangent of the slice's plane in place of its
// cosine, which has no digits left on a wide rectangle nearby.
FN vec2 sample_seen_rectangle(SeenRectangle r, vec2 u) {
    float h2 = square(r.height);
    float area0 = corner_solid_angle(r.x0, r.y1, r.height) - corner_solid_angle(r.x0, r.y0, r.height);
    float area1 = corner_solid_angle(r.x1, r.y1, r.height) - corner_solid_angle(r.x1, r.y0, r.height);
    // Of the rectangle from 0 to x: asin(s slope1) - asin(s slope0), of which s, the slope of x, is wanted.
    float area = mix(area0, area1, u.x);
    float slope0 = r.y0 * inversesqrt(h2 + r.y0 * r.y0);
    float slope1 = r.y1 * inversesqrt(h2 + r.y1 * r.y1);
    float inverse_s = (slope1 * cos(area) - slope0) / max(abs(sin(area)), 1.0e-20f);
    float cotangent2 = square(inverse_s) - h2 / (h2 + r.y1 * r.y1);
    float x = r.height * inversesqrt(max(cotangent2, 1.0e-12f)) * (area < 0.0f ? -1.0f : 1.0f);
    x = clamp(x, r.x0, r.x1);
    float to_axis2 = x * x + h2;
    float sine = mix(r.y0 * inversesqrt(to_axis2 + r.y0 * r.y0), r.y1 * inversesqrt(to_axis2 + r.y1 * r.y1), u.y);
    float y = sine * sqrt(to_axis2 / max(1.0f - sine * sine, 1.0e-12f));
    return vec2(x, clamp(y, r.y0, r.y1));
}

// right, up: unit; shines along cross(up, right), one-sided.
FN LightDirection sample_rectangle(vec2 u, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                                   float half_height_m) {
    LightDirection s = no_light_direction();
    SeenRectangle r = see_rectangle(to_center_m, right, up, half_width_m, half_height_m);
    if (!(r.solid_angle > 0.0f)) return s;
    vec2 at = vec2(mix(r.x0, r.x1, u.x), mix(r.y0, r.y1, u.y));
    if (r.solid_angle > kLeastSphericalRectangle_sr) at = sample_seen_rectangle(r, u);
    s.distance_m = sqrt(at.x * at.x + at.y * at.y + square(r.height));
    s.direction = (at.x * right + at.y * up - r.height * cross(up, right)) / s.distance_m;
    s.pdf = seen_rectangle_pdf(r, r.height / s.distance_m);
    return s;
}

CANDELA_SHADING_END

#endif
