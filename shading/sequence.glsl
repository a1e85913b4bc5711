// Low-discrepancy points. Integer arithmetic only, so both languages give the same bits.
#ifndef CANDELA_SEQUENCE_GLSL
#define CANDELA_SEQUENCE_GLSL

#include "language.glsl"

CANDELA_SHADING_BEGIN

// Top 24 bits as a float in [0,1): all 32 would round up to 1.
FN float unit_float(uint x) {
    return float(x >> 8u) * (1.0f / 16777216.0f);
}

// Digits of i in base 2, mirrored at the point: van der Corput's sequence.
FN float radical_inverse_base2(uint i) {
    return unit_float(bitfieldReverse(i));
}

// Point i of n, i < n <= 2^24.
FN vec2 hammersley(uint i, uint n) {
    return vec2(float(i) / float(n), radical_inverse_base2(i));
}

// Bijective hash with good avalanche: PCG output function RXS-M-XS on one LCG step, Jarzynski & Olano 2020,
// "Hash Functions for GPU Rendering".
FN uint hash_uint(uint x) {
    uint state = x * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}
FN uint hash_combine(uint seed, uint x) {
    return hash_uint(seed ^ (x + 0x9e3779b9u + (seed << 6u) + (seed >> 2u)));
}

// Seed of a pixel: the sequence depends on pixel and seed alone.
FN uint pixel_seed(uvec2 pixel, uint seed) {
    return hash_combine(hash_combine(hash_uint(seed), pixel.x), pixel.y);
}

// Owen scrambling by a hash in which a bit depends only on those below it, on reversed bits: Laine & Karras
// 2011, Burley 2020 ("Practical Hash-based Owen Scrambling"), with Vegdahl's 2021 constants.
FN uint owen_scramble_reversed(uint x, uint seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16u) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}
FN uint owen_scramble(uint x, uint seed) {
    return bitfieldReverse(owen_scramble_reversed(bitfieldReverse(x), seed));
}

// Pascal's triangle modulo 2 on the bits of x, as a butterfly: read as a polynomial over GF(2), p(x) becomes p(1 + x),
// because (1 + x)^(2^k) = 1 + x^(2^k).
FN uint pascal_mod2(uint x) {
    x ^= (x >> 16u) & 0x0000ffffu;
    x ^= (x >> 8u) & 0x00ff00ffu;
    x ^= (x >> 4u) & 0x0f0f0f0fu;
    x ^= (x >> 2u) & 0x33333333u;
    x ^= (x >> 1u) & 0x55555555u;
    return x;
}

// Second dimension of Sobol's sequence (the first is the mirrored index): polynomial x + 1, direction numbers
// v_k = v_(k-1) ^ (v_(k-1) >> 1), which is row k of Pascal's triangle. Sobol 1967.
FN uint sobol_second(uint index) {
    return bitfieldReverse(pascal_mod2(index));
}

// Point `index` of the Owen-scrambled Sobol (0,2)-sequence with this seed, in [0,1)^2.
FN vec2 sobol_owen(uint index, uint seed) {
    uint x = owen_scramble_reversed(index, hash_combine(seed, 0u));
    uint y = owen_scramble_reversed(pascal_mod2(index), hash_combine(seed, 1u));
    return vec2(unit_float(bitfieldReverse(x)), unit_float(bitfieldReverse(y)));
}

// Independent 2D points for dimension pairs 0, 1, 2, ... of the same sample: the pairs are padded by
// shuffling the index with its own Owen scramble (Burley 2020, section 3).
FN vec2 sobol_owen_pair(uint index, uint pair, uint seed) {
    uint pair_seed = hash_combine(seed, pair + 2u);
    return sobol_owen(owen_scramble(index, hash_combine(pair_seed, 2u)), pair_seed);
}

CANDELA_SHADING_END

#endif
