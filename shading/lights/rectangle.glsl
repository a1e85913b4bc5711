// One-sided rectangles as area lights: illuminance per luminance, that is the projected solid angle in sr. right and up are
// unit and perpendicular; the light shines along -(right cross up), as a node of glTF does along -Z.
#ifndef CANDELA_LIGHTS_RECTANGLE_GLSL
#define CANDELA_LIGHTS_RECTANGLE_GLSL

#include "contour.glsl"
#include "disk.glsl"
#include "sphere.glsl"
#include "triangle.glsl"

CANDELA_SHADING_BEGIN

// The corners relative to the receiver, counterclockwise as it sees them.
struct RectangleCorners {
    vec3 p0;
    vec3 p1;
    vec3 p2;
    vec3 p3;
};

FN RectangleCorners rectangle_corners(vec3 to_center_m, vec3 right, vec3 up, float half_width_m, float half_height_m) {
    vec3 x = right * half_width_m;
    vec3 y = up * half_height_m;
    RectangleCorners corners;
    corners.p0 = to_center_m - x - y;
    corners.p1 = to_center_m + x - y;
    corners.p2 = to_center_m + x + y;
    corners.p3 = to_center_m - x + y;
    return corners;
}

// A convex quadrilateral that turns counterclockwise as the receiver sees it, clipped at the receiver's horizon: exact. Neighbouring
// corners may be one.
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
    return sum + contour_edge_on_horizon(n, leaves, returns);
}

// A one-sided flat light with these corners, in rectangle_corners' order about to_center_m. away: its area in m^2 along the unit
// normal that points away from where it shines; extent2: of its farthest corner from the centre, squared. Exact, by the outline's integral
// after clipping at the horizon. Under 1/300 of the distance the outline's edges cancel to four digits and fewer, and the light is
// as good as a point.
FN float polygon_projected_solid_angle(vec3 n, vec3 to_center_m, vec3 away, float extent2, vec3 p0, vec3 p1, vec3 p2,
                                       vec3 p3) {
    float height_area_m3 = dot(away, to_center_m);  // the receiver's height over the plane, times the area
    // On the light itself rounding alone says on which side of the horizon its corners are.
    if (!(height_area_m3 > 3.0e-6f * sqrt(extent2 * dot(away, away)))) return 0.0f;
    float distance2 = dot(to_center_m, to_center_m);
    if (extent2 < 1.0e-5f * distance2)
        return height_area_m3 * max(dot(n, to_center_m), 0.0f) / max(square(distance2), 1.0e-37f);
    return max(quad_projected_solid_angle(n, p0, p1, p2, p3), 0.0f);
}

FN float rectangle_projected_solid_angle(vec3 n, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                                         float half_height_m) {
    RectangleCorners c = rectangle_corners(to_center_m, right, up, half_width_m, half_height_m);
    return polygon_projected_solid_angle(n, to_center_m, 4.0f * half_width_m * half_height_m * cross(right, up),
                                         square(half_width_m) + square(half_height_m), c.p0, c.p1, c.p2, c.p3);
}

// Corners in the order of rectangle_corners; the disk of the same area stands for its size.
FN float triangle_projected_solid_angle(vec3 n, vec3 a, vec3 b, vec3 c) {
    vec3 away = 0.5f * cross(b - a, c - a);
    return polygon_projected_solid_angle(n, (a + b + c) / 3.0f, away, INV_PI * length(away), a, b, c, c);
}

// Arvo 1994 as in Frostbite listing E.1: the outline's integral without the horizon.
FN float rectangle_projected_solid_angle_arvo(vec3 n, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                                              float half_height_m) {
    if (!(dot(cross(right, up), to_center_m) > 0.0f)) return 0.0f;
    RectangleCorners c = rectangle_corners(to_center_m, right, up, half_width_m, half_height_m);
    return max(contour_edge(n, c.p0, c.p1) + contour_edge(n, c.p1, c.p2) + contour_edge(n, c.p2, c.p3) +
                   contour_edge(n, c.p3, c.p0),
               0.0f);
}

