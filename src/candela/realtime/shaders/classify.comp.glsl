#version 460
#extension GL_GOOGLE_include_directive : require
// Sorts 8 x 8 tiles into one list a shading class, so that each class is lit by its own pipeline, dispatched
// indirectly: nobody pays for lobes that are not on the screen (as Frostbite 3.2.2 sorts by material id).
#include "frame.glsl"
#include "gbuffer.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kOneClass = false;  // every surface is of the standard class: depth tells enough
layout(constant_id = 1) const bool kTileBounds = false;  // for the lists of lights
layout(set = 0, binding = 1) uniform usampler2D gbuffer_image;
layout(set = 0, binding = 2) uniform sampler2D depth_image;
layout(set = 0, binding = 3, std430) buffer Tiles {
    uvec4 dispatch[kClassCount];  // x = tiles in the list, y = z = 1
    uint list[];                  // kClassCount lists of tiles.z entries: x | y << 16
} tiles;

layout(set = 0, binding = 4, std430) writeonly buffer TileBounds { vec4 tile_bounds[]; };  // lowest, highest corner

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= uint(frame.tiles.z)) return;
    ivec2 tile = ivec2(int(index) % frame.tiles.x, int(index) / frame.tiles.x);
    uint classes = 0u;
    vec3 low = vec3(1.0e30);
    vec3 high = vec3(-1.0e30);
    for (int i = 0; i < 64; ++i) {
        ivec2 pixel = min(tile * 8 + ivec2(i & 7, i >> 3), frame.size.xy - 1);
        float depth = texelFetch(depth_image, pixel, 0).r;
        if (kOneClass) {
            classes |= depth == 0.0 ? 1u << kClassBackground : 1u << kClassStandard;
        } else {
            classes |= 1u << shading_class(depth, texelFetch(gbuffer_image, pixel, 0));
        }
        if (kTileBounds && depth != 0.0) {
            vec3 position = world_position(vec2(pixel) + 0.5, depth);
            low = min(low, position);
            high = max(high, position);
        }
    }
    if (kTileBounds) {
        tile_bounds[2u * index] = vec4(low, 0.0);
        tile_bounds[2u * index + 1u] = vec4(high, 0.0);
    }
    for (uint c = 0u; c < kClassCount; ++c) {
        if ((classes & (1u << c)) == 0u) continue;
        uint slot = atomicAdd(tiles.dispatch[c].x, 1u);
        tiles.list[c * uint(frame.tiles.z) + slot] = uint(tile.x) | uint(tile.y) << 16u;
    }
}
