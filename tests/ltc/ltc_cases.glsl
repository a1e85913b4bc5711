// Linearly transformed cosines and representative points over random input, once for both languages.
#ifndef CANDELA_LTC_CASES_GLSL
#define CANDELA_LTC_CASES_GLSL

#include "../../shading/lights/ltc.glsl"
#include "../../shading/lights/representative_point.glsl"
#include "../shading/agreement_case.glsl"

CANDELA_SHADING_BEGIN

FN vec3 case_view(vec3 n, float a, float b) {
    vec3 t;
    vec3 u;
    orthonormal_basis(n, t, u);
    float NoV = between(0.05f, 0.999f, a);
    return normalize(NoV * n + sqrt(1.0f - NoV * NoV) * (cos(TWO_PI * b) * t + sin(TWO_PI * b) * u));
}
// Matrices as the fit has them, from rough to smooth.
FN mat3 case_matrix(float NoV, float a, float b) {
    float alpha = exp2(between(-5.0f, 0.0f, a));
    return ltc_inverse_matrix(vec4(max(NoV, 0.1f), alpha * b, 2.0f * alpha / (1.0f + alpha), 0.3f * alpha * b));
}
FN vec3 case_center(vec3 n, float a, float b, float c) {
    return n * between(0.7f, 1.5f, a) + vec3(b - 0.5f, c - 0.5f, a - 0.5f);
}

FN vec4 case_ltc_matrix(NUMBERS) {
    vec3 n = case_sphere_direction(u[0], u[1]);
    vec3 v = case_view(n, u[2], u[3]);
    LtcFrame frame = ltc_frame(case_matrix(dot(n, v), u[4], u[5]), n, v);
    return vec4(frame.to_cosine * case_sphere_direction(u[6], u[7]), frame.scale);
}
FN vec4 case_ltc_density(NUMBERS) {
    vec3 n = case_sphere_direction(u[0], u[1]);
    vec3 v = case_view(n, u[2], u[3]);
    float density = ltc_density(case_matrix(dot(n, v), 0.5f + 0.5f * u[4], u[5]), n, v, normalize(n + 0.8f * case_sphere_direction(u[6], u[7])));
    return vec4(log2(1.0e-3f + density), ltc_uv(u[8], u[9]).x, ltc_uv(u[8], u[9]).y, 1.0f);
}
FN vec4 case_ltc_flat(NUMBERS) {
    vec3 n = case_sphere_direction(u[0], u[1]);
    vec3 v = case_view(n, u[2], u[3]);
    mat3 m = case_matrix(dot(n, v), u[4], u[5]);
    vec3 center = case_center(n, u[6], u[7], u[8]);
    vec3 shine = normalize(0.5f * case_sphere_direction(u[9], u[10]) - normalize(center));
    vec3 right;
    vec3 other;
    orthonormal_basis(shine, right, other);
    return vec4(ltc_rectangle(m, n, v, center, right, cross(-shine, right), between(0.2f, 1.0f, u[11]), between(0.2f, 1.0f, u[12])),
                ltc_disk(m, n, v, center, shine, between(0.2f, 1.0f, u[13])), 1.0f, 0.0f);
}
FN vec4 case_ltc_round(NUMBERS) {
    vec3 n = case_sphere_direction(u[0], u[1]);
    vec3 v = case_view(n, u[2], u[3]);
    mat3 m = case_matrix(dot(n, v), u[4], u[5]);
    vec3 center = case_center(n, u[6], u[7], u[8]);
    return vec4(ltc_sphere(m, n, v, center, between(0.1f, 0.5f, u[9])),
                ltc_tube(m, n, v, center, case_sphere_direction(u[10], u[11]), between(0.1f, 1.0f, u[12]), between(0.05f, 0.3f, u[13])),
                1.0f, 0.0f);
}
FN vec4 case_representative_tube(NUMBERS) {
    vec3 center = 2.0f * case_sphere_direction(u[0], u[1]);
    vec3 axis = case_sphere_direction(u[2], u[3]);
    vec3 mirror = case_sphere_direction(u[4], u[5]);
    return vec4(representative_share_of_line(center - axis, center + 0.5f * axis, mirror),
                representative_share_of_line_by_angle(center - axis, center + 0.5f * axis, mirror),
                representative_point_tube_normalization(u[6] + 0.01f, u[7], u[8], 1.0f + u[9]),
                representative_point_rectangle_normalization(u[6] + 0.01f, u[7], u[8], 1.0f + u[9]));
}
FN vec4 case_representative_points(NUMBERS) {
    vec3 center = 2.0f * case_sphere_direction(u[0], u[1]);
    vec3 shine = normalize(0.5f * case_sphere_direction(u[2], u[3]) - 0.5f * center);
    vec3 mirror = normalize(center + case_sphere_direction(u[4], u[5]));
    vec3 right;
    vec3 other;
    orthonormal_basis(shine, right, other);
    vec3 up = cross(-shine, right);
    return vec4(representative_point_disk(center, shine, u[6] + 0.1f, mirror) +
                    representative_point_rectangle(center, right, up, u[7] + 0.1f, u[8] + 0.1f, mirror) +
                    representative_point_tube(center, right, u[9], 0.2f * u[10] + 0.05f, mirror),
                specular_at_point(normalize(center), normalize(center + right), center + 0.5f * up, 0.2f + u[11], 0.2f + u[11]));
}
FN vec4 case_sun(NUMBERS) {
    vec3 sun = case_sphere_direction(u[0], u[1]);
    vec3 mirror = normalize(sun + 0.02f * case_sphere_direction(u[2], u[3]));
    return vec4(representative_direction_of_sun(sun, mirror, 0.005f), 1.0f);
}

CANDELA_SHADING_END

// The outline's pieces cancel where little of the cosine is left; the share of a line is a quotient of differences.
#define LTC_CASES(X)                   \
    X(case_ltc_matrix, 1e-5f)          \
    X(case_ltc_density, 3e-5f)         \
    X(case_ltc_flat, 3e-5f)            \
    X(case_ltc_round, 5e-5f)           \
    X(case_representative_tube, 2e-4f) \
    X(case_representative_points, 1e-5f) \
    X(case_sun, 1e-5f)

#endif
