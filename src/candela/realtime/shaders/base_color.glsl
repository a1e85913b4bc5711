// Set 1: one material, and what of it the passes need that only ask whether a surface is there. C++: MaterialBlock,
// Feature and TextureSlotName.
#ifndef CANDELA_BASE_COLOR_GLSL
#define CANDELA_BASE_COLOR_GLSL

#include "features.glsl"

layout(set = 1, binding = 0, std140) uniform Material {
    vec4 base_color;
    vec4 emissive_nit;
    vec4 specular_color;
    vec4 metallic_roughness;
    vec4 sheen;
    vec4 clearcoat_anisotropy;
    vec4 f0_rotation;
    vec4 uv[26];
} material;
layout(set = 1, binding = 1) uniform sampler2D base_color_map;
layout(set = 1, binding = 2) uniform sampler2D metallic_roughness_map;
layout(set = 1, binding = 3) uniform sampler2D normal_map;
layout(set = 1, binding = 4) uniform sampler2D occlusion_map;
layout(set = 1, binding = 5) uniform sampler2D emissive_map;
layout(set = 1, binding = 6) uniform sampler2D specular_map;
layout(set = 1, binding = 7) uniform sampler2D specular_color_map;
layout(set = 1, binding = 8) uniform sampler2D clearcoat_map;
layout(set = 1, binding = 9) uniform sampler2D clearcoat_roughness_map;
layout(set = 1, binding = 10) uniform sampler2D clearcoat_normal_map;
layout(set = 1, binding = 11) uniform sampler2D sheen_color_map;
layout(set = 1, binding = 12) uniform sampler2D sheen_roughness_map;
layout(set = 1, binding = 13) uniform sampler2D anisotropy_map;

layout(location = 2) in vec4 in_uv;
layout(location = 3) in vec4 in_color;

vec2 slot_uv(int slot) {
    vec4 u = material.uv[2 * slot];
    vec4 v = material.uv[2 * slot + 1];
    vec2 uv = has(kUv1) && u.w > 0.5 ? in_uv.zw : in_uv.xy;
    return vec2(u.x * uv.x + u.y * uv.y + u.z, v.x * uv.x + v.y * uv.y + v.z);
}

vec4 base_color_and_alpha() {
    vec4 c = material.base_color;
    if (has(kBaseColorTexture)) c *= texture(base_color_map, slot_uv(0));
    if (has(kVertexColor)) c *= in_color;
    return c;
}

// Alpha masks: emissive_nit.w is the cutoff.
bool masked_out(vec4 base_alpha) { return has(kAlphaMask) && base_alpha.a < material.emissive_nit.w; }

#endif
