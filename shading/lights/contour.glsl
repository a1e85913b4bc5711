// The projected solid angle of a shape as an integral along its outline, in sr: half of the sum over the outline's pieces
// of n . (x cross dx) / |x|^2, x relative to the receiver, n its normal. Lambert 1760; Arvo 1994, "The Irradiance Jacobian
// for Partially Occluded Polyhedral Sources", section 3. The pieces here are straight edges; disk.glsl and tube.glsl
// add arcs. Where a shape is cut by the receiver's horizon, the piece along the horizon closes the outline.
#ifndef CANDELA_LIGHTS_CONTOUR_GLSL
#define CANDELA_LIGHTS_CONTOUR_GLSL

#include "../language.glsl"

CANDELA_SHADING_BEGIN

// angle / sin(angle) of an angle within [0, pi/2] from its cosine, to 4e-7 relative: own minimax polynomial. One source of
// angles for both languages, cheaper than an arc tangent, and exact in the limit of small angles, where the quotient of
// two small numbers would not be.
FN float angle_over_sine(float cosine) {
    float p = -0.0270812948f * cosine + 0.137527847f;
    p = p * cosine - 0.326136611f;
    p = p * cosine + 0.510588862f;
    p = p * cosine - 0.649177875f;
    p = p * cosine + 0.783392752f;
    p = p * cosine - 0.999909759f;
    return p * cosine + 1.57079565f;
}

// Angle in rad, in [0, pi], of a vector with these components; y >= 0. 0 for the null vector.
FN float half_turn_angle(float y, float x) {
    float inverse_length = inversesqrt(max(x * x + y * y, 1.0e-37f));
    float sine = y * inverse_length;
    float acute = angle_over_sine(min(abs(x) * inverse_length, 1.0f)) * sine;
    return x >= 0.0f ? acute : PI - acute;
}

// Angle in rad, in [0, 2 pi), from (1, 0) to (x, y), counterclockwise.
FN float full_turn_angle(float y, float x) {
    float angle = half_turn_angle(abs(y), x);
    return y >= 0.0f ? angle : TWO_PI - angle;
}

// v / |v|; the null vector stays.
FN vec3 direction_of(vec3 v) {
    return v * inversesqrt(max(dot(v, v), 1.0e-37f));
}

// The edge from a to b; 0 when one of them is the null vector.
FN float contour_edge(vec3 n, vec3 a, vec3 b) {
    vec3 normal = cross(a, b - a);  // the difference keeps the digits of a distant edge
    float sine2 = dot(normal, normal);
    float cosine = dot(a, b);
    float inverse_lengths = inversesqrt(max(sine2 + cosine * cosine, 1.0e-37f));
    float acute = angle_over_sine(min(abs(cosine) * inverse_lengths, 1.0f)) * inverse_lengths;
    float angle_over_cross = cosine >= 0.0f ? acute : PI * inversesqrt(max(sine2, 1.0e-37f)) - acute;
    return 0.5f * dot(n, normal) * angle_over_cross;
}

// Where the edge from a to b passes the horizon; height: n . a and n . b, of different signs.
FN vec3 horizon_crossing(vec3 a, vec3 b, float height_a, float height_b) {
    return a + (b - a) * (height_a / (height_a - height_b));
}

// The edge along the horizon that closes a clipped outline. Its ends may lie at very different distances; the difference
// has the digits of the nearer one when the cross product is taken there.
FN float contour_edge_on_horizon(vec3 n, vec3 leaves, vec3 returns) {
    bool swap = dot(leaves, leaves) > dot(returns, returns);
    float edge = contour_edge(n, swap ? returns : leaves, swap ? leaves : returns);
    return swap ? -edge : edge;
}

// What of the edge from a to b lies above the horizon; height_a, height_b: n . a and n . b. Where the edge goes below,
// `leaves` is that point, where it comes back above, `returns`: both stay as they are otherwise.
FN float contour_edge_above(vec3 n, vec3 a, vec3 b, float height_a, float height_b, INOUT(vec3) leaves,
                            INOUT(vec3) returns) {
    bool a_above = height_a >= 0.0f;
    bool b_above = height_b >= 0.0f;
    if (!a_above && !b_above) return 0.0f;
    if (a_above && b_above) return contour_edge(n, a, b);
    vec3 crossing = horizon_crossing(a, b, height_a, height_b);
    leaves = a_above ? crossing : leaves;
    returns = a_above ? returns : crossing;
    return contour_edge(n, a_above ? a : crossing, a_above ? crossing : b);
}

CANDELA_SHADING_END

#endif
