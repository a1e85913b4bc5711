#version 460
#extension GL_GOOGLE_include_directive : require
// Histogram of log2 luminance for the automatic exposure (Frostbite 5.1.1). Not metered: black pixels, and unlit surfaces,
// whose colour is display-referred.
#include "frame.glsl"
#include "language.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 1) uniform sampler2D light_image;
layout(set = 0, binding = 2, std430) buffer Histogram { uint bins[]; } histogram;

// 1024 bins of 1/24 stop from 2^-24, the smallest half float, of the pre-exposed light. C++: exposure_meter.hpp.
layout(push_constant) uniform Push { int step_pixels; };

void main() {
    ivec2 grid = (frame.size.xy + step_pixels - 1) / step_pixels;
    int index = int(gl_GlobalInvocationID.x);
    if (index >= grid.x * grid.y) return;
    ivec2 pixel = min(ivec2(index % grid.x, index / grid.x) * step_pixels + step_pixels / 2, frame.size.xy - 1);
    vec4 light = texelFetch(light_image, pixel, 0);
    float y = luminance(light.rgb) / max(light.a, 0.5);
    if (!(y > 0.0) || light.a < 0.5) return;
    atomicAdd(histogram.bins[uint(clamp((log2(min(y, 65504.0)) + 24.0) * 24.0, 0.0, 1023.0))], 1u);
}
