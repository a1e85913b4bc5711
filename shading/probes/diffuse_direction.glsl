// Where the retro-reflective diffuse lobe points.
#ifndef CANDELA_PROBES_DIFFUSE_DIRECTION_GLSL
#define CANDELA_PROBES_DIFFUSE_DIRECTION_GLSL

#include "../language.glsl"

CANDELA_SHADING_BEGIN

// Direction in which to read irradiance for Disney's diffuse lobe, which leans towards the viewer when rough. Lagarde & de
// Rousiers 2014, section 4.9.3, listing 23. Not normalised.
FN vec3 diffuse_dominant_direction(vec3 n, vec3 v, float NoV, float alpha) {
    float slope = 1.02341f * alpha - 1.51174f;
    float at_grazing = 0.755868f - 0.511705f * alpha;
    return mix(n, v, saturate((NoV * slope + at_grazing) * alpha));
}

CANDELA_SHADING_END

#endif
