// Every function of the material model over random input, once for both languages.
#ifndef CANDELA_BSDF_CASES_GLSL
#define CANDELA_BSDF_CASES_GLSL

#include "../../shading/basis.glsl"
#include "../../shading/bsdf.glsl"
#include "../../shading/dfg.glsl"
#include "../../shading/dominant_direction.glsl"
#include "../../shading/footprint.glsl"
#include "../../shading/gaussian_specular.glsl"
#include "../../shading/layer_reflection.glsl"
#include "../../shading/lights/representative_point.glsl"
#include "../../shading/occlusion.glsl"
#include "../../shading/octahedral.glsl"
#include "../../shading/remapping.glsl"
#include "../../shading/sampling.glsl"
#include "../../shading/sequence.glsl"
#include "../../shading/spherical_gaussian_lobe.glsl"
#include "../../shading/teaching_page.glsl"
#include "agreement_case.glsl"

CANDELA_SHADING_BEGIN

FN vec3 case_direction(float a, float b) {
    return sample_uniform_hemisphere(vec2(between(0.01f, 1.0f, a), b));
}

FN vec4 case_microfacet(NUMBERS) {
    float alpha = between(0.05f, 1.0f, with_edges(u[0]));
    float NoV = between(0.01f, 1.0f, u[1]);
    float NoL = between(0.01f, 1.0f, u[2]);
    return vec4(D_GGX_cos2_sin2(1.0f - u[3], u[3], alpha), G1_SmithGGX(NoV, alpha),
                smith_ggx_root(NoL, alpha), alpha_from_perceptual_roughness(u[4]));
}
FN vec4 case_D_GGX(NUMBERS) {
    return vec4(D_GGX(with_edges(u[0]), between(0.1f, 1.0f, u[1])));
}
FN vec4 case_D_GGX_vectors(NUMBERS) {
    vec3 n = case_direction(u[0], u[1]);
    return vec4(D_GGX(n, normalize(n + 0.2f * case_direction(u[2], u[3])), between(0.1f, 1.0f, u[4])));
}
FN vec4 case_visibility(NUMBERS) {
    float alpha = between(kMinAlpha, 1.0f, with_edges(u[0]));
    float NoV = between(0.01f, 1.0f, with_edges(u[1]));
    float NoL = between(0.01f, 1.0f, with_edges(u[2]));
    return vec4(V_SmithGGXCorrelated(NoV, NoL, alpha), V_SmithGGXUncorrelated(NoV, NoL, alpha),
                V_SchlickSmith(NoV, NoL, k_analytic(u[3])), V_SchlickSmith(NoV, NoL, k_image_based(alpha)));
}
FN vec4 case_fresnel(NUMBERS) {
    vec3 f0 = vec3(u[0], u[1], u[2]);
    vec3 f90 = vec3(1.0f, u[3], 0.9f);
    float c = with_edges(u[4]);
    return vec4(F_Schlick(f0, f90, c).x, F_SphericalGaussian(f0, c).y, F_SphericalGaussian(f0, f90, c).y,
                F_Schlick(f0.z, f90.z, c));
}
FN vec4 case_fresnel_exact(NUMBERS) {
    float c = with_edges(u[0]);
    vec3 conductor =
        F_ConductorExact(c, vec3(u[1], 0.1f + u[2], 2.0f * u[3]), vec3(1.0f + 4.0f * u[4], u[5], 2.0f));
    return vec4(F_DielectricExact(c, between(1.1f, 2.5f, u[6])), conductor.x, conductor.y, conductor.z);
}
FN vec4 case_reflectance(NUMBERS) {
    return vec4(f90_from_f0(0.05f * vec3(u[0], u[1], u[2])), f0_from_ior(between(1.1f, 3.0f, u[3])),
                f0_from_reflectance(u[4]), 1.0f);
}
FN vec4 case_diffuse(NUMBERS) {
    return vec4(Fd_Disney(u[0], u[1], u[2], with_edges(u[3])),
                Fd_DisneyRenormalized(u[0], u[1], u[2], with_edges(u[3])), albedo_Disney(u[0], u[3]),
                albedo_DisneyRenormalized(u[0], u[3]));
}
FN vec4 case_anisotropy(NUMBERS) {
    vec3 v = case_direction(u[0], u[1]);
    vec3 l = case_direction(u[2], u[3]);
    vec3 h = normalize(v + l);
    vec2 alpha = anisotropic_alpha(between(0.3f, 1.0f, u[4]), u[5]);
    return vec4(D_GGXAnisotropic(h.z, h.x, h.y, alpha.x, alpha.y),
                V_SmithGGXCorrelatedAnisotropic(v.z, v.x, v.y, l.z, l.x, l.y, alpha.x, alpha.y),
                G1_SmithGGXAnisotropic(v, alpha), alpha.x);
}
FN vec4 case_clearcoat(NUMBERS) {
    vec3 v = case_direction(u[0], u[1]);
    vec3 l = case_direction(u[2], u[3]);
    vec3 n = vec3(0.0f, 0.0f, 1.0f);
    float roughness = between(0.3f, 1.0f, u[5]);
    float alpha = alpha_from_perceptual_roughness(roughness);
    return vec4(coat_reflectance(u[4], v.z), coat_transmittance(u[4], v.z),
                specular_lobe(techniques_best(), n, v, l, roughness, alpha, 1.1f * alpha),
                specular_lobe(techniques_ue4(), n, v, l, roughness, alpha, alpha));
}
FN vec4 case_sheen(NUMBERS) {
    float roughness = between(0.2f, 1.0f, u[0]);
    float alpha = sheen_alpha(roughness);
    float NoV = between(0.02f, 1.0f, u[1]);
    float NoL = between(0.02f, 1.0f, u[2]);
    return vec4(D_Charlie(0.95f * u[3], alpha), V_Charlie(NoV, NoL, alpha),
                charlie_albedo(0.5f * NoV, roughness), sheen_transmittance(vec3(u[4], u[5], 0.2f), u[6]));
}
FN vec4 case_energy(NUMBERS) {
    vec3 scale = multiple_scattering_scale(vec3(u[0], u[1], u[2]), with_edges(u[3]));
    return vec4(scale.x, scale.y, scale.z, diffuse_transmittance(0.9f * vec3(u[4], u[5], u[6])));
}
FN vec4 case_basis(NUMBERS) {
    vec3 n = case_direction(u[0], u[1]) * (u[2] < 0.5f ? -1.0f : 1.0f);
    vec3 t;
    vec3 b;
    orthonormal_basis(n, t, b);
    vec3 w = to_world(case_direction(u[3], u[4]), t, b, n);
    return vec4(w.x, w.y, w.z, to_local(vec3(u[5], u[6], u[7]), t, b, n).x);
}
FN vec4 case_octahedral(NUMBERS) {
    vec3 n = case_direction(u[0], u[1]) * (u[2] < 0.5f ? -1.0f : 1.0f);
    vec3 d = octahedral_decode(2.0f * vec2(u[3], u[4]) - vec2(1.0f));
    vec2 e = octahedral_encode(n);
    return vec4(e.x, e.y, d.x, d.z);
}
FN vec4 case_footprint(NUMBERS) {
    return vec4(alpha_filtered(u[0], 0.3f * vec3(u[1], u[2], u[3]), 0.3f * vec3(u[4], u[5], u[6])),
                alpha_from_average_normal(u[0], with_edges(u[7])),
                perceptual_roughness_from_average_normal(u[0], with_edges(u[8])), 0.0f);
}
FN vec4 case_sequence(NUMBERS) {
    uint i = floatBitsToUint(u[0]);
    uint seed = floatBitsToUint(u[1]) + floatBitsToUint(u[2]);
    vec2 a = sobol_owen(i, seed);
    vec2 b = sobol_owen_pair(i, 3u, pixel_seed(uvec2(i, seed), 7u));
    return vec4(a.x + radical_inverse_base2(i), a.y, b.x, b.y + hammersley(i & 1023u, 1024u).x);
}
FN vec4 case_cosine_sample(NUMBERS) {
    vec3 d = sample_cosine_hemisphere(vec2(u[0], u[1]));
    return vec4(d.x, d.y, d.z, pdf_cosine_hemisphere(d.z));
}
FN vec4 case_ndf_sample(NUMBERS) {
    vec2 alpha = vec2(between(0.1f, 1.0f, u[2]), between(0.1f, 1.0f, u[3]));
    vec3 h = sample_ggx_ndf(vec2(0.99f * u[0], u[1]), alpha);
    return vec4(h.x, h.y, h.z, pdf_ggx_ndf(case_direction(u[4], u[5]), alpha));
}
FN vec4 case_vndf_sample(NUMBERS) {
    vec2 alpha = vec2(between(0.1f, 1.0f, u[2]), between(0.1f, 1.0f, u[3]));
    vec3 v = case_direction(u[4], u[5]);
    vec3 h = sample_ggx_vndf(vec2(u[0], 0.99f * u[1]), v, alpha);
    return vec4(h.x, h.y, h.z, pdf_ggx_vndf(v, case_direction(u[6], u[7]), alpha));
}
FN vec4 case_charlie_sample(NUMBERS) {
    vec3 h = sample_charlie_ndf(vec2(0.95f * u[0] + 0.01f, u[1]), sheen_alpha(between(0.3f, 1.0f, u[2])));
    return vec4(h.x, h.y, h.z, pdf_reflected(u[3], between(0.1f, 1.0f, u[4])));
}
FN vec4 case_dfg(NUMBERS) {
    return integrate_dfg(between(0.02f, 1.0f, u[0]), between(0.3f, 1.0f, u[1]), 32u);
}
FN vec4 case_dfg_ue4(NUMBERS) {
    return integrate_dfg_ue4(between(0.02f, 1.0f, u[0]), between(0.3f, 1.0f, u[1]), 32u);
}
FN vec4 case_dfg_coordinates(NUMBERS) {
    vec2 uv = dfg_uv(with_edges(u[0]), with_edges(u[1]));
    vec2 parameters = dfg_parameters(uint(63.0f * u[2]), uint(63.0f * u[3]));
    return vec4(uv.x, uv.y, parameters.x, parameters.y);
}
FN vec4 case_dfg_approx(NUMBERS) {
    vec3 c = EnvBRDFApprox(vec3(1.0f, 0.8f, 0.3f + u[2]), u[0], u[1]);
    return vec4(c.x, c.y, c.z, dfg_approx(u[1], between(0.2f, 1.0f, u[0])).z);
}

