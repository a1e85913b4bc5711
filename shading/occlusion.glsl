// Occlusion of indirect light.
#ifndef CANDELA_OCCLUSION_GLSL
#define CANDELA_OCCLUSION_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Specular occlusion from a diffuse ambient occlusion `ao` in [0,1]. Lagarde & de Rousiers 2014, section 4.10.2,
// listing 26's relation: ao itself on rough surfaces, weaker at normal incidence and stronger at grazing on smooth ones.
FN float specular_occlusion(float NoV, float ao, float alpha) {
    return saturate(pow(NoV + ao, exp2(-16.0f * alpha - 1.0f)) - 1.0f + ao);
}

// Part of a reflection about unit `reflection` that is above the surface where a normal map turns it below: the lobe as a
// disc whose radius is the sine of twice the half-vector's slope alpha. Candela's own estimate; surface_normal as in
// above_surface(), which is what it stands for.
FN float lobe_above_surface(vec3 reflection, vec3 surface_normal, float alpha) {
    float radius = clamp(2.0f * alpha, 0.01f, 1.0f);
    return saturate(0.5f + 0.5f * dot(reflection, surface_normal) / radius);
}

CANDELA_SHADING_END

#endif
