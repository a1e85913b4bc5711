// Directions drawn in proportion to the lobes of bsdf.glsl, and the density of the mixture. The path tracer and the
// in-engine integrator share it.
#ifndef CANDELA_BSDF_SAMPLING_GLSL
#define CANDELA_BSDF_SAMPLING_GLSL

#include "basis.glsl"
#include "bsdf.glsl"
#include "sampling.glsl"

CANDELA_SHADING_BEGIN

// Probabilities of drawing from each lobe; they add up to 1.
struct BsdfLobes {
    float diffuse;   // cosine about n
    float specular;  // visible normals of the base about n
    float sheen;     // uniform hemisphere about n: the lobe lies at the horizon, where a cosine draws nothing
    float coat;      // visible normals of the coat about coat_n
};

// By each lobe's share of the directional albedo (as the split sum weighs them). What can be lit at all keeps at
// least a tenth of the mean share, so that no lobe's weight grows without bound where its albedo was underestimated.
FN BsdfLobes bsdf_lobes(Surface s, BsdfTechniques t, float NoV, float coat_NoV, vec4 dfg, vec4 coat_dfg) {
    float under_coat = coat_transmittance(s.coat, saturate(coat_NoV));
    float sheen_albedo = 0.0f;
    if (max_component(s.sheen_color) > 0.0f) {
        sheen_albedo = sheen_directional_albedo(saturate(NoV), s.sheen_perceptual_roughness);
    }
    float under_sheen = under_coat * sheen_transmittance(s.sheen_color, sheen_albedo);
    PreparedSurface p = prepare_surface(s, t, NoV, dfg);
    vec3 diffuse_albedo = t.diffuse == kDiffuseLambert ? p.diffuse : p.diffuse * dfg.z;
    BsdfLobes lobes;
    lobes.diffuse = luminance(diffuse_albedo) * under_sheen;
    lobes.specular = luminance(p.specular_f0 * dfg.x + p.specular_f90 * dfg.y) * under_sheen;
    lobes.sheen = luminance(s.sheen_color) * sheen_albedo * under_coat;
    lobes.coat = coat_reflectance(s.coat, saturate(coat_NoV)) * (coat_dfg.x + coat_dfg.y);
    float least = 0.025f * (lobes.diffuse + lobes.specular + lobes.sheen + lobes.coat);
    lobes.diffuse = lobes.diffuse > 0.0f ? max(lobes.diffuse, least) : 0.0f;
    lobes.specular = lobes.specular > 0.0f ? max(lobes.specular, least) : 0.0f;
    lobes.sheen = lobes.sheen > 0.0f ? max(lobes.sheen, least) : 0.0f;
    lobes.coat = lobes.coat > 0.0f ? max(lobes.coat, least) : 0.0f;
    float sum = lobes.diffuse + lobes.specular + lobes.sheen + lobes.coat;
    if (!(sum > 0.0f)) return BsdfLobes(1.0f, 0.0f, 0.0f, 0.0f);
    float scale = 1.0f / sum;
    lobes.diffuse *= scale;
    lobes.specular *= scale;
    lobes.sheen *= scale;
    lobes.coat *= scale;
    return lobes;
}

// GGX widths of the base along tangent and bitangent.
FN vec2 base_alpha(Surface s) {
    return s.anisotropy > 0.0f ? anisotropic_alpha(s.perceptual_roughness, s.anisotropy)
                               : vec2(alpha_from_perceptual_roughness(s.perceptual_roughness));
}

// Normal mapping turns normals away from the viewer; visible normals exist for views above the horizon only. The same
// bent view is used for drawing and for the density.
FN vec3 visible_view(vec3 local_v) {
    return local_v.z > 1.0e-4f ? local_v : normalize(vec3(local_v.x, local_v.y, 1.0e-4f));
}

FN vec3 sample_ggx_reflection(vec2 u, vec3 local_v, vec2 alpha) {
    vec3 v = visible_view(local_v);
    vec3 h = sample_ggx_vndf(u, v, alpha);
    return 2.0f * dot(v, h) * h - v;
}
FN float pdf_ggx_reflection(vec3 local_v, vec3 local_l, vec2 alpha) {
    vec3 v = visible_view(local_v);
    vec3 sum = v + local_l;
    float length2 = dot(sum, sum);
    // Directions below the lobe's own horizon are drawn too, and a coat's horizon is not the base's.
    if (length2 < 1.0e-12f) return 0.0f;
    // VoH cancels between the density of h and pdf_reflected. It must: at grazing angles v + l has few digits, and a
    // VoH that comes out negative would make the density 0 where the lobe is highest.
    return 0.25f * ggx_visible_normals(v, sum * inversesqrt(length2), alpha);
}

// A direction towards the light; it may lie below the horizon of n, where the BSDF is 0. choice in [0,1), u in
// [0,1)^2. tangent and bitangent perpendicular to n.
FN vec3 sample_bsdf(BsdfLobes lobes, Surface s, vec3 n, vec3 tangent, vec3 bitangent, vec3 coat_n, vec3 v,
                    float choice, vec2 u) {
    if (choice < lobes.diffuse) return to_world(sample_cosine_hemisphere(u), tangent, bitangent, n);
    if (choice < lobes.diffuse + lobes.specular) {
        vec3 l = sample_ggx_reflection(u, to_local(v, tangent, bitangent, n), base_alpha(s));
        return to_world(l, tangent, bitangent, n);
    }
    if (choice < lobes.diffuse + lobes.specular + lobes.sheen) {
        return to_world(sample_uniform_hemisphere(u), tangent, bitangent, n);
    }
    vec3 coat_t;
    vec3 coat_b;
    orthonormal_basis(coat_n, coat_t, coat_b);
    vec2 alpha = vec2(alpha_from_perceptual_roughness(s.coat_perceptual_roughness));
    return to_world(sample_ggx_reflection(u, to_local(v, coat_t, coat_b, coat_n), alpha), coat_t, coat_b, coat_n);
}

// Density of sample_bsdf in 1/sr; unit vectors.
FN float pdf_bsdf(BsdfLobes lobes, Surface s, vec3 n, vec3 tangent, vec3 bitangent, vec3 coat_n, vec3 v, vec3 l) {
    float NoL = dot(n, l);
    float pdf = lobes.diffuse * pdf_cosine_hemisphere(NoL);
    if (lobes.specular > 0.0f) {
        pdf += lobes.specular * pdf_ggx_reflection(to_local(v, tangent, bitangent, n),
                                                   to_local(l, tangent, bitangent, n), base_alpha(s));
    }
    if (lobes.sheen > 0.0f && NoL > 0.0f) pdf += lobes.sheen * pdf_uniform_hemisphere();
    if (lobes.coat > 0.0f) {
        vec3 coat_t;
        vec3 coat_b;
        orthonormal_basis(coat_n, coat_t, coat_b);
        vec2 alpha = vec2(alpha_from_perceptual_roughness(s.coat_perceptual_roughness));
        pdf += lobes.coat *
               pdf_ggx_reflection(to_local(v, coat_t, coat_b, coat_n), to_local(l, coat_t, coat_b, coat_n), alpha);
    }
    return pdf;
}

// Weight of a draw with density pdf beside a second way of density other: Veach 1995, power heuristic with exponent 2.
FN float power_heuristic(float pdf, float other) {
    // As a ratio: the squares of densities of tiny lights are beyond single precision.
    if (pdf <= 0.0f) return 0.0f;
    float ratio = other / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

CANDELA_SHADING_END

#endif
