// Where a lobe points when it is not the mirror direction: the off-specular peak.
#ifndef CANDELA_DOMINANT_DIRECTION_GLSL
#define CANDELA_DOMINANT_DIRECTION_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Direction in which to read a prefiltered GGX environment. Lagarde & de Rousiers 2014, section 4.9.3, listing 22's
// blend between mirror direction and normal. `alpha` in [0,1]; not normalised.
FN vec3 specular_dominant_direction(vec3 n, vec3 mirror, float alpha) {
    float smoothness = saturate(1.0f - alpha);
    return mix(n, mirror, smoothness * (sqrt(smoothness) + alpha));
}

CANDELA_SHADING_END

#endif
