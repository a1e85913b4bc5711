// What the lights of a list can be seen from a surface point: of opaque surfaces the visibility pass has found it before
// (shadow_visibility.comp.glsl); of blended ones it is looked up here.
#ifndef CANDELA_SHADOWS_GLSL
#define CANDELA_SHADOWS_GLSL

// C++: shadow_kind_bits(), what some light needs; ShadowFilterTechnique. What none needs is not compiled: a software device
// runs both sides of a branch.
#ifdef CANDELA_WITHOUT_SHADOWS
const uint kShadowKinds = 0u;
#else
layout(constant_id = 19) const uint kShadowKinds = 0u;
#endif
layout(constant_id = 20) const int kShadowFilter = 0;

#ifdef CANDELA_SHADOWS_BY_LOOKUP
#include "blended_shadows.glsl"
#else

// One byte a pixel and light, tile by tile (C++: ShadowVisibilityPass).
layout(set = 0, binding = 12, std430) readonly buffer Visibilities { uint visibilities[]; };

// Share of the light's illuminance that arrives.
float light_visibility(Light light, vec3 position_m, vec4 facet, vec3 l, ivec2 pixel) {
    if (kShadowKinds == 0u || light.links.z < 0) return 1.0;
    int tile = (pixel.y >> 3) * frame.tiles.x + (pixel.x >> 3);
    int quad = ((pixel.y >> 1) & 3) * 4 + ((pixel.x >> 1) & 3);
    uint word = visibilities[(light.links.z * frame.tiles.z + tile) * 16 + quad];
    return float(bitfieldExtract(word, ((pixel.y & 1) * 2 + (pixel.x & 1)) * 8, 8)) * (1.0 / 255.0);
}

#endif
#endif
