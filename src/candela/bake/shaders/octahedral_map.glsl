// Reading octahedral maps with gutters of one texel. C++: OctahedralMap.
#ifndef CANDELA_OCTAHEDRAL_MAP_GLSL
#define CANDELA_OCTAHEDRAL_MAP_GLSL

#include "octahedral.glsl"

// `encoded`: octahedral_encode(direction); `size`: texels a side of this level, gutters included.
vec3 sample_octahedral(sampler2D map, vec2 encoded, float size, float level) {
    return textureLod(map, (encoded * 0.5 + 0.5) * ((size - 2.0) / size) + 1.0 / size, level).rgb;
}

#endif
