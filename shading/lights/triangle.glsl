// A triangle as seen from a point: solid angle, and directions drawn uniformly within it.
#ifndef CANDELA_LIGHTS_TRIANGLE_GLSL
#define CANDELA_LIGHTS_TRIANGLE_GLSL

#include "../language.glsl"

CANDELA_SHADING_BEGIN

// Solid angle in sr, in [-2 pi, 2 pi], of the triangle of unit directions a, b, c; positive when they turn counterclockwise
// as seen from within: Van Oosterom & Strackee 1983, equation 8.
FN float triangle_signed_solid_angle(vec3 a, vec3 b, vec3 c) {
    float volume = dot(a, cross(b, c));
    float sum = 1.0f + dot(a, b) + dot(b, c) + dot(c, a);
    return 2.0f * atan(volume, sum);
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
