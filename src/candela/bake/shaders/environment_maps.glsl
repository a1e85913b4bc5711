// How the frame reads bake::EnvironmentMaps. Directions are in the environment's own frame and need not be unit.
#ifndef CANDELA_ENVIRONMENT_MAPS_GLSL
#define CANDELA_ENVIRONMENT_MAPS_GLSL

#include "environment.glsl"
#include "octahedral_map.glsl"

// C++: kSpecularSize and kIrradianceSize in environment.cpp.
const float kSpecularSize = 512.0;
const float kIrradianceSize = 32.0;

// Levels are linear in perceptual roughness. Two explicit fetches: the gutters differ from level to level, so the
// hardware's own blend between levels would read beside the place.
vec3 sample_specular_ld(sampler2D map, vec3 direction, float perceptual_roughness, int levels) {
    vec2 encoded = octahedral_encode(direction);
    float level = perceptual_roughness * float(levels - 1);
    float finer = min(floor(level), float(levels - 2));
    float size = kSpecularSize * exp2(-finer);
    vec3 a = sample_octahedral(map, encoded, size, finer);
    vec3 b = sample_octahedral(map, encoded, 0.5 * size, finer + 1.0);
    return mix(a, b, level - finer);
}

vec3 sample_irradiance(sampler2D map, vec3 direction) {
    return sample_octahedral(map, octahedral_encode(direction), kIrradianceSize, 0.0);
}

vec3 sample_background(sampler2D map, vec3 direction) { return textureLod(map, equirect_uv_fast(direction), 0.0).rgb; }

#endif
