// The material model: metal and dielectric base, sheen, clear coat, put together from the lobes by named
// techniques.
#ifndef CANDELA_BSDF_GLSL
#define CANDELA_BSDF_GLSL

#include "anisotropy.glsl"
#include "basis.glsl"
#include "clearcoat.glsl"
#include "diffuse.glsl"
#include "energy.glsl"
#include "fresnel.glsl"
#include "microfacet.glsl"
#include "sheen.glsl"
#include "teaching_page.glsl"

CANDELA_SHADING_BEGIN

CONSTANT int kDiffuseLambert = 0;
CONSTANT int kDiffuseDisney = 1;
CONSTANT int kDiffuseDisneyRenormalized = 2;
CONSTANT int kVisibilitySmithCorrelated = 0;
// k by where the light comes from: k_analytic for lights, k_image_based for the rest (Karis 2013).
CONSTANT int kVisibilitySchlickSmith = 1;
// k_image_based for all light.
CONSTANT int kVisibilitySchlickSmithHalfAlpha = 2;
// G1 as the teaching page prints it, with k_analytic, for lights; of image-based light, which the page does not have, Karis's.
CONSTANT int kVisibilityTeachingPage = 3;
CONSTANT int kFresnelSchlick = 0;
CONSTANT int kFresnelSphericalGaussian = 1;
// Schlick with f90 lowered below f0 = 2 %, of dielectrics and metals (Frostbite sections 3.2.1 and 4.10.3).
CONSTANT int kFresnelSchlickMicroOcclusion = 2;
CONSTANT int kEnergyNone = 0;
CONSTANT int kEnergyCompensated = 1;

// What a material is at one point. Colours: linear Rec.709 in [0,1]; all numbers in [0,1].
struct Surface {
    vec3 base_color;
    float metallic;
    float perceptual_roughness;
    vec3 dielectric_f0;
    vec3 dielectric_f90;
    float coat;
    float coat_perceptual_roughness;
    vec3 sheen_color;
    float sheen_perceptual_roughness;
    float anisotropy;
};

// One technique for each part; as specialization constants in GLSL, where the driver folds the rest away.
struct BsdfTechniques {
    int diffuse;
    int specular_visibility;
    int fresnel;
    int energy;
};

FN BsdfTechniques techniques_best() {
    return BsdfTechniques(kDiffuseLambert, kVisibilitySmithCorrelated, kFresnelSchlick, kEnergyCompensated);
}
FN BsdfTechniques techniques_frostbite() {
    return BsdfTechniques(kDiffuseDisneyRenormalized, kVisibilitySmithCorrelated,
                          kFresnelSchlickMicroOcclusion, kEnergyNone);
}
FN BsdfTechniques techniques_ue4() {
    return BsdfTechniques(kDiffuseLambert, kVisibilitySchlickSmith, kFresnelSphericalGaussian, kEnergyNone);
}

FN bool has_two_forms_of_visibility(BsdfTechniques t) {
    return t.specular_visibility == kVisibilitySchlickSmith || t.specular_visibility == kVisibilityTeachingPage;
}

// The form of a model under light that comes from no light of the scene: from the environment and from other surfaces. The
// techniques themselves are the form under lights. Karis 2013, "Specular G": the remapped roughness in k is for analytic
// lights only; image-based light takes k = alpha / 2, and its listing of the environment's BRDF has Schlick's Fresnel.
FN BsdfTechniques image_based_form(BsdfTechniques t) {
    if (has_two_forms_of_visibility(t)) t.specular_visibility = kVisibilitySchlickSmithHalfAlpha;
    if (t.fresnel == kFresnelSphericalGaussian) t.fresnel = kFresnelSchlick;
    return t;
}

// Whether image_based_form() is another model.
FN bool has_two_forms(BsdfTechniques t) {
    return has_two_forms_of_visibility(t) || t.fresnel == kFresnelSphericalGaussian;
}

// What of a surface does not depend on the light: prepare once a pixel, evaluate once a light.
//
// Dielectric and metal are each complete with their own energy terms and are mixed after; f0 itself is never
// mixed. As Fresnel is linear in f0 and f90, the mixture of the two complete lobes is again f0 + (f90 - f0)
// w(LoH) with the sums below, so that evaluating both costs no more than one.
struct PreparedSurface {
    vec3 diffuse;      // albedo under the specular layer, without 1/pi
    vec3 specular_f0;  // head-on and grazing factors on D V
    vec3 specular_f90;
    float perceptual_roughness;
    float alpha;
    float NoV;
};

