// Which of the scene's emitters to draw light from at a point: a walk down a tree of bounds, at each step in proportion to
// what the two children are thought to give. C++: emitters.cpp.
#ifndef CANDELA_EMITTER_TREE_GLSL
#define CANDELA_EMITTER_TREE_GLSL

#include "lights/emission_cone.glsl"
#include "octahedral.glsl"
#include "tables.glsl"

const uint kEmitterLeaf = 0x80000000u;
const uint kEmitterTwoSided = 0x40000000u;
const uint kEmitterFirst = 0x3fffffffu;  // of a leaf its item, else the first item of the second child

uvec4 emitter_low(uint node) { return table_quads[emitter_node_first() + 3u * node]; }
uvec4 emitter_high(uint node) { return table_quads[emitter_node_first() + 3u * node + 1u]; }

float node_importance(uint node, vec3 position, vec3 n) {
    uvec4 high = emitter_high(node);
    uvec4 light = table_quads[emitter_node_first() + 3u * node + 2u];
    vec3 box_min = uintBitsToFloat(emitter_low(node).xyz);
    vec3 box_max = uintBitsToFloat(high.xyz);
    vec3 center = 0.5 * (box_min + box_max);
    vec2 cosines = unpackSnorm2x16(light.w);
    EmissionCone cone = EmissionCone(octahedral_decode(unpackSnorm2x16(light.z)), cosines.x, cosines.y,
                                     (high.w & kEmitterTwoSided) != 0u);
    return emission_importance(cone, uintBitsToFloat(light.x), uintBitsToFloat(light.y), box_max - center,
                               position - center, n);
}

// Probability that a walk which stands at a node goes on to the first child, the node after it; negative: neither.
float first_child_share(uint node, vec3 position, vec3 n) {
    float first = node_importance(node + 1u, position, n);
    float both = first + node_importance(emitter_low(node + 1u).w, position, n);
    return both > 0.0 ? first / both : -1.0;
}

// An item and its probability; 0: nothing here reaches the point. u in [0,1).
uint sample_emitter(vec3 position, vec3 n, float u, out float probability) {
    uint node = 0u;
    probability = 1.0;
    uint high = emitter_high(node).w;
    if ((high & kEmitterLeaf) != 0u && node_importance(node, position, n) <= 0.0) probability = 0.0;
    while ((high & kEmitterLeaf) == 0u) {
        float first = first_child_share(node, position, n);
        if (first < 0.0) {
            probability = 0.0;
            break;
        }
        if (u < first) {
            u = min(u / first, 0.99999994);
            probability *= first;
            ++node;
        } else {
            u = clamp((u - first) / (1.0 - first), 0.0, 0.99999994);
            probability *= 1.0 - first;
            node = emitter_low(node + 1u).w;
        }
        high = emitter_high(node).w;
    }
    return high & kEmitterFirst;
}

// Probability that sample_emitter() gives this item.
float emitter_probability(vec3 position, vec3 n, uint item) {
    uint node = 0u;
    float probability = 1.0;
    uint high = emitter_high(node).w;
    if ((high & kEmitterLeaf) != 0u && node_importance(node, position, n) <= 0.0) return 0.0;
    while ((high & kEmitterLeaf) == 0u) {
        float first = first_child_share(node, position, n);
        if (first < 0.0) return 0.0;
        bool in_first = item < (high & kEmitterFirst);
        probability *= in_first ? first : 1.0 - first;
        node = in_first ? node + 1u : emitter_low(node + 1u).w;
        high = emitter_high(node).w;
    }
    return probability;
}

#endif
