// Lights one surface point: every punctual light, then the environment by split sum. The lighting pass and the forward
// pass both include this file, so a blended surface is lit by the same code as an opaque one.
#ifndef CANDELA_SHADE_GLSL
#define CANDELA_SHADE_GLSL

#include "gbuffer.glsl"
#include "lights.glsl"
#include "dfg.glsl"
#include "dominant_direction.glsl"
#include "occlusion.glsl"
#include "spherical_gaussian_lobe.glsl"
#include "surface_side.glsl"
#include "../../bake/shaders/environment_maps.glsl"

// The rows of the profile (C++: Profile).
layout(constant_id = 2) const int kDiffuse = 0;
layout(constant_id = 3) const int kVisibility = 0;
layout(constant_id = 4) const int kFresnel = 0;
layout(constant_id = 5) const int kEnergy = 0;
layout(constant_id = 6) const int kDfg = 0;
layout(constant_id = 7) const int kReflection = 0;
// What this variant has to do at all.
layout(constant_id = 8) const bool kShadeLayers = false;
layout(constant_id = 9) const uint kLightKinds = 0u;  // bit (1 << kind) of every kind of light in the scene
layout(constant_id = 10) const bool kHasEnvironment = false;

layout(constant_id = 16) const bool kCulledLights = false;
layout(constant_id = 17) const int kAreaDiffuse = 0;
layout(constant_id = 18) const int kAreaSpecular = 0;
layout(constant_id = 21) const int kIrradiance = 0;
layout(constant_id = 23) const int kSunSpecular = 0;
layout(constant_id = 24) const int kAreaDirection = 0;
layout(constant_id = 25) const bool kNormalMapped = false;  // some surface of the scene
const bool kHasLights = kLightKinds != 0u;

const int kDfgTable = 0;
const int kDfgNonmetal = 2;
// C++: SunSpecularTechnique.
const int kSunSpecularFull = 0;
const int kSunSpecularPrinted = 2;

layout(set = 0, binding = 1, std430) readonly buffer Lights { Light lights[]; };
layout(set = 0, binding = 2) uniform sampler2D dfg_table;
layout(set = 0, binding = 3) uniform sampler2D specular_map_ld;
layout(set = 0, binding = 4) uniform sampler2D irradiance_map;
layout(set = 0, binding = 5) uniform sampler2D background_map;
layout(set = 0, binding = 7, std430) readonly buffer LightEntries { uint light_entries[]; };
layout(set = 0, binding = 8, std430) readonly buffer LightTables { float light_tables[]; };
layout(set = 0, binding = 9) uniform sampler2D ltc_table;
// Of the whole set that the lighting and the forward pass share (C++: shading_set_layout).
const int kShadingBindings = 15;

#include "shadows.glsl"

// Luminance in cd/m^2, by the path that the light took.
struct Lit {
    vec3 direct_diffuse;
    vec3 direct_specular;
    vec3 indirect_diffuse;
    vec3 indirect_specular;
};

const Lit kNoLight = Lit(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));

BsdfTechniques techniques() { return BsdfTechniques(kDiffuse, kVisibility, kFresnel, kEnergy); }

vec4 directional_albedo(float NoV, float perceptual_roughness) {
    if (kDfg != kDfgTable) return dfg_approx(NoV, perceptual_roughness);
    return textureLod(dfg_table, dfg_uv(NoV, perceptual_roughness), 0.0);
}

// What area lights need of a surface point (prepare_area_lights).
struct AreaSurface {
    mat3 ltc;
    mat3 coat_ltc;
    float coat;          // times a coat's highlight: what it reflects
    float coat_albedo;   // of the coat's lobe without Fresnel
    float under_coat;    // what reaches the sheen
    float under_layers;  // what reaches the base
};

// A surface point and its viewer, with what does not depend on the light. v is a unit vector.
struct SurfacePoint {
    GBuffer g;
    PreparedSurface prepared;
    vec3 position;  // m, world
    vec3 v;
    vec3 bitangent;
    float NoV;
    vec4 dfg;
    AreaSurface area;
    vec4 facet;  // for shadows: unit normal of the surface itself, without normal maps; w: see light_visibility()
    ivec2 pixel;
};

SurfacePoint surface_point(GBuffer g, vec3 position, vec3 v) {
    SurfacePoint p;
    p.g = g;
    p.g.normal = normal_facing(g.normal, v);
    p.g.surface_normal = kNormalMapped ? normal_facing(g.surface_normal, v) : p.g.normal;
    if (kShadeLayers) {
        p.g.coat_normal = normal_facing(g.coat_normal, v);
        vec3 across = g.tangent - p.g.normal * dot(p.g.normal, g.tangent);
        p.g.tangent = across * inversesqrt(max(dot(across, across), 1.0e-12));
    }
    p.position = position;
    p.v = v;
    p.bitangent = kShadeLayers ? cross(p.g.normal, p.g.tangent) : vec3(0.0);
    p.NoV = clamp(dot(p.g.normal, v), 1.0e-4, 1.0);
    p.dfg = directional_albedo(p.NoV, g.surface.perceptual_roughness);
    p.prepared = prepare_surface(g.surface, techniques(), p.NoV, p.dfg);
    p.facet = vec4(p.g.normal, 0.0);
    p.pixel = ivec2(0);
    return p;
}

