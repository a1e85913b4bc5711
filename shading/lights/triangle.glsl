// A triangle as seen from a point: solid angle, and directions drawn uniformly within it.
#ifndef CANDELA_LIGHTS_TRIANGLE_GLSL
#define CANDELA_LIGHTS_TRIANGLE_GLSL

#include "../language.glsl"

CANDELA_SHADING_BEGIN

// Solid angle in sr, in [-2 pi, 2 pi], of the triangle of unit directions a, b, c; positive when they turn counterclockwise
// as seen from within: Van Oosterom & Strackee 1983, equation 8.
// The volume from differences of the corners: that of the directions themselves has no digits where the triangle is small.
FN float triangle_signed_solid_angle(vec3 a, vec3 b, vec3 c) {
    float volume = dot(a, cross(b - a, c - a));
    float sum = 1.0f + dot(a, b) + dot(b, c) + dot(c, a);
    return 2.0f * atan(volume, sum);
}

// Of corners in m from the receiver, whose volume a . ((b - a) x (c - a)) in m^3 is known: with all digits at any size.
FN float triangle_solid_angle_of_volume(float volume_m3, vec3 a, vec3 b, vec3 c) {
    float inverse_a = inversesqrt(max(dot(a, a), 1.0e-37f));
    float inverse_b = inversesqrt(max(dot(b, b), 1.0e-37f));
    float inverse_c = inversesqrt(max(dot(c, c), 1.0e-37f));
    vec3 to_a = a * inverse_a;
    vec3 to_b = b * inverse_b;
    vec3 to_c = c * inverse_c;
    float sum = 1.0f + dot(to_a, to_b) + dot(to_b, to_c) + dot(to_c, to_a);
    return 2.0f * atan(volume_m3 * inverse_a * inverse_b * inverse_c, sum);
}

// A parallelogram of corners in m from the receiver, counterclockwise as it sees them. volume_m3 >= 0: its area times the receiver's
// height over its plane, which is the volume of either half.
FN float parallelogram_solid_angle(float volume_m3, vec3 p0, vec3 p1, vec3 p2, vec3 p3) {
    return triangle_solid_angle_of_volume(volume_m3, p0, p1, p2) + triangle_solid_angle_of_volume(volume_m3, p0, p2, p3);
}

// The same in [0, 2 pi], whatever the winding.
FN float triangle_solid_angle(vec3 a, vec3 b, vec3 c) {
    return abs(triangle_signed_solid_angle(a, b, c));
}

// Unit direction from `from` towards `to` that is perpendicular to unit `from`.
FN vec3 perpendicular_towards(vec3 from, vec3 to) {
    vec3 p = to - from * dot(from, to);
    return p * inversesqrt(max(dot(p, p), 1.0e-30f));
}

// Unit direction within the spherical triangle of unit directions a, b, c (not degenerate), uniform in solid angle: Arvo
// 1995 ("Stratified Sampling of Spherical Triangles"). The first number cuts off a sub-triangle of that share of the
// area by moving c along the side from a; the second moves from b towards the moved corner.
FN vec3 sample_spherical_triangle_ordered(vec3 a, vec3 b, vec3 c, vec2 u) {
    vec3 side_b = perpendicular_towards(a, b);
    vec3 side_c = perpendicular_towards(a, c);
    float cos_alpha = clamp(dot(side_b, side_c), -1.0f, 1.0f);
    float sin_alpha = sqrt(max(1.0f - cos_alpha * cos_alpha, 1.0e-12f));
    float alpha = atan(sin_alpha, cos_alpha);
    float share = u.x * triangle_solid_angle(a, b, c);
    float s = sin(share - alpha);
    float t = cos(share - alpha);
    float p = t - cos_alpha;
    float q = s + sin_alpha * dot(a, b);
    float denominator = (q * s + p * t) * sin_alpha;
    float cos_moved = ((q * t - p * s) * cos_alpha - q) / (abs(denominator) > 1.0e-20f ? denominator : 1.0e-20f);
    cos_moved = clamp(cos_moved, -1.0f, 1.0f);
    vec3 moved = cos_moved * a + sqrt(max(1.0f - cos_moved * cos_moved, 0.0f)) * side_c;
    float z = 1.0f - u.y * (1.0f - dot(moved, b));
    return normalize(z * b + sqrt(max(1.0f - z * z, 0.0f)) * perpendicular_towards(b, moved));
}

// The same for any order of the corners. In single precision thin triangles come out uniform only when the moved corner
// runs along the shortest side: an angle between two long sides has no digits.
FN vec3 sample_spherical_triangle(vec3 a, vec3 b, vec3 c, vec2 u) {
    float ab = dot(a - b, a - b);
    float bc = dot(b - c, b - c);
    float ca = dot(c - a, c - a);
    if (ab < bc && ab < ca) return sample_spherical_triangle_ordered(b, c, a, u);
    if (bc < ca) return sample_spherical_triangle_ordered(c, a, b, u);
    return sample_spherical_triangle_ordered(a, b, c, u);
}

CANDELA_SHADING_END

#endif