// Solid angle in sr of the whole rectangle, seen from its front: two triangles, what Frostbite listing 11 (Urena et al.
// 2013) computes from the angles of the corners.
FN float rectangle_solid_angle(vec3 to_center_m, vec3 right, vec3 up, float half_width_m, float half_height_m) {
    RectangleCorners c = rectangle_corners(to_center_m, right, up, half_width_m, half_height_m);
    float volume_m3 = 4.0f * half_width_m * half_height_m * max(dot(cross(right, up), to_center_m), 0.0f);
    return parallelogram_solid_angle(volume_m3, c.p0, c.p1, c.p2, c.p3);
}

// What of the edge from a to b lies above the horizon, as the solid angle of its triangle with the normal.
FN float solid_angle_edge_above(vec3 n, vec3 a, vec3 b, INOUT(vec3) leaves, INOUT(vec3) returns) {
    float height_a = dot(n, a);
    float height_b = dot(n, b);
    if (height_a < 0.0f && height_b < 0.0f) return 0.0f;
    if (height_a < 0.0f) {
        a = horizon_crossing(a, b, height_a, height_b);
        returns = a;
    } else if (height_b < 0.0f) {
        b = horizon_crossing(a, b, height_a, height_b);
        leaves = b;
    }
    return triangle_signed_solid_angle(n, direction_of(a), direction_of(b));
}

// Solid angle in sr of what lies above the horizon: exact, for the representative points that ask for it (the rows "(H)" of
// Frostbite Table E.1).
FN float rectangle_solid_angle_above_horizon(vec3 n, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                                             float half_height_m) {
    RectangleCorners c = rectangle_corners(to_center_m, right, up, half_width_m, half_height_m);
    if (min(min(dot(n, c.p0), dot(n, c.p1)), min(dot(n, c.p2), dot(n, c.p3))) >= 0.0f)
        return rectangle_solid_angle(to_center_m, right, up, half_width_m, half_height_m);
    vec3 leaves = vec3(0.0f);
    vec3 returns = vec3(0.0f);
    float sum = solid_angle_edge_above(n, c.p0, c.p1, leaves, returns);
    sum += solid_angle_edge_above(n, c.p1, c.p2, leaves, returns);
    sum += solid_angle_edge_above(n, c.p2, c.p3, leaves, returns);
    sum += solid_angle_edge_above(n, c.p3, c.p0, leaves, returns);
    if (dot(leaves, leaves) > 0.0f && dot(returns, returns) > 0.0f)
        sum += triangle_signed_solid_angle(n, direction_of(leaves), direction_of(returns));
    return max(sum, 0.0f);
}

// Frostbite listing 12: the solid angle of the whole times the mean of the clamped cosines at corners and centre.
FN float rectangle_projected_solid_angle_structured(vec3 n, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                                                    float half_height_m) {
    if (!(dot(cross(right, up), to_center_m) > 0.0f)) return 0.0f;
    RectangleCorners c = rectangle_corners(to_center_m, right, up, half_width_m, half_height_m);
    float cosines = saturate(dot(n, direction_of(c.p0))) + saturate(dot(n, direction_of(c.p1))) +
                    saturate(dot(n, direction_of(c.p2))) + saturate(dot(n, direction_of(c.p3))) +
                    saturate(dot(n, direction_of(to_center_m)));
    return rectangle_solid_angle(to_center_m, right, up, half_width_m, half_height_m) * 0.2f * cosines;
}

// The point of the rectangle that is nearest to a point of its plane; both relative to the receiver.
FN vec3 rectangle_nearest_point(vec3 point, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                                float half_height_m) {
    vec3 offset = point - to_center_m;
    return to_center_m + right * clamp(dot(offset, right), -half_width_m, half_width_m) +
           up * clamp(dot(offset, up), -half_height_m, half_height_m);
}

// Drobot 2014 ("Physically Based Area Lighting in Killzone Shadow Fall") as in Frostbite Appendix E: half way between the
// direction to the plane's nearest point and that in which the normal meets the plane. A normal that leads away from the
// plane meets it at infinity.
FN vec3 rectangle_representative_point_drobot(vec3 n, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                                              float half_height_m) {
    vec3 away = cross(right, up);
    vec3 towards = n - away * min(dot(n, away), 0.0f);
    vec3 halfway = away + towards * inversesqrt(max(dot(towards, towards), 1.0e-12f));
    vec3 point = halfway * (dot(away, to_center_m) / max(dot(halfway, away), 1.0e-6f));
    return rectangle_nearest_point(point, to_center_m, right, up, half_width_m, half_height_m);
}

