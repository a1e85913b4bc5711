// The formulas of shading/sky over random input, once for both languages. Tolerances above 1e-5 name what loses the
// digits.
#ifndef CANDELA_SKY_CASES_GLSL
#define CANDELA_SKY_CASES_GLSL

#include "../../shading/sky/scattering.glsl"
#include "../shading/agreement_case.glsl"

CANDELA_SHADING_BEGIN

FN vec4 case_density(NUMBERS) {
    return vec4(sky_density(between(0.0f, 90000.0f, square(u[0]))), 1.0f);
}
FN vec4 case_ray(NUMBERS) {
    float h = between(2.0f, 90000.0f, square(u[0]));
    float mu = between(-1.0f, 1.0f, u[1]);
    float down = sky_horizon_mu(h) * between(1.0f, 2.0f, u[2]);
    return vec4(sky_distance_to_top(h, abs(mu)), sky_distance_to_ground(h, max(down, -1.0f)),
                1.0e6f * sky_horizon_mu(h), sky_altitude_at(h, mu, 1000.0f * u[3]));
}
FN vec4 case_columns(NUMBERS) {
    return vec4(sky_columns_m(between(0.0f, 60000.0f, square(u[0])), square(u[1])), 1.0f);
}
FN vec4 case_phases(NUMBERS) {
    float c = between(-1.0f, 1.0f, u[0]);
    return vec4(rayleigh_phase(c), aerosol_phase(c), forward_phase(c, 1), forward_phase(c, 3));
}
FN vec4 case_shares(NUMBERS) {
    return forward_shares(6.0f * square(u[0]));
}
FN vec4 case_sun(NUMBERS) {
    float x = 3.0f * square(u[1]);
    return vec4(sun_visible_share(0.0f, between(-0.006f, 0.006f, u[0])), mean_transmittance(x, exp_of_negative(-x)),
                exp_of_negative(-30.0f * u[2]), multiple_scattering_closure(u[3]));
}
FN vec4 case_transmitted(NUMBERS) {
    SkyAtmosphere air;
    sky_atmosphere(between(1.0f, 10.0f, u[0]), between(0.0f, 600.0f, u[1]), u[2], air);
    vec3 columns = vec3(8400.0f, 1200.0f, 15000.0f) * between(0.0f, 8.0f, u[3]);
    return vec4(sky_rec709(air, sky_transmittance(air, columns)), air.ground_albedo);
}

CANDELA_SHADING_END

// Columns of a level ray are sums of exponentials of differences of large radii; lx of the last are sums of 16 bands.
#define SKY_CASES(X)            \
    X(case_density, 2.0e-5f)    \
    X(case_ray, 1.0e-4f)        \
    X(case_columns, 2.0e-4f)    \
    X(case_phases, 2.0e-5f)     \
    X(case_shares, 2.0e-5f)     \
    X(case_sun, 1.0e-4f)        \
    X(case_transmitted, 1.0e-4f)

#endif
