#version 460
#extension GL_GOOGLE_include_directive : require
// Makes the light lists of 64 boxes: 8 x 8 tiles with what classify found in them, or 4 x 4 x 4 cells in front of the
// camera. The workgroup first keeps the lights that reach the box around all 64, one bit each; then every invocation goes
// through those, in order, for its own box. C++: CullPass; layout of the lists: light_lists.hpp.
#include "frame.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kCells = false;

struct LightReach {
    vec4 ball;  // centre, radius in m
    vec4 cone;  // unit axis, cosine of the half angle; below 0: no cone
};
layout(set = 0, binding = 1, std430) readonly buffer Reaches { LightReach reaches[]; };
layout(set = 0, binding = 2, std430) readonly buffer TileBounds { vec4 tile_bounds[]; };  // lowest, highest corner
layout(set = 0, binding = 3, std430) buffer LightEntries { uint light_entries[]; };

// C++: kMostCulledLights.
const uint kMostWords = 2048u;
shared uint near_lights[kMostWords];
shared vec3 lows[64];
shared vec3 highs[64];

struct Box {
    vec3 low;
    vec3 high;
};
bool is_empty(Box box) { return box.low.x > box.high.x; }

bool reaches_box(LightReach light, Box box) {
    vec3 center = 0.5 * (box.low + box.high);
    vec3 half_size = 0.5 * (box.high - box.low);
    vec3 to_center = center - light.ball.xyz;
    vec3 outside = max(abs(to_center) - half_size, vec3(0.0));
    bool near = dot(outside, outside) <= light.ball.w * light.ball.w;
    // The cone against the ball around the box: nearer to the cone's side than the ball's radius.
    float radius = length(half_size);
    float along = dot(to_center, light.cone.xyz);
    float across = sqrt(max(dot(to_center, to_center) - along * along, 0.0));
    float sine = sqrt(max(1.0 - light.cone.w * light.cone.w, 0.0));
    bool lit = light.cone.w < 0.0 || (light.cone.w * across - sine * along <= radius && along >= -radius);
    return near && lit;
}

vec3 cell_corner(vec2 pixel, float depth_m) {
    if (frame.camera_position.w > 0.5) {
        vec3 ray = frame.ray.xyz + (pixel.x - 0.5) * frame.ray_dx.xyz + (pixel.y - 0.5) * frame.ray_dy.xyz;
        return frame.camera_position.xyz + ray * depth_m;
    }
    vec3 p = world_position(pixel, 0.5);
    float p_m = dot(frame.camera_position.xyz - p, frame.camera_backward.xyz);
    return p - frame.camera_backward.xyz * (depth_m - p_m);
}

Box cell_box(ivec3 cell) {
    // A little more than the cell: its borders are found by a logarithm.
    float near = cell.z == 0 ? 0.0 : frame.light_slices.x * exp((float(cell.z) - 0.05) / frame.light_slices.y);
    float far = cell.z + 1 >= frame.light_cells.z
                    ? 1.0e6 : frame.light_slices.x * exp((float(cell.z) + 1.05) / frame.light_slices.y);
    Box box = Box(vec3(1.0e30), vec3(-1.0e30));
    for (int i = 0; i < 8; ++i) {
        vec2 pixel = vec2((cell.xy + ivec2(i & 1, i >> 1 & 1)) * kCellSize);
        vec3 corner = cell_corner(pixel, (i & 4) == 0 ? near : far);
        box.low = min(box.low, corner);
        box.high = max(box.high, corner);
    }
    return box;
}

// The box of this invocation and where its list's beginning is written; -1 outside the picture.
int own_box(out Box box) {
    uint i = gl_LocalInvocationIndex;
    box = Box(vec3(1.0e30), vec3(-1.0e30));
    if (kCells) {
        ivec3 cell = ivec3(gl_WorkGroupID) * 4 + ivec3(i & 3u, i >> 2u & 3u, i >> 4u);
        if (any(greaterThanEqual(cell, frame.light_cells.xyz))) return -1;
        box = cell_box(cell);
        return frame.light_cells.w + (cell.z * frame.light_cells.y + cell.y) * frame.light_cells.x + cell.x;
    }
    ivec2 tile = ivec2(gl_WorkGroupID.xy) * 8 + ivec2(i & 7u, i >> 3u);
    if (any(greaterThanEqual(tile, frame.tiles.xy))) return -1;
    int index = tile.y * frame.tiles.x + tile.x;
    box = Box(tile_bounds[2 * index].xyz, tile_bounds[2 * index + 1].xyz);
    return kFirstTileList + index;
}

Box box_around_all() {
    Box all = Box(lows[0], highs[0]);
    for (int i = 1; i < 64; ++i) {
        all.low = min(all.low, lows[i]);
        all.high = max(all.high, highs[i]);
    }
    return all;
}

uint count_lights(Box box, uint words) {
    uint count = 0u;
    for (uint w = 0u; w < words; ++w) {
        for (uint bits = near_lights[w]; bits != 0u; bits &= bits - 1u) {
            count += reaches_box(reaches[w * 32u + uint(findLSB(bits))], box) ? 1u : 0u;
        }
    }
    return count;
}

void write_lights(Box box, uint words, uint at) {
    for (uint w = 0u; w < words; ++w) {
        for (uint bits = near_lights[w]; bits != 0u; bits &= bits - 1u) {
            uint index = w * 32u + uint(findLSB(bits));
            if (!reaches_box(reaches[index], box)) continue;
            light_entries[at++] = light_entries[frame.lights.x + int(index)];
        }
    }
    light_entries[at] = 0u;
}

void main() {
    uint lights = uint(frame.size.z);
    uint words = (lights + 31u) / 32u;
    Box box;
    int head = own_box(box);
    lows[gl_LocalInvocationIndex] = box.low;
    highs[gl_LocalInvocationIndex] = box.high;
    barrier();
    Box all = box_around_all();
    for (uint w = gl_LocalInvocationIndex; w < words; w += 64u) {
        uint bits = 0u;
        for (uint i = 0u; i < 32u; ++i) {
            uint index = min(w * 32u + i, lights - 1u);
            if (w * 32u + i < lights && reaches_box(reaches[index], all)) bits |= 1u << i;
        }
        near_lights[w] = is_empty(all) ? 0u : bits;
    }
    barrier();
    if (head < 0) return;
    if (is_empty(box)) {
        light_entries[head] = uint(frame.lights.x) + lights;  // the end of the list of all
        return;
    }
    uint count = count_lights(box, words);
    uint at = atomicAdd(light_entries[0], count + 1u);
    // A box for which no room is left asks every light: slower, and the same picture.
    bool fits = at + count + 1u <= uint(frame.lights.z);
    light_entries[head] = uint(frame.lights.x) + (fits ? uint(frame.lights.y - frame.lights.x) + at : 0u);
    if (fits) write_lights(box, words, uint(frame.lights.y) + at);
}