// Albedo that energy compensation divides by. The table is of the isotropic lobe; an anisotropic one seen
// along its grain at grazing angles reflects up to 12 % more than that, and must not be scaled up as if it
// reflected less. Faded out below NoV 0.3, where the excess begins; strongly anisotropic metals stay darker
// than they should.
FN float compensation_albedo(Surface s, float NoV, vec4 dfg) {
    float albedo = dfg.x + dfg.y;
    return s.anisotropy > 0.0f ? mix(1.0f, albedo, smoothstep(0.0f, 0.3f, NoV)) : albedo;
}

FN PreparedSurface prepare_surface(Surface s, BsdfTechniques t, float NoV, vec4 dfg) {
    PreparedSurface p;
    // Normal mapping turns normals away from the viewer; at 0 every visibility function is singular.
    p.NoV = max(NoV, 1.0e-4f);
    p.perceptual_roughness = s.perceptual_roughness;
    p.alpha = alpha_from_perceptual_roughness(s.perceptual_roughness);
    vec3 dielectric_f90 = s.dielectric_f90;
    vec3 metal_f90 = vec3(1.0f);
    if (t.fresnel == kFresnelSchlickMicroOcclusion) {
        dielectric_f90 = min(dielectric_f90, vec3(f90_from_f0(s.dielectric_f0)));
        metal_f90 = vec3(f90_from_f0(s.base_color));
    }
    vec3 dielectric_scale = vec3(1.0f);
    vec3 metal_scale = vec3(1.0f);
    float transmittance = 1.0f;
    if (t.energy == kEnergyCompensated) {
        float albedo = compensation_albedo(s, p.NoV, dfg);
        dielectric_scale = multiple_scattering_scale(s.dielectric_f0, albedo);
        metal_scale = multiple_scattering_scale(s.base_color, albedo);
        transmittance =
            diffuse_transmittance((s.dielectric_f0 * dfg.x + dielectric_f90 * dfg.y) * dielectric_scale);
    }
    float dielectric = 1.0f - s.metallic;
    p.diffuse = s.base_color * (dielectric * transmittance);
    p.specular_f0 = s.dielectric_f0 * dielectric_scale * dielectric + s.base_color * metal_scale * s.metallic;
    p.specular_f90 = dielectric_f90 * dielectric_scale * dielectric + metal_f90 * metal_scale * s.metallic;
    return p;
}

FN float diffuse_lobe(BsdfTechniques t, float NoV, float NoL, float LoH, float perceptual_roughness) {
    if (t.diffuse == kDiffuseDisney) return Fd_Disney(NoV, NoL, LoH, perceptual_roughness);
    if (t.diffuse == kDiffuseDisneyRenormalized) {
        return Fd_DisneyRenormalized(NoV, NoL, LoH, perceptual_roughness);
    }
    return Fd_Lambert();
}

FN vec3 specular_fresnel(BsdfTechniques t, vec3 f0, vec3 f90, float LoH) {
    if (t.fresnel == kFresnelSphericalGaussian) return F_SphericalGaussian(f0, f90, LoH);
    return F_Schlick(f0, f90, LoH);
}

FN float specular_visibility(BsdfTechniques t, float NoV, float NoL, float perceptual_roughness,
                             float alpha) {
    if (t.specular_visibility == kVisibilitySchlickSmith) {
        return V_SchlickSmith(NoV, NoL, k_analytic(perceptual_roughness));
    }
    if (t.specular_visibility == kVisibilitySchlickSmithHalfAlpha) {
        return V_SchlickSmith(NoV, NoL, k_image_based(alpha));
    }
    if (t.specular_visibility == kVisibilityTeachingPage) return V_TeachingPage(NoV, k_analytic(perceptual_roughness));
    return V_SmithGGXCorrelated(NoV, NoL, alpha);
}

// D V of an isotropic lobe towards unit l, 1/sr, 0 below the horizon. distribution_alpha: for D; that of the surface, but for
// techniques of area lights that widen it.
FN float specular_lobe(BsdfTechniques t, vec3 n, vec3 v, vec3 l, float perceptual_roughness, float alpha,
                       float distribution_alpha) {
    float NoL = dot(n, l);
    if (NoL <= 0.0f) return 0.0f;
    return D_GGX(n, normalize(v + l), distribution_alpha) *
           specular_visibility(t, max(dot(n, v), 1.0e-4f), NoL, perceptual_roughness, alpha);
}

