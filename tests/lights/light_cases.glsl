// Illuminance of area lights over random input, once for both languages.
#ifndef CANDELA_LIGHT_CASES_GLSL
#define CANDELA_LIGHT_CASES_GLSL

#include "../../shading/lights/isotropic_line.glsl"
#include "../../shading/lights/tube.glsl"
#include "../../shading/lights/units.glsl"
#include "../shading/agreement_case.glsl"

CANDELA_SHADING_BEGIN

FN vec3 case_direction(float a, float b) {
    return case_direction_of(between(-1.0f, 1.0f, with_edges(a)), b);
}
FN vec3 case_center(float a, float b, float c) {
    return case_direction(a, b) * between(0.6f, 3.0f, c);
}
FN vec3 case_up(vec3 right, float a) {
    vec3 x;
    vec3 y;
    orthonormal_basis(right, x, y);
    return cos(TWO_PI * a) * x + sin(TWO_PI * a) * y;
}

// A constant among the results makes the tolerance one in sr, not in parts of slivers of light.
FN vec4 case_sphere_light(NUMBERS) {
    vec3 n = case_direction(u[0], u[1]);
    vec3 c = case_center(u[2], u[3], u[4]);
    float radius = between(0.001f, 1.0f, u[5]);
    return vec4(sphere_projected_solid_angle(n, c, radius), sphere_projected_solid_angle_no_horizon(n, c, radius),
                sphere_projected_solid_angle_five_times(n, c, radius), 1.0f);
}
FN vec4 case_disk_light(NUMBERS) {
    vec3 n = case_direction(u[0], u[1]);
    vec3 c = case_center(u[2], u[3], u[4]);
    vec3 direction = case_direction(u[5], u[6]);
    float radius = between(0.001f, 1.0f, u[7]);
    return vec4(disk_projected_solid_angle(n, c, direction, radius),
                disk_projected_solid_angle_frostbite(n, c, direction, radius),
                disk_projected_solid_angle_no_horizon(n, c, direction, radius), 1.0f);
}
FN vec4 case_rectangle_light(NUMBERS) {
    vec3 n = case_direction(u[0], u[1]);
    vec3 c = case_center(u[2], u[3], u[4]);
    vec3 right = case_direction(u[5], u[6]);
    vec3 up = case_up(right, u[7]);
    float w = between(0.01f, 1.0f, u[8]);
    float h = between(0.01f, 1.0f, u[9]);
    return vec4(rectangle_projected_solid_angle(n, c, right, up, w, h),
                rectangle_projected_solid_angle_arvo(n, c, right, up, w, h),
                rectangle_projected_solid_angle_structured(n, c, right, up, w, h), 1.0f);
}
FN vec4 case_rectangle_points(NUMBERS) {
    vec3 n = case_direction(u[0], u[1]);
    vec3 c = case_center(u[2], u[3], u[4]);
    vec3 right = case_direction(u[5], u[6]);
    vec3 up = case_up(right, u[7]);
    float w = between(0.01f, 1.0f, u[8]);
    float h = between(0.01f, 1.0f, u[9]);
    return vec4(rectangle_projected_solid_angle_drobot(n, c, right, up, w, h),
                rectangle_projected_solid_angle_simplified_horizon(n, c, right, up, w, h),
                rectangle_projected_solid_angle_position(n, c, right, up, w, h), 1.0f);
}
FN vec4 case_tube_light(NUMBERS) {
    vec3 n = case_direction(u[0], u[1]);
    vec3 c = case_center(u[2], u[3], u[4]);
    vec3 axis = case_direction(u[5], u[6]);
    float half_length = between(0.0f, 1.0f, with_edges(u[7]));
    float radius = exp2(between(-12.0f, -1.0f, u[8]));
    return vec4(tube_projected_solid_angle(n, c, axis, half_length, radius),
                tube_projected_solid_angle_frostbite(n, c, axis, half_length, radius),
                tube_projected_solid_angle_five_times(n, c, axis, half_length, radius), 1.0f);
}
FN vec4 case_line_light(NUMBERS) {
    vec3 n = case_direction(u[0], u[1]);
    vec3 c = case_center(u[2], u[3], u[4]);
    return vec4(line_illuminance(n, c, case_direction(u[5], u[6]), u[7]), line_cd_from_lm(10.0f * u[8]),
                1.0e4f * sun_solid_angle(between(0.009f, 0.01f, u[9])), 1.0f);
}
FN vec4 case_isotropic_line(NUMBERS) {
    vec3 n = case_direction(u[0], u[1]);
    vec3 start = case_center(u[2], u[3], u[4]);
    vec3 end = case_center(u[5], u[6], u[7]);
    return vec4(isotropic_line_attenuation(n, start, end, 1.0e-2f),
                isotropic_line_attenuation_printed(n, start, end, 1.0e-2f),
                lamp_tube_projected_solid_angle(n, start, case_direction(u[5], u[6]), u[8], 0.1f * u[9]), 1.0f);
}
FN vec4 case_light_direction(NUMBERS) {
    vec3 n = case_direction(u[0], u[1]);
    vec3 c = case_center(u[2], u[3], u[4]);
    vec3 a = case_direction(u[5], u[6]);
    vec3 b = case_up(a, u[7]);
    vec3 l = u[10] < 0.25f   ? sphere_representative_direction(n, c, u[8])
             : u[10] < 0.5f  ? disk_representative_direction(n, c, -normalize(c + a * 0.5f), u[8])
             : u[10] < 0.75f ? rectangle_representative_direction(n, c, a, b, u[8], u[9])
                             : tube_representative_direction(n, c, a, u[8], 0.3f * u[9]);
    return vec4(l, 1.0f);
}

CANDELA_SHADING_END

#define LIGHT_CASES(X)               \
    X(case_sphere_light, 2e-5f)      \
    X(case_disk_light, 2e-5f)        \
    X(case_rectangle_light, 5e-5f)   \
    X(case_rectangle_points, 5e-5f)  \
    X(case_tube_light, 5e-5f)        \
    X(case_line_light, 2e-5f)        \
    X(case_isotropic_line, 1e-4f)    \
    X(case_light_direction, 2e-4f)

#endif
