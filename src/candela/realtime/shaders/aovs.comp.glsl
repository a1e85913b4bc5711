#version 460
#extension GL_GOOGLE_include_directive : require
// Unpacks what the G-buffer knows into pictures: albedo, shading normal, distance along the view axis.
#include "frame.glsl"
#include "gbuffer.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 1) uniform usampler2D gbuffer_image;
layout(set = 0, binding = 2) uniform sampler2D depth_image;
layout(set = 0, binding = 3, rgba32f) writeonly uniform image2D albedo_image;
layout(set = 0, binding = 4, rgba32f) writeonly uniform image2D normal_image;
layout(set = 0, binding = 5, rgba32f) writeonly uniform image2D distance_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) return;
    uvec4 words = texelFetch(gbuffer_image, pixel, 0);
    float depth = texelFetch(depth_image, pixel, 0).r;
    bool hit = depth != 0.0;
    GBuffer g = unpack_gbuffer(words);
    vec3 position = world_position(vec2(pixel) + 0.5, depth);
    float z_m = dot(frame.camera_position.xyz - position, frame.camera_backward.xyz);
    imageStore(albedo_image, pixel, hit ? vec4(g.surface.base_color, 1.0) : vec4(0.0));
    imageStore(normal_image, pixel, hit ? vec4(g.normal, 1.0) : vec4(0.0));
    imageStore(distance_image, pixel, vec4(hit ? z_m : uintBitsToFloat(0x7f800000u)));
}