// Diffuse and specular part of the BSDF in 1/sr towards unit l, without the cosine. t: techniques(), or image_based_form() of
// them where the light is none of the scene's.
void evaluate(SurfacePoint p, BsdfTechniques t, vec3 l, float NoL, out vec3 diffuse, out vec3 specular) {
    if (kNormalMapped && !above_surface(p.g.surface_normal, l)) {
        diffuse = specular = vec3(0.0);
        return;
    }
    if (kShadeLayers) {
        evaluate_layered(p.g.surface, t, p.g.normal, p.g.tangent, p.bitangent, p.g.coat_normal, p.v, l, p.dfg,
                         diffuse, specular);
    } else {
        vec3 h = normalize(p.v + l);
        vec3 nxh = cross(p.g.normal, h);
        evaluate_prepared(p.prepared, t, NoL, saturate(dot(p.g.normal, h)), dot(nxh, nxh),
                          saturate(dot(l, h)), diffuse, specular);
    }
}

// What the base reflects of a lobe of luminance 1, without layers. EnvBRDFApprox is below 0 for a small f0 at roughness near 1.
vec3 base_specular_weight(SurfacePoint p) {
    if (kDfg == kDfgNonmetal && p.g.default_nonmetal && p.g.surface.metallic == 0.0) {
        return vec3(max_component(p.g.surface.dielectric_f90) > 0.0
                        ? env_brdf_approx_nonmetal(p.g.surface.perceptual_roughness, p.NoV)
                        : 0.0);
    }
    return max(ibl_specular_weight(p.g.surface, techniques(), p.NoV, p.dfg), vec3(0.0));
}

// The sun of Karis 2014: luminance per lx on a plane that faces it, in place of the whole BRDF.
vec3 sun_specular(SurfacePoint p, vec3 l) {
    vec3 mirror = 2.0 * dot(p.g.normal, p.v) * p.g.normal - p.v;
    float lobe = sun_lobe_gaussian(p.prepared.alpha, dot(mirror, l), dot(p.g.normal, l));
    return base_specular_weight(p) * (kSunSpecular == kSunSpecularPrinted ? kSunLobePrintedFactor * lobe : lobe);
}
// Layers are none of his model: they are shaded in full.
const bool kSunByLobe = kSunSpecular != kSunSpecularFull && !kShadeLayers;

#include "light_loop.glsl"
#include "local_light.glsl"

#include "reflection.glsl"

// Unit direction in which local light is read for the base's diffuse lobe.
vec3 diffuse_direction(SurfacePoint p) {
    if (kDiffuse == kDiffuseLambert) return p.g.normal;
    return normalize(diffuse_dominant_direction(p.g.normal, p.v, p.NoV, p.g.surface.perceptual_roughness));
}

LobeRead unit_read_above_surface(LobeRead read, vec3 n, vec3 surface_normal) {
    if (!kNormalMapped) return read;
    read = read_above_surface(read, n, surface_normal);
    read.direction = normalize(read.direction);
    return read;
}

// Local light in a lobe, read as the distant light is, but for three reads of it, which are two here. share: fresnel_share() of
// the lobe. distant: seen in it already; whole: by reads that are not the lobe's own.
vec3 local_reflection(SurfacePoint p, vec3 n, float NoV, float perceptual_roughness, float share, vec3 distant, bool whole) {
    LobeRead first = LobeRead(2.0 * dot(n, p.v) * n - p.v, perceptual_roughness, 1.0);
    LobeRead second = LobeRead(first.direction, perceptual_roughness, 0.0);
    vec3 first_distant = distant;
    vec3 second_distant = distant;
    float alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    if (kReflection >= kReflectionStretched2) {
        stretched_reflection_2(n, p.v, NoV, perceptual_roughness, share, first, second);
        first = unit_read_above_surface(first, n, p.g.surface_normal);
        second = unit_read_above_surface(second, n, p.g.surface_normal);
        if (kReflection == kReflectionStretched2 && !whole) {
            first_distant = environment_glossy(first.direction, first.perceptual_roughness);
            second_distant = environment_glossy(second.direction, second.perceptual_roughness);
        }
    } else if (kReflection == kReflectionFitted) {
        first = fitted_reflection(n, p.v, NoV, perceptual_roughness, share);
    } else if (kReflection == kReflectionDominantFit) {
        first.direction = normalize(specular_dominant_direction_fit(n, first.direction, NoV, alpha));
    } else if (kReflection == kReflectionDominant) {
        first.direction = normalize(specular_dominant_direction(n, first.direction, alpha));
    }
    if (kReflection < kReflectionStretched2) first = unit_read_above_surface(first, n, p.g.surface_normal);
    return local_specular(p.position, n, p.v, first, second, first_distant, second_distant);
}