FN vec4 case_gaussian_specular(NUMBERS) {
    float power = between(1.0f, 512.0f, u[0]);
    // The edge's cosine is 1 - 3/power, which single precision knows to 1e-7: small powers only.
    float small_power = between(1.0f, 8.0f, u[0]);
    return vec4(gaussian_specular(with_edges(u[1]), small_power), gaussian_specular_normalization_line(power),
                gaussian_specular_normalization_hyperbola(power), G1_Schlick(u[2], between(0.1f, 0.5f, u[3])));
}
FN vec4 case_directional_lobe(NUMBERS) {
    float alpha = between(0.5f, 1.0f, u[0]);
    return vec4(D_Approx(alpha, with_edges(u[1])), D_Approx(alpha, -u[2]), alpha_from_smoothness(u[3]),
                alpha_from_smoothness_ryse(u[4]) + alpha_from_smoothness_fourth(u[4]));
}
FN vec4 case_dominant_direction(NUMBERS) {
    vec3 n = vec3(0.0f, 0.0f, 1.0f);
    vec3 mirror = case_direction(u[0], u[1]);
    vec3 fit = specular_dominant_direction_fit(n, mirror, mirror.z, 0.95f * u[2]);
    vec3 area = specular_dominant_direction_area(n, mirror, u[2]);
    return vec4(fit.x, fit.z, area.x, area.z);
}
FN vec4 case_diffuse_dominant_direction(NUMBERS) {
    vec3 n = vec3(0.0f, 0.0f, 1.0f);
    vec3 v = case_direction(u[0], u[1]);
    vec3 d = diffuse_dominant_direction(n, v, v.z, with_edges(u[2]));
    return vec4(d, env_brdf_approx_nonmetal(with_edges(u[3]), u[4]));
}
FN vec4 case_read(LobeRead read) {
    return vec4(read.direction.x + read.direction.y, read.direction.z, read.perceptual_roughness, read.weight);
}
FN vec4 case_fitted_reflection(NUMBERS) {
    vec3 v = case_direction(u[0], u[1]);
    return case_read(fitted_reflection(vec3(0.0f, 0.0f, 1.0f), v, v.z, between(0.05f, 1.0f, u[2]), u[3]));
}
FN vec4 case_stretched_reflection(NUMBERS) {
    vec3 n = vec3(0.0f, 0.0f, 1.0f);
    vec3 v = case_direction(u[0], u[1]);
    float r = between(0.05f, 1.0f, u[2]);
    LobeRead a;
    LobeRead b;
    LobeRead c;
    if (u[4] < 0.5f) {
        stretched_reflection_2(n, v, v.z, r, u[3], a, b);
        return u[5] < 0.5f ? case_read(a) : case_read(b);
    }
    stretched_reflection_3(n, v, v.z, r, u[3], a, b, c);
    return u[5] < 0.3f ? case_read(a) : (u[5] < 0.6f ? case_read(b) : case_read(c));
}
FN vec4 case_anisotropic_read(NUMBERS) {
    vec3 v = case_direction(u[0], u[1]);
    vec2 alpha = anisotropic_alpha(between(0.2f, 0.8f, u[2]), between(0.2f, 1.0f, u[3]));
    AnisotropicLobe lobe =
        anisotropic_lobe(vec3(0.0f, 0.0f, 1.0f), vec3(1.0f, 0.0f, 0.0f), vec3(0.0f, 1.0f, 0.0f), v, v.z, alpha);
    // Which way the row runs is not determined: the same of both ends.
    LobeRead first = anisotropic_read(lobe, 0);
    LobeRead last = anisotropic_read(lobe, 4);
    return vec4(first.direction.z + last.direction.z, first.weight + last.weight, first.perceptual_roughness,
                anisotropic_read(lobe, 2).weight);
}
FN vec4 case_sheen_read(NUMBERS) {
    vec3 v = case_direction(u[0], u[1]);
    return case_read(sheen_read(vec3(0.0f, 0.0f, 1.0f), v, v.z, u[2]));
}
FN vec4 case_representative_point(NUMBERS) {
    vec3 mirror = case_direction(u[0], u[1]);
    vec3 v = case_direction(u[2], u[3]);
    vec3 l = case_direction(u[4], u[5]);
    vec3 point = representative_point_sphere(3.0f * l, mirror, u[6]);
    vec3 page = representative_direction_TeachingPage(l, v, mirror, 0.5f * u[7]);
    return vec4(point.x + page.x, point.z + page.z, G1_TeachingPage(v.z, l.z, between(0.1f, 0.5f, u[8])),
                representative_point_sphere_normalization(between(0.1f, 1.0f, u[9]), u[6], 2.0f));
}

