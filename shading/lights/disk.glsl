// One-sided disks as area lights: illuminance per luminance, that is the projected solid angle in sr.
#ifndef CANDELA_LIGHTS_DISK_GLSL
#define CANDELA_LIGHTS_DISK_GLSL

#include "../basis.glsl"
#include "contour.glsl"
#include "sphere.glsl"

CANDELA_SHADING_BEGIN

// A disk that is seen at an angle: the cone of directions to its rim has an ellipse as cross-section. In the frame of the
// cone's axes the ellipse lies in the plane at distance 1, with half axes minor along the first axis and major along the
// second. normal: the receiver's, in that frame.
struct EllipticCone {
    vec3 normal;
    float minor;
    float major;
};

// The cone of a disk, by the eigenvectors of its quadratic form. Heitz 2017 ("Analytical Calculation of the Solid Angle
// Subtended by an Arbitrarily Positioned Ellipsoid to a Point Source") and Heitz & Hill 2017 solve the cubic of the general
// ellipse; a circle has a plane of symmetry and leaves this quadratic, in a form where nothing cancels.
// height_m > 0: of the receiver over the disk's plane.
FN EllipticCone elliptic_cone_of_disk(vec3 n, vec3 to_center_m, vec3 direction, float radius_m, float height_m) {
    float trace = dot(to_center_m, to_center_m) - square(radius_m);
    float product = square(height_m * radius_m);
    float root = sqrt(trace * trace + 4.0f * product);
    float eigenvalue = trace >= 0.0f ? 0.5f * (trace + root) : 2.0f * product / (root - trace);
    eigenvalue = max(eigenvalue, 1.0e-12f * (square(radius_m) + abs(trace)));

    vec3 axis = normalize(to_center_m - direction * (height_m * square(radius_m) / eigenvalue));
    vec3 across = cross(direction, axis);  // along the major axis
    float across2 = dot(across, across);
    vec3 first;
    vec3 second;
    orthonormal_basis(axis, first, second);
    bool seen_from_the_front = across2 < 1.0e-8f;  // the ellipse is a circle then and its axes are anywhere
    across = across * inversesqrt(max(across2, 1.0e-8f));
    across = across - axis * dot(axis, across);
    second = seen_from_the_front ? second : across;
    first = seen_from_the_front ? first : cross(across, axis);

    EllipticCone cone;
    cone.normal = vec3(dot(n, first), dot(n, second), dot(n, axis));
    cone.minor = height_m * radius_m / eigenvalue;
    cone.major = radius_m * inversesqrt(eigenvalue);
    return cone;
}

// (atan(k b) - atan(k a)) / k, also for k = 0.
FN float atan_difference(float a, float b, float k) {
    float k2 = k * k;
    float series = (b - a) * (1.0f - k2 * (a * a + a * b + b * b) / 3.0f);
    float y = k * (b - a);
    float angle = half_turn_angle(abs(y), 1.0f + k2 * a * b) * sign(y);
    return k < 0.02f ? series : angle / max(k, 0.02f);
}

// (atanh(k b) - atanh(k a)) / k, also for k = 0; k a and k b within (-1, 1).
FN float atanh_difference(float a, float b, float k) {
    float k2 = k * k;
    float series = (b - a) * (1.0f + k2 * (a * a + a * b + b * b) / 3.0f);
    float ka = k * a;
    float kb = k * b;
    float quotient = (1.0f + kb) * (1.0f - ka) / max((1.0f - kb) * (1.0f + ka), 1.0e-30f);
    return k < 0.02f ? series : 0.5f * log(quotient) / max(k, 0.02f);
}

// The part above the horizon of a cone that the horizon cuts, so small that the cosine is linear across it and directions
// are points of a plane: the integral of max(s + x, 0) over the unit disk, s in [-1, 1]. The exact form subtracts the
// chord from the arc and has no digits left here.
FN float small_cone_across_horizon(float s) {
    float c = sqrt(max(1.0f - s * s, 0.0f));
    return s * half_turn_angle(c, -s) + (2.0f + s * s) * c / 3.0f;
}

// The arc of the rim from the parameter with cosine and sine `from` counterclockwise to `to`: own integration of
// contour.glsl's form over (minor cos t, major sin t, 1).
FN float elliptic_cone_arc(EllipticCone cone, vec2 from, vec2 to) {
    float a2 = 1.0f + square(cone.minor);
    float b2 = 1.0f + square(cone.major);
    float a = sqrt(a2);
    float b = sqrt(b2);
    float q = sqrt(max(b2 - a2, 0.0f));
    float turn = full_turn_angle(a * b * (from.x * to.y - from.y * to.x), a2 * from.x * to.x + b2 * from.y * to.y);
    float along_minor = -cone.major * cone.normal.x / a2 * atan_difference(from.y, to.y, q / a);
    float along_major = cone.minor * cone.normal.y / b2 * atanh_difference(from.x, to.x, q / b);
    return 0.5f * (along_minor + along_major + cone.minor * cone.major * cone.normal.z / (a * b) * turn);
}