void add_environment(SurfacePoint p, inout Lit lit) {
    GBuffer g = p.g;
    vec3 v = p.v;
    float NoV = p.NoV;
    vec4 dfg = p.dfg;
    float alpha = alpha_from_perceptual_roughness(g.surface.perceptual_roughness);
    float specular_visible = specular_occlusion(NoV, g.occlusion, alpha);
    vec3 irradiance_over_pi = environment_diffuse(g.normal, v, NoV, g.surface.perceptual_roughness);
    vec3 radiance = environment_base(p);
    if (kLocalLight != 0u) {
        irradiance_over_pi = local_irradiance(p.position, g.normal, v, diffuse_direction(p), irradiance_over_pi);
        bool whole = kShadeLayers && g.surface.anisotropy > 0.0;
        radiance = local_reflection(p, g.normal, NoV, g.surface.perceptual_roughness, base_fresnel_share(p), radiance, whole);
    }
    if (kNormalMapped) {
        irradiance_over_pi *= hemisphere_above_surface(dot(g.normal, g.surface_normal));
        radiance *= lobe_above_surface(2.0 * NoV * g.normal - v, g.normal, g.surface_normal, alpha, base_fresnel_rise(p));
    }
    if (!kShadeLayers) {
        lit.indirect_diffuse = ibl_diffuse_weight(g.surface, techniques(), NoV, dfg) * irradiance_over_pi * g.occlusion;
        lit.indirect_specular = base_specular_weight(p) * radiance * specular_visible;
        return;
    }
    float coat_NoV = max(dot(g.coat_normal, v), 1.0e-4);
    vec4 coat_dfg = directional_albedo(coat_NoV, g.surface.coat_perceptual_roughness);
    IblWeights w = ibl_layered_weights(g.surface, techniques(), NoV, coat_NoV, dfg, coat_dfg);
    vec3 coat_radiance = environment_specular(g.coat_normal, g.surface_normal, v, coat_NoV, g.surface.coat_perceptual_roughness, 0.0);
    if (kLocalLight != 0u) {
        coat_radiance = local_reflection(p, g.coat_normal, coat_NoV, g.surface.coat_perceptual_roughness, 0.0, coat_radiance,
                                        false);
    }
    if (kNormalMapped) {
        float coat_alpha = alpha_from_perceptual_roughness(g.surface.coat_perceptual_roughness);
        coat_radiance *= lobe_above_surface(2.0 * coat_NoV * g.coat_normal - v, g.coat_normal, g.surface_normal, coat_alpha,
                                            fresnel_rise(0.04, 1.0, coat_dfg.xy));
    }
    vec3 sheen = environment_sheen(p, irradiance_over_pi);
    if (kLocalLight != 0u && kReflection >= kReflectionFitted && max_component(g.surface.sheen_color) > 0.0) {
        LobeRead read = sheen_read(g.normal, v, NoV, g.surface.sheen_perceptual_roughness);
        LobeRead one = LobeRead(normalize(read.direction), read.perceptual_roughness, 1.0);
        sheen = local_specular(p.position, g.normal, v, one, LobeRead(one.direction, 1.0, 0.0), sheen, sheen);
    }
    lit.indirect_diffuse = w.diffuse * irradiance_over_pi * g.occlusion;
    // Each lobe hides behind what its own normal and width see.
    float coat_visible = specular_occlusion(coat_NoV, g.occlusion,
                                            alpha_from_perceptual_roughness(g.surface.coat_perceptual_roughness));
    lit.indirect_specular = max(w.specular, vec3(0.0)) * radiance * specular_visible +
                            w.coat * coat_radiance * coat_visible + w.sheen * sheen * g.occlusion;
}

// first_light: of the list that holds for this point (light_loop.glsl). facet: as light_visibility() has it, on the
// viewer's side; read only where shadows are looked up.
Lit shade(GBuffer g, vec3 position, vec3 v, uint first_light, vec4 facet, ivec2 pixel) {
    if (kCapturesProbe) g = captured_surface(g);
    SurfacePoint p = surface_point(g, position, v);
    p.facet = facet;
    p.pixel = pixel;
    Lit lit = kNoLight;
#ifdef CANDELA_SHADOWS_BY_LOOKUP
    if (kHasLights && kShadowKinds != 0u) remember_visibilities(first_light, position, facet, pixel);
#endif
    if (kHasLights) add_lights(p, first_light, lit);
    if (kHasEnvironment || kLocalLight != 0u) add_environment(p, lit);
    return lit;
}

#endif
