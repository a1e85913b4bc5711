#version 460
#extension GL_GOOGLE_include_directive : require
// Adds one sample of the picture to the running sum, in 32 bit, scene-referred (exposure undone).
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D sample_image;
layout(set = 0, binding = 1, rgba32f) uniform image2D sum_image;
layout(push_constant) uniform Push {
    ivec2 size;
    float scale;
    int first;
};

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size))) return;
    vec4 texel = texelFetch(sample_image, pixel, 0);
    vec4 value = vec4(texel.rgb * scale, texel.a);
    if (first == 0) value += imageLoad(sum_image, pixel);
    imageStore(sum_image, pixel, value);
}