// Frostbite listing E.2.
FN vec3 rectangle_representative_point(vec3 n, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                                       float half_height_m) {
    vec3 away = cross(right, up);
    vec3 point = plane_representative_point(n, away, dot(away, to_center_m));
    return rectangle_nearest_point(point, to_center_m, right, up, half_width_m, half_height_m);
}

// A direction for BRDFs that are evaluated once per light: Frostbite section 4.7.4.
FN vec3 rectangle_representative_direction(vec3 n, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                                           float half_height_m) {
    return direction_above_horizon(
        n, direction_of(rectangle_representative_point(n, to_center_m, right, up, half_width_m, half_height_m)));
}

// Frostbite equation 40: a point that stands for the whole rectangle. The solid angle of the whole.
FN float rectangle_projected_solid_angle_at(vec3 point, vec3 n, vec3 to_center_m, vec3 right, vec3 up,
                                            float half_width_m, float half_height_m) {
    if (!(dot(cross(right, up), to_center_m) > 0.0f)) return 0.0f;
    return saturate(dot(n, direction_of(point))) *
           rectangle_solid_angle(to_center_m, right, up, half_width_m, half_height_m);
}

// The same with the solid angle of what is above the horizon.
FN float rectangle_projected_solid_angle_at_horizon(vec3 point, vec3 n, vec3 to_center_m, vec3 right, vec3 up,
                                                    float half_width_m, float half_height_m) {
    if (!(dot(cross(right, up), to_center_m) > 0.0f)) return 0.0f;
    return saturate(dot(n, direction_of(point))) *
           rectangle_solid_angle_above_horizon(n, to_center_m, right, up, half_width_m, half_height_m);
}

FN float rectangle_projected_solid_angle_drobot(vec3 n, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                                                float half_height_m) {
    vec3 point = rectangle_representative_point_drobot(n, to_center_m, right, up, half_width_m, half_height_m);
    return rectangle_projected_solid_angle_at(point, n, to_center_m, right, up, half_width_m, half_height_m);
}

FN float rectangle_projected_solid_angle_drobot_horizon(vec3 n, vec3 to_center_m, vec3 right, vec3 up,
                                                        float half_width_m, float half_height_m) {
    vec3 point = rectangle_representative_point_drobot(n, to_center_m, right, up, half_width_m, half_height_m);
    return rectangle_projected_solid_angle_at_horizon(point, n, to_center_m, right, up, half_width_m, half_height_m);
}

FN float rectangle_projected_solid_angle_simplified(vec3 n, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                                                    float half_height_m) {
    vec3 point = rectangle_representative_point(n, to_center_m, right, up, half_width_m, half_height_m);
    return rectangle_projected_solid_angle_at(point, n, to_center_m, right, up, half_width_m, half_height_m);
}

FN float rectangle_projected_solid_angle_simplified_horizon(vec3 n, vec3 to_center_m, vec3 right, vec3 up,
                                                            float half_width_m, float half_height_m) {
    vec3 point = rectangle_representative_point(n, to_center_m, right, up, half_width_m, half_height_m);
    return rectangle_projected_solid_angle_at_horizon(point, n, to_center_m, right, up, half_width_m, half_height_m);
}

FN float rectangle_projected_solid_angle_position(vec3 n, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                                                  float half_height_m) {
    return rectangle_projected_solid_angle_at(to_center_m, n, to_center_m, right, up, half_width_m, half_height_m);
}

// Frostbite section 4.7.3: beyond five times its larger side a light is a point.
FN float rectangle_projected_solid_angle_five_times(vec3 n, vec3 to_center_m, vec3 right, vec3 up, float half_width_m,
                                                    float half_height_m) {
    float distance2 = dot(to_center_m, to_center_m);
    if (distance2 < square(10.0f * max(half_width_m, half_height_m)))
        return rectangle_projected_solid_angle(n, to_center_m, right, up, half_width_m, half_height_m);
    return 4.0f * half_width_m * half_height_m * max(dot(cross(right, up), to_center_m), 0.0f) *
           max(dot(n, to_center_m), 0.0f) / max(square(distance2), 1.0e-37f);
}

CANDELA_SHADING_END

#endif
