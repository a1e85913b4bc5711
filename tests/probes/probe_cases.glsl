// The mathematics of probes over random input, once for both languages.
#ifndef CANDELA_PROBE_CASES_GLSL
#define CANDELA_PROBE_CASES_GLSL

#include "../../shading/dominant_direction.glsl"
#include "../../shading/octahedral.glsl"
#include "../../shading/probes/composition.glsl"
#include "../../shading/probes/parallax.glsl"
#include "../../shading/probes/volume.glsl"
#include "../../shading/spherical_harmonics.glsl"
#include "../shading/agreement_case.glsl"

CANDELA_SHADING_BEGIN

FN vec4 case_probe_lookup(NUMBERS) {
    vec3 half_size = vec3(1.0f + u[0], 1.0f + u[1], 1.0f + u[2]);
    vec3 position = (2.0f * vec3(u[3], u[4], u[5]) - 1.0f) * 0.9f;
    int shape = u[6] < 0.5f ? kProxySphere : kProxyBox;
    ProbeLookup at = probe_lookup(shape, half_size, vec3(0.1f, -0.2f, 0.3f), position, case_sphere_direction(u[7], u[8]), u[9]);
    return vec4(at.direction, at.perceptual_roughness);
}
FN vec4 case_probe_influence(NUMBERS) {
    vec3 half_size = vec3(1.0f + u[0], 1.0f + u[1], 1.0f + u[2]);
    vec3 position = 3.0f * (vec3(u[3], u[4], u[5]) - 0.5f);
    return vec4(probe_influence(kProxyBox, position, half_size, u[6], 0.1f + u[7]),
                probe_influence(kProxySphere, position, half_size, u[6], 0.1f + u[7]), volume_influence(u[8], 0.1f + u[9]),
                influence_beyond(u[8], u[9], 0.5f));
}
FN vec4 case_composition(NUMBERS) {
    ProbeSum sum = empty_probe_sum();
    add_probe(sum, vec3(u[0], u[1], u[2]), u[3]);
    add_probe(sum, vec3(u[4], u[5], u[6]), u[7]);
    return vec4(add_distant(sum, vec3(u[8], u[9], u[10])), sum.alpha);
}
FN vec4 case_harmonics(NUMBERS) {
    vec3 d = case_sphere_direction(u[0], u[1]);
    float sum = 0.0f;
    for (int k = 0; k < kShCoefficients; ++k) sum += sh_basis(k, d) * sh_window(k, u[2]) * sh_cosine_over_pi(k);
    return vec4(sum + 2.0f, diffuse_dominant_direction(d, case_sphere_direction(u[3], u[4]), u[5], u[6]));
}
FN vec4 case_volume_weights(NUMBERS) {
    float visible = distance_visibility(1.0f + u[0], square(1.0f + u[0]) + 0.3f * u[1], 3.0f * u[2], 0.01f);
    vec3 n = case_sphere_direction(u[3], u[4]);
    return vec4(visible, probe_weight(facing_weight(n, case_sphere_direction(u[5], u[6])), visible), 1.0f, 0.0f);
}
FN vec4 case_octahedral_fold(NUMBERS) {
    ivec2 at = octahedral_fold(ivec2(int(18.0f * u[0]) - 1, int(18.0f * u[1]) - 1), 16);
    return vec4(float(at.x), float(at.y), 1.0f, 0.0f);
}

CANDELA_SHADING_END

#define PROBE_CASES(X)               \
    X(case_probe_lookup, 2e-5f)      \
    X(case_probe_influence, 1e-5f)   \
    X(case_composition, 1e-6f)       \
    X(case_harmonics, 1e-5f)         \
    X(case_volume_weights, 1e-4f)    \
    X(case_octahedral_fold, 0.0f)

#endif
