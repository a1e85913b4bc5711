// How the frame reads bake::EnvironmentMaps. Directions are in the environment's own frame and need not be unit.
#ifndef CANDELA_ENVIRONMENT_MAPS_GLSL
#define CANDELA_ENVIRONMENT_MAPS_GLSL

#include "environment.glsl"
#include "octahedral_map.glsl"
#include "specular_levels.glsl"

// C++: kIrradianceSize in environment.cpp.
const float kIrradianceSize = 32.0;

// One of the two levels that are side by side on each mip.
vec3 sample_specular_level(sampler2D map, vec2 encoded, float level) {
    float mip = floor(0.5 * level);
    float texel = exp2(mip) / float(kSpecularSize);
    vec2 within = (encoded * 0.5 + 0.5) * (1.0 - 2.0 * texel) + texel;
    return textureLod(map, vec2(0.5 * within.x + (level - 2.0 * mip) * 0.5, within.y), mip).rgb;
}

// Two explicit fetches: the gutters differ from level to level, so the hardware's own blend between mips would read beside the
// place.
vec3 sample_specular_ld(sampler2D map, vec3 direction, float perceptual_roughness) {
    vec2 encoded = octahedral_encode(direction);
    float finer = specular_finer_level(perceptual_roughness);
    return mix(sample_specular_level(map, encoded, finer), sample_specular_level(map, encoded, finer + 1.0),
               specular_level_blend(perceptual_roughness, finer));
}

vec3 sample_irradiance(sampler2D map, vec3 direction) {
    return sample_octahedral(map, octahedral_encode(direction), kIrradianceSize, 0.0);
}

vec3 sample_background(sampler2D map, vec3 direction) { return textureLod(map, equirect_uv_fast(direction), 0.0).rgb; }

#endif
