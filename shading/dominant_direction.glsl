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

// Closer to where the lobe of height-correlated Smith really peaks, but worse in the split sum, its authors say. Lagarde &
// de Rousiers 2014, section 4.9.3, listing 21. `alpha` in [0,1]; not normalised.
FN vec3 specular_dominant_direction_fit(vec3 n, vec3 mirror, float NoV, float alpha) {
    float base = 0.298475f * log(39.4115f - 39.0029f * alpha);
    float toward_mirror = pow(1.0f - NoV, 10.8649f) * (1.0f - base) + base;
    return mix(n, mirror, toward_mirror);
}

// Where the retro-reflective Disney diffuse lobe leans, for reading irradiance. Lagarde & de Rousiers 2014, section 4.9.3,
// listing 23; by its naming the listing's roughness is alpha, but its numbers fit the lobe's peak for perceptual roughness. Not
// normalised.
FN vec3 diffuse_dominant_direction(vec3 n, vec3 v, float NoV, float perceptual_roughness) {
    float slope = 1.02341f * perceptual_roughness - 1.51174f;
    float offset = 0.755868f - 0.511705f * perceptual_roughness;
    return mix(n, v, saturate((NoV * slope + offset) * perceptual_roughness));
}

// The version for area lights. Lagarde & de Rousiers 2014, section 4.7.5, listing 16. `alpha` in [0,1]; unit length.
FN vec3 specular_dominant_direction_area(vec3 n, vec3 mirror, float alpha) {
    return normalize(mix(n, mirror, 1.0f - alpha));
}

CANDELA_SHADING_END

#endif
