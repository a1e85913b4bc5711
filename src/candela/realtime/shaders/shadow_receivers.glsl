// A texel of the receivers' image: a position in m, the facet's unit normal in 2 x 12 bits and in 8 bits how high the
// smooth surface about it may rise.
#ifndef CANDELA_SHADOW_RECEIVERS_GLSL
#define CANDELA_SHADOW_RECEIVERS_GLSL

#include "octahedral.glsl"

// Sixteenths of an octave from 2^-14 m (60 micrometres) to 4 m; 0 is flat.
const float kRiseSteps = 16.0;
const float kRiseOctaves = 14.0;

// Where the camera sees no surface.
const uvec4 kNoReceiver = uvec4(0u, 0u, 0u, 0xffffffffu);

uvec4 pack_receiver(vec3 position_m, vec4 facet) {
    vec2 oct = octahedral_encode(facet.xyz) * 0.5 + 0.5;
    uvec2 normal = uvec2(clamp(oct, vec2(0.0), vec2(1.0)) * 4095.0 + 0.5);
    float rise = facet.w > 0.0 ? clamp(ceil((log2(facet.w) + kRiseOctaves) * kRiseSteps), 1.0, 255.0) : 0.0;
    return uvec4(floatBitsToUint(position_m), normal.x | normal.y << 12u | uint(rise) << 24u);
}

void unpack_receiver(uvec4 texel, out vec3 position_m, out vec4 facet) {
    position_m = uintBitsToFloat(texel.xyz);
    vec2 oct = vec2(texel.w & 0xfffu, (texel.w >> 12u) & 0xfffu) * (2.0 / 4095.0) - 1.0;
    float rise = float(texel.w >> 24u);
    facet = vec4(octahedral_decode(oct), rise > 0.0 ? exp2(rise * (1.0 / kRiseSteps) - kRiseOctaves) : 0.0);
}

#endif
