// Photometry, colour, tone curves, punctual lights and environment mapping over random input, once for both
// languages. Tolerances above 1e-5 name what loses the digits.
#ifndef CANDELA_PHOTOMETRY_CASES_GLSL
#define CANDELA_PHOTOMETRY_CASES_GLSL

#include "../../shading/color_temperature.glsl"
#include "../../shading/environment.glsl"
#include "../../shading/exposure.glsl"
#include "../../shading/lights/falloff_windows.glsl"
#include "../../shading/lights/photometric.glsl"
#include "../../shading/lights/punctual.glsl"
#include "../../shading/lights/units.glsl"
#include "../../shading/photometry.glsl"
#include "../../shading/tone_curves.glsl"
#include "../../shading/transfer.glsl"
#include "../shading/agreement_case.glsl"

CANDELA_SHADING_BEGIN

// Exposed colours from 8 stops under saturation to 8 over it.
FN vec3 case_exposed(float a, float b, float c) {
    return vec3(exp2(between(-8.0f, 8.0f, a)), exp2(between(-8.0f, 8.0f, b)), exp2(between(-8.0f, 8.0f, c)));
}
FN vec3 case_direction_about_y(float a, float b) {
    vec3 d = case_sphere_direction(a, b);
    return vec3(d.x, d.z, d.y);
}
FN float case_infinity(float x) {
    return 1.0f / (x - x);
}

FN vec4 case_tone_none(NUMBERS) {
    return vec4(tone_curve(kToneNone, case_exposed(u[0], u[1], u[2])), 0.0f);
}
FN vec4 case_tone_aces(NUMBERS) {
    return vec4(tone_curve(kToneAces, case_exposed(u[0], u[1], u[2])), 0.0f);
}
FN vec4 case_tone_agx(NUMBERS) {
    return vec4(tone_curve(kToneAgx, case_exposed(u[0], u[1], u[2])), 0.0f);
}
FN vec4 case_tone_neutral(NUMBERS) {
    return vec4(tone_curve(kToneNeutral, case_exposed(u[0], u[1], u[2])), 0.0f);
}
FN vec4 case_srgb(NUMBERS) {
    return vec4(srgb_from_linear(with_edges(u[0])), linear_from_srgb(with_edges(u[1])),
                srgb_from_linear(vec3(0.01f * u[2])).x, linear_from_srgb(vec3(0.1f * u[3])).y);
}
FN vec4 case_rec709_oetf(NUMBERS) {
    return vec4(rec709_oetf_from_linear(with_edges(u[0])), linear_from_rec709_oetf(with_edges(u[1])),
                rec709_oetf_from_linear(vec3(0.1f * u[2])).x, linear_from_rec709_oetf(vec3(0.2f * u[3])).y);
}
FN vec4 case_chromaticity(NUMBERS) {
    float kelvin = exp2(between(10.0f, 14.5f, u[0]));
    vec2 black = black_body_xy(kelvin);
    vec2 day = daylight_xy(kelvin);
    return vec4(black.x, black.y, day.x, day.y);
}
FN vec4 case_black_body(NUMBERS) {
    return vec4(rec709_from_black_body(exp2(between(10.0f, 14.5f, u[0]))), 1.0f);
}
FN vec4 case_daylight(NUMBERS) {
    return vec4(rec709_from_daylight(exp2(between(10.0f, 14.5f, u[0]))), 1.0f);
}
FN vec4 case_temperature(NUMBERS) {
    return vec4(rec709_from_temperature(exp2(between(10.0f, 14.5f, u[0]))), 1.0f);
}
FN vec4 case_ev100(NUMBERS) {
    return vec4(ev100_from_camera(between(1.0f, 32.0f, u[0]), between(0.0001f, 1.0f, u[1]),
                                  between(50.0f, 6400.0f, u[2])),
                ev100_from_luminance(exp2(between(0.0f, 20.0f, u[3]))),
                ev100_from_illuminance(exp2(between(4.0f, 20.0f, u[4]))), ev100_compensated(u[5], u[6]));
}
FN vec4 case_exposure(NUMBERS) {
    float ev100 = between(-6.0f, 18.0f, u[0]);
    return vec4(luminance_from_ev100(ev100), illuminance_from_ev100(ev100), max_luminance_from_ev100(ev100),
                1.0f / exposure_from_ev100(ev100));
}
FN vec4 case_sensor(NUMBERS) {
    float aperture = between(1.0f, 32.0f, u[1]);
    return vec4(sensor_illuminance(100.0f * u[0], aperture), luminous_exposure(100.0f * u[0], aperture, u[2]),
                ev100_from_exposure(exp2(between(-20.0f, -4.0f, u[3]))), 1.0f);
}
FN vec4 case_units(NUMBERS) {
    return vec4(lx_from_cd(u[0], with_edges(u[1])), cd_from_lx(u[0], with_edges(u[1])),
                nit_from_lx_lambertian(u[2], u[3]), lm_from_watt(u[4], efficacy_from_efficiency(u[5])));
}
FN vec4 case_punctual_units(NUMBERS) {
    float half_angle = between(0.01f, PI, u[0]);
    return vec4(point_cd_from_lm(u[1]) / spot_cd_from_lm(u[1] + 0.1f),
                spot_cd_from_lm_exact(1.0f, half_angle) * cone_solid_angle(between(0.01f, PI, u[2])),
                spot_lm_from_cd_smooth(1.0f, 0.5f * u[3], 0.5f + u[4]), 1.0f);
}
FN vec4 case_frustum(NUMBERS) {
    return vec4(frustum_cd_from_lm(1.0f, between(0.1f, PI, u[5]), between(0.1f, 3.0f, u[6])));
}
FN vec4 case_area_units(NUMBERS) {
    float radius = between(0.01f, 1.0f, u[0]);
    return vec4(sphere_nit_from_lm(1.0f, radius), tube_nit_from_lm(1.0f, radius, u[1]),
                disk_lx_from_nit(1.0f, radius, u[2]), sphere_lx_from_nit(1.0f, radius, radius + u[3]));
}
FN vec4 case_punctual(NUMBERS) {
    vec3 to_light = vec3(between(-3.0f, 3.0f, u[0]), between(-3.0f, 3.0f, u[1]), between(-3.0f, 3.0f, u[2]));
    float range = between(5.0f, 20.0f, u[3]);
    return vec4(window_attenuation(10.0f * u[4], range + 5.0f), 9.0f * distance_attenuation(to_light, range),
                angle_attenuation(u[5], between(0.5f, 1.0f, u[6]), 0.4f * u[7]), 1.0f);
}
FN vec4 case_falloff(NUMBERS) {
    vec3 to_light = vec3(between(-3.0f, 3.0f, u[0]), between(-3.0f, 3.0f, u[1]), between(-3.0f, 3.0f, u[2]));
    float range = between(6.0f, 20.0f, u[3]);
    Falloff offset = Falloff(kFalloffOffset, u[4]);
    return vec4(distance_attenuation(offset, to_light, range),
                distance_attenuation(Falloff(kFalloffExponent2, 0.0f), to_light, range),
                distance_attenuation(Falloff(kFalloffExponent8, 0.0f), to_light, range),
                disk_cone_attenuation(to_light, vec3(0.0f, 0.0f, 1.0f), u[5], 0.9f, 0.8f * u[6]));
}
FN vec4 case_no_range(NUMBERS) {
    float range = case_infinity(u[0]);
    return vec4(window_attenuation(1000.0f * u[1], range),
                distance_attenuation(vec3(1.0f, u[2], u[3]), range), 0.0f, 0.0f);
}
// A smooth web in place of the table, so that which cell a direction on an edge falls into does not matter.
FN float case_web_node(int index, int width, int height) {
    float c = TWO_PI * float(index % width) / float(width);
    float gamma = PI * float(index / width) / float(height - 1);
    return 2.0f + cos(gamma) + sin(gamma) * cos(c);
}
FN float case_web(vec3 direction, int width, int height) {
    PhotometricTaps taps = photometric_taps(direction, width, height);
    return taps.weight.x * case_web_node(taps.index.x, width, height) +
           taps.weight.y * case_web_node(taps.index.y, width, height) +
           taps.weight.z * case_web_node(taps.index.z, width, height) +
           taps.weight.w * case_web_node(taps.index.w, width, height);
}
FN vec4 case_photometric_taps(NUMBERS) {
    vec3 direction = 3.0f * case_direction_about_y(u[0], u[1]);
    vec2 uv = photometric_uv(direction, 24, 37);
    return vec4(case_web(direction, 24, 37), case_web(direction, 1, 2), cos(TWO_PI * uv.x), uv.y);
}
FN vec4 case_photometric_types(NUMBERS) {
    float horizontal = between(-1.5f, 1.5f, u[0]);
    float vertical = between(-1.5f, 1.5f, u[1]);
    vec2 a = photometric_angles_type_a(photometric_direction_type_a(horizontal, vertical));
    vec2 b = photometric_angles_type_b(photometric_direction_type_b(horizontal, vertical));
    return vec4(a.x - b.x, a.y - b.y, a.x + 2.0f, a.y + 2.0f);
}
FN vec4 case_equirect_uv(NUMBERS) {
    vec3 direction = case_direction_about_y(u[0], u[1]);
    vec2 uv = equirect_uv(direction);
    vec2 fast = equirect_uv_fast(direction);
    return vec4(uv.x, uv.y, fast.x, fast.y);
}
FN vec4 case_equirect_direction(NUMBERS) {
    return vec4(rotate_about_y(equirect_direction(vec2(u[0], u[1])), between(-7.0f, 7.0f, u[2])), 0.0f);
}
FN vec4 case_texel_solid_angle(NUMBERS) {
    return vec4(equirect_texel_solid_angle(uint(512.0f * u[0]), 1024u, 512u));
}