FN Surface case_surface(NUMBERS) {
    Surface s;
    s.base_color = vec3(u[0], u[1], u[2]);
    s.metallic = with_edges(u[3]);
    s.perceptual_roughness = between(0.3f, 1.0f, u[4]);
    s.dielectric_f0 = 0.1f * vec3(u[5], u[5], u[6]);
    s.dielectric_f90 = vec3(with_edges(u[7]));
    // A full coat at the horizon leaves 1 - 0.9995 for what is below it: nothing to compare relatively.
    s.coat = 0.9f * with_edges(u[8]);
    s.coat_perceptual_roughness = between(0.3f, 1.0f, u[9]);
    s.sheen_color = vec3(with_edges(u[10]), u[11], 0.5f) * with_edges(u[12]);
    s.sheen_perceptual_roughness = between(0.5f, 1.0f, u[13]);
    s.anisotropy = with_edges(u[14]);
    return s;
}
FN BsdfTechniques case_techniques(float x) {
    if (x < 0.25f) return techniques_best();
    if (x < 0.5f) return techniques_frostbite();
    if (x < 0.75f) return techniques_ue4();
    if (x < 0.9f) return BsdfTechniques(kDiffuseDisney, kVisibilitySchlickSmith, kFresnelSchlick, kEnergyCompensated);
    return BsdfTechniques(kDiffuseLambert, kVisibilityTeachingPage, kFresnelSphericalGaussian, kEnergyNone);
}
FN vec4 case_dfg_value(NUMBERS) {
    return vec4(0.5f + 0.4f * u[20], 0.1f * u[21], u[22], u[23]);
}
FN vec4 case_standard(NUMBERS) {
    vec3 f = evaluate_standard(case_surface(u), case_techniques(u[15]), u[16], u[17], 0.9f * u[18], u[19],
                               case_dfg_value(u));
    return vec4(f.x, f.y, f.z, 0.0f);
}
FN vec4 case_standard_vectors(NUMBERS) {
    vec3 diffuse;
    vec3 specular;
    evaluate_standard(case_surface(u), case_techniques(u[15]), vec3(0.0f, 0.0f, 1.0f),
                      case_direction(u[16], u[17]), case_direction(u[18], u[19]), case_dfg_value(u), diffuse,
                      specular);
    return vec4(diffuse.x, diffuse.y, specular.x, specular.y);
}
FN vec4 case_layered(NUMBERS) {
    vec3 n = vec3(0.0f, 0.0f, 1.0f);
    vec3 coat_n = normalize(vec3(0.2f * u[20], -0.3f * u[21], 1.0f));
    vec3 diffuse;
    vec3 specular;
    evaluate_layered(case_surface(u), case_techniques(u[15]), n, vec3(1.0f, 0.0f, 0.0f),
                     vec3(0.0f, 1.0f, 0.0f), coat_n, case_direction(u[16], u[17]),
                     case_direction(u[18], u[19]), case_dfg_value(u), diffuse, specular);
    return vec4(diffuse.x, diffuse.y, specular.x, specular.y);
}
FN vec4 case_ibl(NUMBERS) {
    IblWeights w = ibl_layered_weights(case_surface(u), case_techniques(u[15]), u[16], u[17],
                                       case_dfg_value(u), case_dfg_value(u));
    return vec4(w.diffuse.x, w.specular.y, w.sheen.x, w.coat);
}