// Diffuse and specular part of f(v,l) in 1/sr, no cosine. sin2_NH: squared sine between n and h.
FN void evaluate_prepared(PreparedSurface p, BsdfTechniques t, float NoL, float NoH, float sin2_NH, float LoH,
                          OUT(vec3) diffuse, OUT(vec3) specular) {
    diffuse = p.diffuse * diffuse_lobe(t, p.NoV, NoL, LoH, p.perceptual_roughness);
    float d = D_GGX_cos2_sin2(NoH * NoH, sin2_NH, p.alpha);
    float v = specular_visibility(t, p.NoV, NoL, p.perceptual_roughness, p.alpha);
    specular = specular_fresnel(t, p.specular_f0, p.specular_f90, LoH) * (d * v);
}

// Dielectric and metal base in one call. dfg: table at (NoV, perceptual_roughness) of the same visibility
// (dfg.glsl); used for energy compensation only. Cosines in [0,1].
FN void evaluate_standard(Surface s, BsdfTechniques t, float NoV, float NoL, float NoH, float LoH, vec4 dfg,
                          OUT(vec3) diffuse, OUT(vec3) specular) {
    PreparedSurface p = prepare_surface(s, t, NoV, dfg);
    evaluate_prepared(p, t, NoL, NoH, (1.0f - NoH) * (1.0f + NoH), LoH, diffuse, specular);
}
// The same from unit vectors: at alpha below 0.01 NoH alone has too few bits (2 % of the energy at alpha
// 0.002), |n x h| has all.
FN void evaluate_standard(Surface s, BsdfTechniques t, vec3 n, vec3 v, vec3 l, vec4 dfg, OUT(vec3) diffuse,
                          OUT(vec3) specular) {
    vec3 h = normalize(v + l);
    vec3 c = cross(n, h);
    PreparedSurface p = prepare_surface(s, t, dot(n, v), dfg);
    evaluate_prepared(p, t, saturate(dot(n, l)), saturate(dot(n, h)), dot(c, c), saturate(dot(l, h)), diffuse,
                      specular);
}
FN vec3 evaluate_standard(Surface s, BsdfTechniques t, float NoV, float NoL, float NoH, float LoH, vec4 dfg) {
    vec3 diffuse;
    vec3 specular;
    evaluate_standard(s, t, NoV, NoL, NoH, LoH, dfg, diffuse, specular);
    return diffuse + specular;
}

// D V of the base, isotropic or along tangent and bitangent. An anisotropic lobe has the exact Smith
// visibility under either technique: there is no anisotropic form of Schlick's.
FN float base_specular_lobe(Surface s, BsdfTechniques t, PreparedSurface p, vec3 n, vec3 tangent,
                            vec3 bitangent, vec3 v, vec3 l, vec3 h, float NoL) {
    if (s.anisotropy == 0.0f) {
        return D_GGX(n, h, p.alpha) * specular_visibility(t, p.NoV, NoL, p.perceptual_roughness, p.alpha);
    }
    vec2 alpha = anisotropic_alpha(s.perceptual_roughness, s.anisotropy);
    float d = D_GGXAnisotropic(dot(n, h), dot(tangent, h), dot(bitangent, h), alpha.x, alpha.y);
    return d * V_SmithGGXCorrelatedAnisotropic(p.NoV, dot(tangent, v), dot(bitangent, v), NoL,
                                               dot(tangent, l), dot(bitangent, l), alpha.x, alpha.y);
}

// The coat's lobe in 1/sr, about the coat's own normal, with the visibility of the base.
FN float evaluate_coat(Surface s, BsdfTechniques t, vec3 coat_n, vec3 v, vec3 l) {
    float alpha = alpha_from_perceptual_roughness(s.coat_perceptual_roughness);
    return coat_reflectance(s.coat, max(dot(coat_n, v), 1.0e-4f)) *
           specular_lobe(t, coat_n, v, l, s.coat_perceptual_roughness, alpha, alpha);
}

