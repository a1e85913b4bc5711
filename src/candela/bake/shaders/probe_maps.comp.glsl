#version 460
#extension GL_GOOGLE_include_directive : require
// One level of a reflection probe's maps from two filtered environments: what it sees, and how much of it is not sky.
#include "environment_maps.glsl"
#include "octahedral.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D color_map;
layout(set = 0, binding = 1) uniform sampler2D visibility_map;
layout(set = 0, binding = 2, rgba32f) writeonly uniform image2D level_image;
// C++: MapBlock.
layout(push_constant) uniform Push {
    int size;  // texels a side of this level, gutters included
    float perceptual_roughness;
    float nit_per_unit;
    float visibility_per_unit;
};

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(size)))) return;
    ivec2 interior = octahedral_fold(texel - 1, size - 2);
    vec3 direction = octahedral_decode((vec2(interior) + 0.5) / float(size - 2) * 2.0 - 1.0);
    vec3 color = sample_specular_ld(color_map, direction, perceptual_roughness);
    float visibility = sample_specular_ld(visibility_map, direction, perceptual_roughness).r;
    imageStore(level_image, texel, vec4(color * nit_per_unit, clamp(visibility * visibility_per_unit, 0.0, 1.0)));
}