CANDELA_SHADING_END

#define BSDF_CASES(X)               \
    X(case_microfacet, 1e-5f)       \
    X(case_D_GGX, 1e-5f)            \
    X(case_D_GGX_vectors, 1e-5f)    \
    X(case_visibility, 1e-5f)       \
    X(case_fresnel, 1e-5f)          \
    X(case_fresnel_exact, 1e-5f)    \
    X(case_reflectance, 1e-5f)      \
    X(case_diffuse, 1e-5f)          \
    X(case_anisotropy, 1e-5f)       \
    X(case_clearcoat, 1e-5f)        \
    X(case_sheen, 1e-5f)            \
    X(case_energy, 1e-5f)           \
    X(case_basis, 1e-5f)            \
    X(case_octahedral, 1e-5f)       \
    X(case_footprint, 1e-5f)        \
    X(case_sequence, 0.0f)          \
    X(case_cosine_sample, 1e-5f)    \
    X(case_ndf_sample, 1e-5f)       \
    X(case_vndf_sample, 1e-5f)      \
    X(case_charlie_sample, 1e-5f)   \
    X(case_dfg, 1e-5f)              \
    X(case_dfg_ue4, 1e-5f)          \
    X(case_dfg_coordinates, 1e-5f)  \
    X(case_dfg_approx, 1e-5f)       \
    X(case_gaussian_specular, 1e-5f) \
    X(case_directional_lobe, 1e-5f) \
    X(case_dominant_direction, 1e-5f) \
    X(case_diffuse_dominant_direction, 1e-5f) \
    X(case_fitted_reflection, 2e-5f) \
    X(case_stretched_reflection, 2e-5f) \
    X(case_anisotropic_read, 1e-4f) \
    X(case_sheen_read, 2e-5f)       \
    X(case_representative_point, 1e-5f) \
    X(case_standard, 1e-5f)         \
    X(case_standard_vectors, 1e-5f) \
    X(case_layered, 1e-5f)          \
    X(case_ibl, 1e-5f)

#endif
