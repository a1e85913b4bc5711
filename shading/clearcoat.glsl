// A clear lacquer of index 1.5 over everything else: KHR_materials_clearcoat.
#ifndef CANDELA_CLEARCOAT_GLSL
#define CANDELA_CLEARCOAT_GLSL

#include "fresnel.glsl"

CANDELA_SHADING_BEGIN

CONSTANT float kCoatF0 = 0.04f;

// Part of the light that the coat reflects, towards a viewer at coat_NoV to the coat's own normal. coat in
// [0,1]. KHR_materials_clearcoat takes Fresnel at the normal, not at the half-vector, so that what the coat
// takes from the layers below and what it adds are the same number.
FN float coat_reflectance(float coat, float coat_NoV) {
    return coat * F_Schlick(kCoatF0, 1.0f, coat_NoV);
}

// What is left for the layers below.
FN float coat_transmittance(float coat, float coat_NoV) {
    return 1.0f - coat_reflectance(coat, coat_NoV);
}

CANDELA_SHADING_END

#endif
