// How the prefiltered light of an environment is laid out: octahedral maps of one roughness each, two of a size side by side on
// each mip of one image twice as wide as high.
#ifndef CANDELA_SPECULAR_LEVELS_GLSL
#define CANDELA_SPECULAR_LEVELS_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

CONSTANT int kSpecularLevels = 9;
CONSTANT int kSpecularSize = 512;  // of the finest two, gutters included

// Perceptual roughness that a level stands for. Own choice: evenly spaced, so that alpha grows as the square; Frostbite equation
// 63 spaces by the root of roughness, as reflection probes do (probe_ld()).
FN float specular_level_roughness(int level) { return float(level) / float(kSpecularLevels - 1); }

FN int specular_level_size(int level) { return kSpecularSize >> (level / 2); }

// The last level that is not rougher than asked for, and has one after it.
FN float specular_finer_level(float perceptual_roughness) {
    return min(floor(perceptual_roughness * float(kSpecularLevels - 1)), float(kSpecularLevels - 2));
}

// Share of the level after `finer` in the blend of the two. Even in alpha, because a lobe is as wide as its alpha: even in
// roughness shows an edge half sharp, half soft where it should be nearly sharp.
FN float specular_level_blend(float perceptual_roughness, float finer) {
    float level = perceptual_roughness * float(kSpecularLevels - 1);
    return (level * level - finer * finer) / (2.0f * finer + 1.0f);
}

CANDELA_SHADING_END

#endif
