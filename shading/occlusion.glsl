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

CANDELA_SHADING_END

#endif
