// The shadows on blended surfaces: of every light of the list once, before they are lit, so that the code stands once in
// the shader. A surface point remembers the first kRememberedLights lights by their importance.
#ifndef CANDELA_BLENDED_SHADOWS_GLSL
#define CANDELA_BLENDED_SHADOWS_GLSL

layout(set = 0, binding = 11) uniform sampler2D shadow_atlas;
#include "shadow_lookup.glsl"

layout(set = 0, binding = 10, std430) readonly buffer ShadowRecords { ShadowRecord shadow_records[]; };

// Of kShadowKinds, beside 1 << kind: lights with extent.
const uint kShadowSoft = 8u;
const int kFilterPcss = 0;
const uint kSearchTaps = 12u;
const uint kFilterTaps = 16u;
const int kRememberedLights = 64;

uint remembered_visibility[kRememberedLights / 4];

float looked_up_visibility(Light light, vec3 position_m, vec4 facet, ivec2 pixel) {
    int first = light.links.z * kRecordsPerLight;
    int type = int(light.color_type.w);
    uint faces = shadow_records[first].faces.x + shadow_records[first].faces.y + shadow_records[first].faces.z;
    uint kind = faces == 0u ? kShadowPerspective : kShadowCube;
    if (type == kLightDirectional || type == kLightSun) {
        kind = kShadowCascades;
        int last = int(shadow_records[first].faces.w) - 1;
        float noise = shadow_noise(pixel, 3u);
        int i = 0;
        while (i < last && !cascade_holds(shadow_records[first + i], position_m, noise)) ++i;
        first += i;
    }
    ShadowRecord record = shadow_records[first];
    ShadowReceiver r = shadow_receiver(kind, record, position_m, facet);
    if (kind == kShadowPerspective && r.point.z <= record.numbers.y) return 1.0;
    int shape = int(record.extent.z);
    if (kShadowFilter != kFilterPcss || (kShadowKinds & kShadowSoft) == 0u || shape == kShapePoint) {
        return point_visibility(kind, record, r);
    }
    vec2 turn = vec2(shadow_noise(pixel, 0u), shadow_noise(pixel, 1u));
    Blockers found = kNoBlockers;
    search_blockers(kind, shape, record, r, 0u, kAlone, kSearchTaps, turn, shadow_noise(pixel, 2u), found);
    if (found.lookups == 0.0) return 1.0;
    float way = found.share / found.lookups;
    return filter_visibility(kind, shape, record, r, way, found.nearest, 0u, kAlone, kFilterTaps, turn.yx);
}

// at: of the first entry of the list (light_loop.glsl).
void remember_visibilities(uint at, vec3 position_m, vec4 facet, ivec2 pixel) {
    for (int i = 0; i < kRememberedLights / 4; ++i) remembered_visibility[i] = 0xffffffffu;
    uint entry = light_entries[at];
    while (entry != 0u) {
        Light light = lights[entry & 0xffffffu];
        int slot = light.links.z;
        if (slot >= 0 && slot < kRememberedLights) {
            uint byte = uint(looked_up_visibility(light, position_m, facet, pixel) * 255.0 + 0.5);
            int first = (slot & 3) * 8;
            remembered_visibility[slot >> 2] = bitfieldInsert(remembered_visibility[slot >> 2], byte, first, 8);
        }
        entry = light_entries[++at];
    }
}

float light_visibility(Light light, vec3 position_m, vec4 facet, vec3 l, ivec2 pixel) {
    int slot = light.links.z;
    if (kShadowKinds == 0u || slot < 0 || slot >= kRememberedLights) return 1.0;
    return float(bitfieldExtract(remembered_visibility[slot >> 2], (slot & 3) * 8, 8)) * (1.0 / 255.0);
}

#endif
