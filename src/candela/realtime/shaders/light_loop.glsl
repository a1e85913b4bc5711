// The direct light of a list of lights that is sorted by kind: one loop a kind or group of kinds, compiled in only if the scene
// has it.
#ifndef CANDELA_LIGHT_LOOP_GLSL
#define CANDELA_LIGHT_LOOP_GLSL

#include "punctual_lights.glsl"
#include "area_lights.glsl"

// A list is entries of index | (kind + 1) << 24 and ends with 0 (C++: light_entries). 0 because lavapipe reads 0 into the
// lanes of a fragment shader that no triangle covers, and still waits for them at the end of a loop. The loop's condition
// stands at its end because lavapipe runs the body once more, masked, where it stands at the beginning.
#define ADD_LIGHTS_OF(kind, add_light)                                                      \
    if ((kLightKinds & (1u << uint(kind))) != 0u && entry >> 24u == uint(kind) + 1u) {      \
        do {                                                                                \
            add_light(kind, lights[entry & 0xffffffu], p, lit);                             \
            entry = light_entries[++at];                                                    \
        } while (entry >> 24u == uint(kind) + 1u);                                          \
    }

// The same for a group of kinds that share their code.
#define ADD_LIGHTS_OF_GROUP(group, first, last)                                                                   \
    if ((kLightKinds & ((2u << uint(last)) - (1u << uint(first)))) != 0u &&                                       \
        (entry >> 24u) - uint(first) - 1u <= uint(last - first)) {                                                \
        do {                                                                                                      \
            add_area_light(group, int(entry >> 24u) - 1, lights[entry & 0xffffffu], p, lit);                      \
            entry = light_entries[++at];                                                                          \
        } while ((entry >> 24u) - uint(first) - 1u <= uint(last - first));                                        \
    }

// at: of the list's first entry.
void add_lights(SurfacePoint p, uint at, inout Lit lit) {
    uint entry = light_entries[at];
    ADD_LIGHTS_OF(kLightPoint, add_punctual_light)
    ADD_LIGHTS_OF(kLightSpot, add_punctual_light)
    ADD_LIGHTS_OF(kLightDirectional, add_punctual_light)
    ADD_LIGHTS_OF(kLightFrustum, add_punctual_light)
#ifndef CANDELA_WITHOUT_AREA_LIGHTS
    if ((kLightKinds & kAreaKinds) != 0u) {
        prepare_area_lights(p);
        ADD_LIGHTS_OF_GROUP(kCapsules, kLightLine, kLightTube)
        ADD_LIGHTS_OF_GROUP(kEllipses, kLightSun, kLightDisk)
        ADD_LIGHTS_OF_GROUP(kPolygons, kLightRectangle, kLightTriangle)
    }
#endif
    ADD_LIGHTS_OF(kLightPhotometric, add_punctual_light)
}

// Which list holds for a pixel. Lists are made for tiles of the opaque surfaces and for cells of the space in front of
// them, where the blended ones are; C++: LightLists.
uint lights_of_tile(uvec2 tile) {
    if (!kCulledLights) return uint(frame.lights.x);
    return light_entries[uint(kFirstTileList) + tile.y * uint(frame.tiles.x) + tile.x];
}
uint lights_of_cell(vec2 pixel, vec3 position) {
    if (!kCulledLights) return uint(frame.lights.x);
    float depth_m = dot(frame.camera_position.xyz - position, frame.camera_backward.xyz);
    ivec3 cell = ivec3(ivec2(pixel) / kCellSize, light_slice(depth_m));
    cell = min(cell, frame.light_cells.xyz - 1);
    int index = (cell.z * frame.light_cells.y + cell.y) * frame.light_cells.x + cell.x;
    return light_entries[frame.light_cells.w + index];
}

#endif
