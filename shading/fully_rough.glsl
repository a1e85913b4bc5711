// Surfaces that are shaded without a specular lobe, to save its cost.
// Source: Karis 2014, "Environment BRDF".
#ifndef CANDELA_FULLY_ROUGH_GLSL
#define CANDELA_FULLY_ROUGH_GLSL

#include "bsdf.glsl"
#include "dfg.glsl"

CANDELA_SHADING_BEGIN

// The surface with roughness 1 whose f0 has moved into the diffuse colour, by 0.45: what EnvBRDFApprox is at roughness 1, for all
// angles. It has no specular lobe under any light, and no layers: what they would add is specular, too.
FN Surface fully_rough_surface(Surface s) {
    vec3 diffuse = s.base_color * (1.0f - s.metallic);
    vec3 f0 = mix(s.dielectric_f0, s.base_color, s.metallic);
    Surface r = s;
    r.base_color = min(fully_rough_color(diffuse, f0), vec3(1.0f));
    r.metallic = 0.0f;
    r.perceptual_roughness = 1.0f;
    r.dielectric_f0 = vec3(0.0f);
    r.dielectric_f90 = vec3(0.0f);
    r.coat = 0.0f;
    r.sheen_color = vec3(0.0f);
    r.anisotropy = 0.0f;
    return r;
}

CANDELA_SHADING_END

#endif