CANDELA_SHADING_END

// Digits are lost: by AgX in log2 times the steep sigmoid; by the temperatures in the exponential of Planck's
// law and in the small differences of the matrix; by the spot in the difference of two cosines; by the
// frustum and the environment in the arc tangent of the driver (1e-6 rad, next to small results).
#define PHOTOMETRY_CASES(X)           \
    X(case_tone_none, 1e-6f)          \
    X(case_tone_aces, 1e-5f)          \
    X(case_tone_agx, 2e-5f)           \
    X(case_tone_neutral, 1e-5f)       \
    X(case_srgb, 1e-5f)               \
    X(case_rec709_oetf, 1e-5f)        \
    X(case_chromaticity, 1e-5f)       \
    X(case_black_body, 5e-5f)         \
    X(case_daylight, 2e-5f)           \
    X(case_temperature, 5e-5f)        \
    X(case_ev100, 1e-5f)              \
    X(case_exposure, 1e-5f)           \
    X(case_sensor, 1e-5f)             \
    X(case_units, 1e-5f)              \
    X(case_punctual_units, 1e-5f)     \
    X(case_frustum, 5e-5f)            \
    X(case_area_units, 1e-5f)         \
    X(case_punctual, 2e-5f)           \
    X(case_falloff, 2e-5f)            \
    X(case_no_range, 1e-6f)           \
    X(case_photometric_taps, 2e-5f)   \
    X(case_photometric_types, 2e-5f)  \
    X(case_equirect_uv, 5e-5f)        \
    X(case_equirect_direction, 1e-5f) \
    X(case_texel_solid_angle, 1e-5f)

#endif
