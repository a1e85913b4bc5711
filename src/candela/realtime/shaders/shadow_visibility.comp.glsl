#version 460
#extension GL_GOOGLE_include_directive : require
// How much of one light each pixel sees: a byte a pixel, an invocation a square of four. A pass of its own for each light,
// so that its record is the same for all invocations and the code is that of its kind and shape alone.
#include "frame.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kKind = 0u;
layout(constant_id = 1) const int kShape = 0;
layout(constant_id = 2) const bool kContact = false;

layout(set = 0, binding = 2) uniform sampler2D shadow_atlas;
#include "shadow_lookup.glsl"
#include "shadow_receivers.glsl"

layout(set = 0, binding = 1, std140) uniform Records { ShadowRecord records[kRecordsPerLight]; };
layout(set = 0, binding = 3) uniform usampler2D receiver_image;
layout(set = 0, binding = 4, std430) writeonly buffer Visibilities { uint visibilities[]; };
layout(push_constant) uniform Area {
    ivec4 tiles;  // x, y first; z, w one after the last
    int slot;
} area;

#include "contact_shadow.glsl"

// Of each pixel of a square; what they find is for all four.
const uint kSearchTaps = 3u;
const uint kFilterTaps = 8u;
// Gradients that are wider than that many pixels are smooth within a square.
const float kSmooth_px = 8.0;
// How far along the way blockers are looked for where the search told nothing: near, for that is what it misses.
const float kNearWay = 0.1;

ivec2 pixel_of(ivec2 corner, uint i) { return min(corner + ivec2(i & 1u, i >> 1u), frame.size.xy - 1); }

ShadowRecord record_for(vec3 position_m, ivec2 pixel) {
    ShadowRecord r = records[0];
    if (kKind != kShadowCascades) return r;
    int count = int(records[0].faces.w);
    float noise = shadow_noise(pixel, 3u);
    bool held = false;
    for (int i = 0; i < kRecordsPerLight - 1; ++i) {
        held = held || i >= count - 1 || cascade_holds(records[i], position_m, noise);
        ShadowRecord next = records[i + 1];
        // The rest is the same for all cascades.
        r.right.w = held ? r.right.w : next.right.w;
        r.up.w = held ? r.up.w : next.up.w;
        r.texels = held ? r.texels : next.texels;
        r.numbers = held ? r.numbers : next.numbers;
    }
    return r;
}

bool is_receiver(ivec2 pixel) { return texelFetch(receiver_image, pixel, 0).w != kNoReceiver.w; }

ShadowReceiver receiver_at(ivec2 pixel, out ShadowRecord record) {
    vec3 position_m;
    vec4 facet;
    unpack_receiver(texelFetch(receiver_image, pixel, 0), position_m, facet);
    record = record_for(position_m, pixel);
    return shadow_receiver(kKind, record, position_m, facet);
}

bool behind_light(ShadowRecord record, ShadowReceiver r) {
    return kKind == kShadowPerspective && r.point.z <= record.numbers.y;
}

uint in_byte(float visibility, uint i) { return uint(visibility * 255.0 + 0.5) << (8u * i); }

uint point_square(ivec2 corner) {
    uint bytes = 0u;
    for (uint i = 0u; i < 4u; ++i) {
        ShadowRecord record;
        ShadowReceiver r = receiver_at(pixel_of(corner, i), record);
        bytes |= in_byte(behind_light(record, r) ? 1.0 : point_visibility(kKind, record, r), i);
    }
    return bytes;
}

// How wide the gradient is that blockers at that share of the way throw, m.
float penumbra_width_m(float way) {
    float size_m = records[0].extent.x + records[0].extent.y;
    return size_m * (kKind == kShadowCascades ? way : way / max(1.0 - way, 0.05));
}

// How much of a square's mean its pixels may take for their own: all of it where the penumbra is wide, nothing where they
// show different surfaces.
float smoothness(vec3 first_m, vec3 normal, vec3 last_m, float penumbra_m) {
    vec3 across = last_m - first_m;
    float across_m = length(across);
    float px = penumbra_m / max(across_m * 0.7071, 1e-9);
    bool one_surface = abs(dot(across, normal)) < 0.25 * across_m;
    return one_surface ? clamp((px - 2.0) / (kSmooth_px - 2.0), 0.0, 1.0) : 0.0;
}