// All lobes: base (isotropic or anisotropic) under sheen under coat, as KHR_materials_sheen and _clearcoat
// layer them. Diffuse and specular (with sheen and coat) part of f(v,l) in 1/sr, to be multiplied by NoL of
// n: the coat, which has its own normal, is scaled for that. Unit vectors; tangent and bitangent
// perpendicular to n.
FN void evaluate_layered(Surface s, BsdfTechniques t, vec3 n, vec3 tangent, vec3 bitangent, vec3 coat_n,
                         vec3 v, vec3 l, vec4 dfg, OUT(vec3) diffuse, OUT(vec3) specular) {
    diffuse = vec3(0.0f);
    specular = vec3(0.0f);
    float NoL = dot(n, l);
    if (NoL <= 0.0f) return;
    vec3 h = normalize(v + l);
    float LoH = saturate(dot(l, h));
    PreparedSurface p = prepare_surface(s, t, dot(n, v), dfg);
    diffuse = p.diffuse * diffuse_lobe(t, p.NoV, NoL, LoH, p.perceptual_roughness);
    specular = specular_fresnel(t, p.specular_f0, p.specular_f90, LoH) *
               base_specular_lobe(s, t, p, n, tangent, bitangent, v, l, h, NoL);
    if (max_component(s.sheen_color) > 0.0f) {
        float kept =
            sheen_transmittance(s.sheen_color, sheen_directional_albedo(p.NoV, s.sheen_perceptual_roughness));
        diffuse = diffuse * kept;
        specular = specular * kept + s.sheen_color * evaluate_sheen(p.NoV, NoL, saturate(dot(n, h)),
                                                                    s.sheen_perceptual_roughness);
    }
    if (s.coat > 0.0f) {
        float kept = coat_transmittance(s.coat, max(dot(coat_n, v), 1.0e-4f));
        float own_cosine = max(dot(coat_n, l), 0.0f) / max(NoL, 1.0e-4f);
        diffuse = diffuse * kept;
        specular = specular * kept + vec3(evaluate_coat(s, t, coat_n, v, l) * own_cosine);
    }
}
FN vec3 evaluate_layered(Surface s, BsdfTechniques t, vec3 n, vec3 tangent, vec3 bitangent, vec3 coat_n,
                         vec3 v, vec3 l, vec4 dfg) {
    vec3 diffuse;
    vec3 specular;
    evaluate_layered(s, t, n, tangent, bitangent, coat_n, v, l, dfg, diffuse, specular);
    return diffuse + specular;
}

// What multiplies the prefiltered radiance of the base's lobe: its directional albedo (split sum).
FN vec3 ibl_specular_weight(Surface s, BsdfTechniques t, float NoV, vec4 dfg) {
    PreparedSurface p = prepare_surface(s, t, NoV, dfg);
    return p.specular_f0 * dfg.x + p.specular_f90 * dfg.y;
}

// What multiplies irradiance / pi: the albedo of the diffuse part under the specular layer. dfg.z is the
// renormalized Disney model's; for the original one, which the table does not hold, this is scaled by the
// factor of the renormalization (see the overload with NoV for the exact value).
FN vec3 ibl_diffuse_weight(Surface s, BsdfTechniques t, vec4 dfg) {
    PreparedSurface p = prepare_surface(s, t, 1.0f, dfg);
    if (t.diffuse == kDiffuseLambert) return p.diffuse;
    if (t.diffuse == kDiffuseDisney)
        return p.diffuse * (dfg.z / mix(1.0f, 1.0f / 1.51f, s.perceptual_roughness));
    return p.diffuse * dfg.z;
}
FN vec3 ibl_diffuse_weight(Surface s, BsdfTechniques t, float NoV, vec4 dfg) {
    PreparedSurface p = prepare_surface(s, t, NoV, dfg);
    if (t.diffuse == kDiffuseLambert) return p.diffuse;
    if (t.diffuse == kDiffuseDisney) return p.diffuse * albedo_Disney(p.NoV, s.perceptual_roughness);
    return p.diffuse * albedo_DisneyRenormalized(p.NoV, s.perceptual_roughness);
}

// Weights of environment light for all lobes, consistent with evaluate_layered of image_based_form().
struct IblWeights {
    vec3 diffuse;   // on irradiance / pi
    vec3 specular;  // on radiance prefiltered with the base's roughness about n
    vec3 sheen;     // on radiance prefiltered with the sheen's lobe; irradiance / pi will do
    float coat;     // on radiance prefiltered with the coat's roughness about coat_n
};

// dfg: table at (NoV, perceptual_roughness); coat_dfg: at (coat_NoV, coat_perceptual_roughness).
FN IblWeights ibl_layered_weights(Surface s, BsdfTechniques t, float NoV, float coat_NoV, vec4 dfg,
                                  vec4 coat_dfg) {
    float sheen_albedo = sheen_directional_albedo(saturate(NoV), s.sheen_perceptual_roughness);
    float under_coat = coat_transmittance(s.coat, saturate(coat_NoV));
    float under_sheen = under_coat * sheen_transmittance(s.sheen_color, sheen_albedo);
    IblWeights w;
    w.diffuse = ibl_diffuse_weight(s, t, NoV, dfg) * under_sheen;
    w.specular = ibl_specular_weight(s, t, NoV, dfg) * under_sheen;
    w.sheen = s.sheen_color * (sheen_albedo * under_coat);
    w.coat = coat_reflectance(s.coat, saturate(coat_NoV)) * (coat_dfg.x + coat_dfg.y);
    return w;
}

CANDELA_SHADING_END

#endif