// Exact, with the horizon. Above it: Heitz & Hill 2017, "Real-Time Line- and Disk-Light Shading"; the cut: own derivation.
FN float elliptic_cone_projected_solid_angle(EllipticCone cone) {
    float p = length(vec2(cone.minor * cone.normal.x, cone.major * cone.normal.y));
    float area = PI * cone.minor * cone.major *
                 inversesqrt((1.0f + square(cone.minor)) * (1.0f + square(cone.major)));
    float height = cone.normal.z;
    if (abs(height) >= p) return area * max(height, 0.0f);
    float s = height / p;
    if (cone.major < 0.02f) return area * INV_PI * p * small_cone_across_horizon(s);
    vec2 middle = vec2(cone.minor * cone.normal.x, cone.major * cone.normal.y) / p;
    float c = sqrt(max(1.0f - s * s, 0.0f));
    vec2 from = vec2(-s * middle.x + c * middle.y, -s * middle.y - c * middle.x);
    vec2 to = vec2(-s * middle.x - c * middle.y, -s * middle.y + c * middle.x);
    vec3 point_from = vec3(cone.minor * from.x, cone.major * from.y, 1.0f);
    vec3 point_to = vec3(cone.minor * to.x, cone.major * to.y, 1.0f);
    return max(elliptic_cone_arc(cone, from, to) + contour_edge(cone.normal, point_to, point_from), 0.0f);
}

// Exact for every orientation and position, with the receiver's horizon and the disk's.
FN float disk_projected_solid_angle(vec3 n, vec3 to_center_m, vec3 direction, float radius_m) {
    float height_m = -dot(direction, to_center_m);
    if (!(height_m > 1.0e-6f * radius_m)) return 0.0f;
    return elliptic_cone_projected_solid_angle(elliptic_cone_of_disk(n, to_center_m, direction, radius_m, height_m));
}

// Frostbite listing 10: the disk turned to face the receiver, with the horizon, times the cosine at the light. Exact only
// for a disk that faces the receiver.
FN float disk_projected_solid_angle_frostbite(vec3 n, vec3 to_center_m, vec3 direction, float radius_m) {
    float distance2 = max(dot(to_center_m, to_center_m), 1.0e-30f);
    vec3 l = to_center_m * inversesqrt(distance2);
    float radius2 = square(radius_m);
    return cone_projected_solid_angle(dot(n, l), radius2 / (radius2 + max(radius2, distance2))) *
           saturate(-dot(direction, l));
}

// Coombe & Harris 2005 as in Frostbite listing 8: without the horizon.
FN float disk_projected_solid_angle_no_horizon(vec3 n, vec3 to_center_m, vec3 direction, float radius_m) {
    float distance2 = max(dot(to_center_m, to_center_m), 1.0e-30f);
    vec3 l = to_center_m * inversesqrt(distance2);
    return PI * saturate(-dot(direction, l)) * saturate(dot(n, l)) / (distance2 / square(radius_m) + 1.0f);
}

// Frostbite listing 14: beyond five times its diameter a light is a point.
FN float disk_projected_solid_angle_five_times(vec3 n, vec3 to_center_m, vec3 direction, float radius_m) {
    float distance2 = dot(to_center_m, to_center_m);
    if (distance2 < 100.0f * square(radius_m)) return disk_projected_solid_angle(n, to_center_m, direction, radius_m);
    return PI * square(radius_m) * max(dot(n, to_center_m), 0.0f) * max(-dot(direction, to_center_m), 0.0f) /
           square(distance2);
}

// The point of the light's plane, relative to the receiver, half way between the direction to the nearest point and the
// receiver's normal, both turned into where they see each other: Frostbite Appendix E, listing E.2 ("simplified MRP").
// away = -(the direction in which the light shines); height_m: of the receiver over the plane, > 0.
FN vec3 plane_representative_point(vec3 n, vec3 away, float height_m) {
    float clamped = 0.001f + saturate(-dot(n, away));
    vec3 halfway = normalize(away + n * clamped) + normalize(n + away * clamped);
    return halfway * (height_m / max(dot(halfway, away), 1.0e-6f));
}

// A direction for BRDFs that are evaluated once per light: Frostbite section 4.7.4, with the rectangle's point for a disk.
FN vec3 disk_representative_direction(vec3 n, vec3 to_center_m, vec3 direction, float radius_m) {
    float height_m = max(-dot(direction, to_center_m), 1.0e-6f);
    vec3 offset = plane_representative_point(n, -direction, height_m) - to_center_m;
    vec3 point = to_center_m + offset * min(1.0f, radius_m / max(length(offset), 1.0e-15f));
    return direction_above_horizon(n, direction_of(point));
}

CANDELA_SHADING_END

#endif
