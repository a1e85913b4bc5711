// Directions drawn from an equirectangular picture in proportion to its luminance, texel by texel. Which texel is a
// search in a table (bake/environment_distribution.hpp) that each language does its own way; here is what a texel means.
#ifndef CANDELA_ENVIRONMENT_SAMPLING_GLSL
#define CANDELA_ENVIRONMENT_SAMPLING_GLSL

#include "environment.glsl"

CANDELA_SHADING_BEGIN

// Direction at `fraction` in [0,1)^2 of texel (column, row), uniform in solid angle: within a row the cosine of the
// polar angle is linear, not the angle. As a product of sines because the difference of cosines loses digits.
FN vec3 environment_texel_direction(ivec2 texel, vec2 fraction, ivec2 size) {
    float azimuth = ((float(texel.x) + fraction.x) / float(size.x) - 0.5f) * TWO_PI;
    float step = PI / float(size.y);
    float top = float(texel.y) * step;
    // 1 - cos of the polar angle keeps its digits at the upper pole; at the lower one a draw may read back as its neighbour.
    float above = 2.0f * square(sin(0.5f * top));
    float cap = above + fraction.y * 2.0f * sin(top + 0.5f * step) * sin(0.5f * step);
    float sine = sqrt(max(cap * (2.0f - cap), 0.0f));
    return vec3(sine * sin(azimuth), 1.0f - cap, -sine * cos(azimuth));
}

// Texel that holds the unit direction: the inverse of the above.
FN ivec2 environment_texel(vec3 unit_direction, ivec2 size) {
    vec2 uv = equirect_uv(unit_direction);
    return clamp(ivec2(int(uv.x * float(size.x)), int(uv.y * float(size.y))), ivec2(0), size - ivec2(1));
}

// Density in 1/sr of a texel that is drawn with probability `share`.
FN float environment_texel_pdf(float share, int row, ivec2 size) {
    return share / max(equirect_texel_solid_angle(uint(row), uint(size.x), uint(size.y)), 1.0e-20f);
}

// The four texels about a direction and where it lies between their centres: columns wrap around, rows end at the poles.
// The reading that the weights of bake/environment_distribution.hpp are integrals of.
struct BilinearTexels {
    ivec2 low;
    ivec2 high;
    vec2 fraction;
};
FN BilinearTexels environment_bilinear(vec3 unit_direction, ivec2 size) {
    vec2 at = equirect_uv(unit_direction) * vec2(float(size.x), float(size.y)) - vec2(0.5f);
    vec2 corner = floor(at);
    ivec2 low = ivec2(int(corner.x), int(corner.y));
    BilinearTexels t;
    t.low = ivec2((low.x + size.x) % size.x, clamp(low.y, 0, size.y - 1));
    t.high = ivec2((low.x + 1 + size.x) % size.x, clamp(low.y + 1, 0, size.y - 1));
    t.fraction = at - corner;
    return t;
}

CANDELA_SHADING_END

#endif
