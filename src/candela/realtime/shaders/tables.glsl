// What the mode `integrate` reads beside the frame: one buffer of tables. C++: integrate_pass.cpp.
#ifndef CANDELA_TABLES_GLSL
#define CANDELA_TABLES_GLSL

#include "transfer.glsl"

// The same words under three types.
layout(set = 0, binding = 6, std430) readonly buffer TableQuads { uvec4 table_quads[]; };
layout(set = 0, binding = 6, std430) readonly buffer TableWords { uint table_words[]; };
layout(set = 0, binding = 6, std430) readonly buffer TableFloats { float table_floats[]; };

const uint kNoRecord = 0xffffffffu;

// The header: where each table begins, in quads but where said otherwise, and how long some are.
uint environment_first_float() { return table_quads[0].x; }
uint asked_first() { return table_quads[0].y; }
uint asked_count() { return table_quads[0].z; }
uint emitter_node_first() { return table_quads[0].w; }
uint emitter_node_count() { return table_quads[1].x; }
uint emitter_item_first() { return table_quads[1].y; }
uint emissive_triangle_first() { return table_quads[1].z; }
uint alpha_first() { return table_quads[1].w; }
uint texture_record_first() { return table_quads[2].x; }
uint texel_first_word() { return table_quads[2].y; }
uint ray_node_first() { return table_quads[2].z; }
uint ray_node_count() { return table_quads[2].w; }  // of the trees that rays start in; 0: nothing casts shadows
uint ray_triangle_first() { return table_quads[3].x; }
uint light_first() { return table_quads[3].y; }
uint profile_first() { return table_quads[3].z; }
uint profile_first_float() { return table_quads[3].w; }
uint ray_instance_first() { return table_quads[4].x; }
ivec2 environment_cells() { return ivec2(table_quads[4].yz); }

vec3 quad_vec3(uint index) { return uintBitsToFloat(table_quads[index].xyz); }

int wrapped(int i, int size, uint wrap) {
    if (wrap == 2u) return clamp(i, 0, size - 1);
    int period = wrap == 1u ? 2 * size : size;
    int m = i % period;
    m = m < 0 ? m + period : m;
    return m < size ? m : period - 1 - m;
}

// Level 0 of a texture at uv after its transform, RGB as stored or, with srgb, decoded before it is filtered.
vec4 packed_texel(uvec4 record, ivec2 at, bool srgb) {
    ivec2 size = ivec2(record.yz);
    ivec2 texel = ivec2(wrapped(at.x, size.x, record.w & 3u), wrapped(at.y, size.y, record.w >> 2u & 3u));
    vec4 c = unpackUnorm4x8(table_words[texel_first_word() + record.x + uint(texel.y * size.x + texel.x)]);
    return srgb ? vec4(linear_from_srgb(c.rgb), c.a) : c;
}
vec4 read_packed(uint texture_record, vec2 uv, bool srgb) {
    if (texture_record == kNoRecord) return vec4(1.0);
    uvec4 record = table_quads[texture_record_first() + texture_record];
    // Hostile coordinates must not overflow an int; beyond this a texture is noise anyway.
    vec2 at = clamp(uv, vec2(-1.0e6), vec2(1.0e6)) * vec2(record.yz);
    if ((record.w & 16u) != 0u) return packed_texel(record, ivec2(floor(at)), srgb);
    vec2 corner = floor(at - 0.5);
    vec2 fraction = at - 0.5 - corner;
    ivec2 low = ivec2(corner);
    vec4 upper = mix(packed_texel(record, low, srgb), packed_texel(record, low + ivec2(1, 0), srgb), fraction.x);
    vec4 lower = mix(packed_texel(record, low + ivec2(0, 1), srgb), packed_texel(record, low + ivec2(1, 1), srgb),
                     fraction.x);
    return mix(upper, lower, fraction.y);
}

// How much light goes through a triangle at barycentric coordinates of its second and third corner.
float transparency(uint alpha_record, vec2 at) {
    if (alpha_record == kNoRecord) return 0.0;
    uint first = alpha_first() + 3u * alpha_record;
    vec4 uv_ab = uintBitsToFloat(table_quads[first]);
    uvec4 rest = table_quads[first + 1u];
    vec3 weight = vec3(1.0 - at.x - at.y, at);
    vec2 uv = weight.x * uv_ab.xy + weight.y * uv_ab.zw + weight.z * uintBitsToFloat(rest.xy);
    float alpha = dot(weight, quad_vec3(first + 2u)) * read_packed(rest.z, uv, false).a;
    float cutoff = uintBitsToFloat(rest.w);
    if (cutoff >= 0.0) return alpha < cutoff ? 1.0 : 0.0;
    return 1.0 - clamp(alpha, 0.0, 1.0);
}

#endif
