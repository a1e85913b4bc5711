// Writes to each texel: the texel of `previous` where there is one, plus a number.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D previous;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D result;
layout(push_constant) uniform Block {
    float plus;
    int has_previous;
};
void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, imageSize(result)))) return;
    float before = has_previous != 0 ? texelFetch(previous, p, 0).x : 0.0;
    imageStore(result, p, vec4(before + plus));
}
