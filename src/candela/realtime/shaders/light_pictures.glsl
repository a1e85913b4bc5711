// The pictures that rectangles show. C++: ImagePyramid. Includers have light_tables[].
#ifndef CANDELA_LIGHT_PICTURES_GLSL
#define CANDELA_LIGHT_PICTURES_GLSL

#include "lights/rectangle_image.glsl"

vec3 picture_texel(int first, int index) {
    int at = first + 3 * index;
    return vec3(light_tables[at], light_tables[at + 1], light_tables[at + 2]);
}

vec3 read_picture_level(Light light, vec2 uv, int level) {
    PyramidTaps taps = pyramid_taps(uv, light.links.w, level);
    return picture_texel(light.links.y, taps.index.x) * taps.weight.x + picture_texel(light.links.y, taps.index.y) * taps.weight.y +
           picture_texel(light.links.y, taps.index.z) * taps.weight.z + picture_texel(light.links.y, taps.index.w) * taps.weight.w;
}

// spot: as rectangle_image_spot() has it. White where the light shows none.
vec3 read_picture(Light light, vec3 spot) {
    if (light.links.y < 0) return vec3(1.0);
    float level = pyramid_level_of_share(spot.z, light.links.w);
    int finer = int(level);
    int coarsest = int(log2(float(light.links.w)) + 0.5);
    return mix(read_picture_level(light, spot.xy, finer), read_picture_level(light, spot.xy, min(finer + 1, coarsest)),
               level - float(finer));
}

#endif
