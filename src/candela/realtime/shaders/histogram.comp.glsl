#version 460
#extension GL_GOOGLE_include_directive : require
// Histogram of log2 luminance for the automatic exposure (Frostbite 5.1.1). Black pixels are not metered.
#include "frame.glsl"
#include "language.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 1) uniform sampler2D light_image;
layout(set = 0, binding = 2, std430) buffer Histogram { uint bins[]; } histogram;

// 256 bins of 1/8 stop: luminance 2^-16 ... 2^16 of the pre-exposed light. C++: metering.hpp.
layout(push_constant) uniform Push { int step_pixels; };

void main() {
    ivec2 grid = (frame.size.xy + step_pixels - 1) / step_pixels;
    int index = int(gl_GlobalInvocationID.x);
    if (index >= grid.x * grid.y) return;
    ivec2 pixel = min(ivec2(index % grid.x, index / grid.x) * step_pixels + step_pixels / 2, frame.size.xy - 1);
    float y = luminance(texelFetch(light_image, pixel, 0).rgb);
    if (y <= 0.0) return;
    atomicAdd(histogram.bins[uint(clamp((log2(y) + 16.0) * 8.0, 0.0, 255.0))], 1u);
}