// Lookups of pixel i of a square for what is in the way; above += how many looked at a part of the light that is above the
// pixel's horizon: what is below it neither lights nor tells of the rest; lit += how many of those found that nothing is. Two of them towards
// the light's edge, of which the four pixels see eight points: what hides a little of the light, or leaves a little of it,
// covers or leaves more of its edge than of its area. One within, for what is smaller than the light.
void search_square(ShadowRecord record, ShadowReceiver r, uint i, vec2 turn, float shift, bool receives,
                   inout Blockers found, inout vec2 above) {
    ShadowExtent e = shadow_extent(kShape, record, r.to_light);
    float farthest = kKind == kShadowCascades ? r.point.z : 0.95;
    for (uint k = 0u; k < kSearchTaps; ++k) {
        bool edge = k + 1u < kSearchTaps;
        vec2 p = turned(fract(edge ? float(4u * k + i) * 0.125 * 3.0 + turn.x : float(i) * 0.25 + turn.y));
        if (!is_round(kShape)) p /= max(abs(p.x), abs(p.y));
        if (!edge) p *= 0.5;
        if (dot(r.normal, r.to_light + p.x * e.x + p.y * e.y) < 0.0) p = -p;
        vec3 to_point = r.to_light + p.x * e.x + p.y * e.y;
        float depth = fract(float(4u * k + i) * kSpreadAlong + shift);
        // Distant lights: what is in the way is mostly near for how deep the scene is. Others: an edge is looked at best
        // from behind what hides it.
        float way = farthest * (kKind == kShadowCascades ? depth * depth : edge ? 0.25 + 0.75 * depth : depth);
        bool narrow = spread_texels(kKind, r, e, way) < kNarrowTexels;
        Sight s = look(kKind, record, r, r.point + way * to_point, vec2(0.0), narrow, 1e30);
        bool counts = receives && dot(r.normal, to_point) > 0.0;
        s.hides = s.hides && counts;
        add_sight(s, found);
        above += vec2(counts ? 1.0 : 0.0, counts && s.tells && !s.hides ? 1.0 : 0.0);
    }
}

// What no lookup found anything in the way of is lit, what all found something in the way of is dark; lookups at what is below the
// horizon say neither. Only
// the others are filtered: a device that masks what it does not need runs the loops' bodies once instead.
uint soft_square(ivec2 corner) {
    vec2 turn = vec2(shadow_noise(corner >> 1, 0u), shadow_noise(corner >> 1, 1u));
    float shift = shadow_noise(corner >> 1, 2u);
    Blockers found = kNoBlockers;
    vec2 above = vec2(0.0);
    float lookups = 0.0;
    for (uint i = 0u; i < 4u; ++i) {
        ivec2 pixel = pixel_of(corner, i);
        ShadowRecord record;
        ShadowReceiver r = receiver_at(pixel, record);
        bool receives = is_receiver(pixel);
        search_square(record, r, i, turn, shift, receives, found, above);
        lookups += receives ? float(kSearchTaps) : 0.0;
    }
    if (above.x == 0.0) return 0u;
    // Where some pixels face away, as at the inner edge of a room, the others had few lookups.
    if (above.y == lookups) return 0xffffffffu;
    bool partly = found.lookups < lookups;
    float way = found.lookups > 0.0 ? found.share / found.lookups : kNearWay;
    uint bytes = 0u;
    vec3 first_point = vec3(0.0);
    vec3 first_normal = vec3(0.0);
    vec3 last_point = vec3(0.0);
    bool whole = true;
    for (uint i = 0u; i < (partly ? 4u : 0u); ++i) {
        ivec2 pixel = pixel_of(corner, i);
        ShadowRecord record;
        ShadowReceiver r = receiver_at(pixel, record);
        float visibility = filter_visibility(kKind, kShape, record, r, way, found.nearest, i, kInSquare,
                                             partly ? kFilterTaps : 0u, turn.yx);
        bytes |= in_byte(behind_light(record, r) ? 1.0 : visibility, i);
        whole = whole && is_receiver(pixel);
        if (i == 0u) {
            first_point = r.point;
            first_normal = r.normal;
        }
        last_point = r.point;
    }
    vec4 own = unpackUnorm4x8(bytes);
    float mean = 0.25 * (own.x + own.y + own.z + own.w);
    float share = whole ? smoothness(first_point, first_normal, last_point, penumbra_width_m(way)) : 0.0;
    return packUnorm4x8(mix(own, vec4(mean), partly ? share : 0.0));
}

// What the last centimetres leave of what the map has found, for the four pixels of a square.
uint with_contact(ivec2 corner, uint bytes) {
    vec4 visibility = unpackUnorm4x8(bytes);
    uint out_bytes = 0u;
    for (uint i = 0u; i < 4u; ++i) {
        ivec2 pixel = pixel_of(corner, i);
        ShadowRecord record;
        ShadowReceiver r = receiver_at(pixel, record);
        vec3 position_m;
        vec4 facet;
        unpack_receiver(texelFetch(receiver_image, pixel, 0), position_m, facet);
        vec2 point = sqrt(shadow_noise(pixel, 5u)) * turned(shadow_noise(pixel, 4u));
        float left = contact_visibility(record, r, position_m, facet, point, shadow_noise(pixel, 6u));
        out_bytes |= in_byte(visibility.x * (behind_light(record, r) ? 1.0 : left), i);
        visibility = visibility.yzwx;
    }
    return out_bytes;
}

void main() {
    // A workgroup has four tiles in a row, an invocation a square of 2 x 2 pixels of one.
    ivec2 tile = area.tiles.xy + ivec2(gl_WorkGroupID.xy) * ivec2(4, 1) + ivec2(gl_LocalInvocationIndex >> 4u, 0);
    if (any(greaterThanEqual(tile, area.tiles.zw))) return;
    int quad = int(gl_LocalInvocationIndex & 15u);
    ivec2 corner = tile * 8 + 2 * ivec2(quad & 3, quad >> 2);
    uint bytes = kShape == kShapePoint ? point_square(corner) : soft_square(corner);
    if (kContact && bytes != 0u) bytes = with_contact(corner, bytes);
    visibilities[(area.slot * frame.tiles.z + tile.y * frame.tiles.x + tile.x) * 16 + quad] = bytes;
}
