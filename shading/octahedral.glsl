// Unit vectors as two numbers in [-1,1].
#ifndef CANDELA_OCTAHEDRAL_GLSL
#define CANDELA_OCTAHEDRAL_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// The sphere on the octahedron, its lower half folded over the diagonals: Cigolle et al. 2014, "A Survey of
// Efficient Representations for Independent Unit Vectors". v need not be unit, but not zero.
FN vec2 octahedral_encode(vec3 v) {
    float scale = 1.0f / (abs(v.x) + abs(v.y) + abs(v.z));
    float x = v.x * scale;
    float y = v.y * scale;
    if (v.z >= 0.0f) return vec2(x, y);
    return vec2((1.0f - abs(y)) * (x >= 0.0f ? 1.0f : -1.0f), (1.0f - abs(x)) * (y >= 0.0f ? 1.0f : -1.0f));
}

// Inverse of octahedral_encode; unit. The fold without branches is Rune Stubbe's.
FN vec3 octahedral_decode(vec2 e) {
    float z = 1.0f - abs(e.x) - abs(e.y);
    float fold = max(-z, 0.0f);
    return normalize(vec3(e.x - (e.x >= 0.0f ? fold : -fold), e.y - (e.y >= 0.0f ? fold : -fold), z));
}

// A point a little outside of the square [-1,1]^2, brought to where the sphere goes on across that edge.
FN vec2 octahedral_unfolded(vec2 e) {
    float x = e.x;
    float y = e.y;
    if (abs(x) > 1.0f) {
        x = (x > 0.0f ? 2.0f : -2.0f) - x;
        y = -y;
    }
    if (abs(y) > 1.0f) {
        y = (y > 0.0f ? 2.0f : -2.0f) - y;
        x = -x;
    }
    return vec2(x, y);
}

// octahedral_unfolded for texels, up to `size` of them outside of an edge: beyond it the octahedron goes on along the same edge,
// mirrored.
FN ivec2 octahedral_fold(ivec2 texel, int size) {
    int x = texel.x;
    int y = texel.y;
    if (x < 0 || x >= size) {
        x = (x < 0 ? -1 : 2 * size - 1) - x;
        y = size - 1 - y;
    }
    if (y < 0 || y >= size) {
        y = (y < 0 ? -1 : 2 * size - 1) - y;
        x = size - 1 - x;
    }
    return ivec2(x, y);
}

CANDELA_SHADING_END

#endif
