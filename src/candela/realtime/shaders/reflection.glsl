// What glossy lobes see of the environment, by the profile's technique: prefiltered light at one or more places.
#ifndef CANDELA_REFLECTION_GLSL
#define CANDELA_REFLECTION_GLSL

#include "layer_reflection.glsl"
#include "stretched_reflection.glsl"

const int kReflectionMirror = 0;
const int kReflectionDominant = 1;
const int kReflectionDominantFit = 2;
const int kReflectionFitted = 3;
const int kReflectionStretched2 = 4;
const int kReflectionStretched3 = 5;
const int kIrradianceDominant = 1;

// Prefiltered environment about a direction that need not be unit, in cd/m^2.
vec3 environment_glossy(vec3 direction, float perceptual_roughness) {
    return sample_specular_ld(specular_map_ld, to_environment(direction), perceptual_roughness) * frame.environment.z;
}
vec3 environment_glossy(LobeRead read) {
    return environment_glossy(read.direction, read.perceptual_roughness) * read.weight;
}

// Of a lobe about n: moved to where the lobe is above the surface.
LobeRead read_above_surface(LobeRead read, vec3 n, vec3 surface_normal) {
    if (!kNormalMapped) return read;
    float alpha = alpha_from_perceptual_roughness(read.perceptual_roughness);
    read.direction = direction_above_surface(read.direction, n, surface_normal, alpha);
    return read;
}
vec3 environment_glossy(LobeRead read, vec3 n, vec3 surface_normal) {
    return environment_glossy(read_above_surface(read, n, surface_normal));
}

// Seen in the lobe D V F cos of n and v, in cd/m^2: the first factor of the split sum. share: fresnel_share() of the lobe.
vec3 environment_specular(vec3 n, vec3 surface_normal, vec3 v, float NoV, float perceptual_roughness, float share) {
    LobeRead a;
    LobeRead b;
    LobeRead c;
    if (kReflection == kReflectionFitted) {
        return environment_glossy(fitted_reflection(n, v, NoV, perceptual_roughness, share), n, surface_normal);
    }
    if (kReflection == kReflectionStretched2) {
        stretched_reflection_2(n, v, NoV, perceptual_roughness, share, a, b);
        return environment_glossy(a, n, surface_normal) + environment_glossy(b, n, surface_normal);
    }
    if (kReflection == kReflectionStretched3) {
        stretched_reflection_3(n, v, NoV, perceptual_roughness, share, a, b, c);
        return environment_glossy(a, n, surface_normal) + environment_glossy(b, n, surface_normal) +
               environment_glossy(c, n, surface_normal);
    }
    LobeRead read = LobeRead(2.0 * dot(n, v) * n - v, perceptual_roughness, 1.0);
    float alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    if (kReflection == kReflectionDominant) {
        read.direction = specular_dominant_direction(n, read.direction, alpha);
    } else if (kReflection == kReflectionDominantFit) {
        read.direction = specular_dominant_direction_fit(n, read.direction, NoV, alpha);
    }
    if (kNormalMapped) read.direction = normalize(read.direction);
    return environment_glossy(read, n, surface_normal);
}

vec3 environment_anisotropic(SurfacePoint p) {
    vec2 alpha = anisotropic_alpha(p.g.surface.perceptual_roughness, p.g.surface.anisotropy);
    AnisotropicLobe lobe = anisotropic_lobe(p.g.normal, p.g.tangent, p.bitangent, p.v, p.NoV, alpha);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < kAnisotropicReads; ++i) {
        LobeRead read = anisotropic_read(lobe, i);
        sum += environment_glossy(read, p.g.normal, p.g.surface_normal);
        weights += read.weight;
    }
    return sum / max(weights, 1.0e-6);
}

float base_fresnel_share(SurfacePoint p) {
    return fresnel_share(luminance(p.prepared.specular_f0), luminance(p.prepared.specular_f90), p.dfg.xy);
}

// Part of a lobe's light that would not be there without the rise of Fresnel's reflectance from f0 to f90.
float fresnel_rise(float f0, float f90, vec2 ab) {
    float rise = max(f90 - f0, 0.0) * ab.y;
    return rise / max(f0 * (ab.x + ab.y) + rise, 1.0e-6);
}
float base_fresnel_rise(SurfacePoint p) {
    return fresnel_rise(luminance(p.prepared.specular_f0), luminance(p.prepared.specular_f90), p.dfg.xy);
}

// Seen in the base's lobe. What the papers have no technique for is as if isotropic with theirs.
vec3 environment_base(SurfacePoint p) {
    if (kShadeLayers && kReflection >= kReflectionFitted && p.g.surface.anisotropy > 0.0) return environment_anisotropic(p);
    return environment_specular(p.g.normal, p.g.surface_normal, p.v, p.NoV, p.g.surface.perceptual_roughness, base_fresnel_share(p));
}

// Seen in the sheen's lobe.
vec3 environment_sheen(SurfacePoint p, vec3 irradiance_over_pi) {
    if (kReflection < kReflectionFitted || max_component(p.g.surface.sheen_color) <= 0.0) return irradiance_over_pi;
    return environment_glossy(sheen_read(p.g.normal, p.v, p.NoV, p.g.surface.sheen_perceptual_roughness));
}

// Irradiance / pi as a diffuse surface sees it.
vec3 environment_diffuse(vec3 n, vec3 v, float NoV, float perceptual_roughness) {
    vec3 direction = n;
    if (kIrradiance == kIrradianceDominant && kDiffuse != kDiffuseLambert) {
        direction = diffuse_dominant_direction(n, v, NoV, perceptual_roughness);
    }
    return sample_irradiance(irradiance_map, to_environment(direction)) * frame.environment.z;
}

#endif
