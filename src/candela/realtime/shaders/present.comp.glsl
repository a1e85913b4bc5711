#version 460
#extension GL_GOOGLE_include_directive : require
// Pre-exposed light to a display: tone curve (unlit colours apart), sRGB transfer, 8 bit.
#include "frame.glsl"
#include "tone_curves.glsl"
#include "transfer.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int kToneCurve = 3;
layout(set = 0, binding = 1) uniform sampler2D light_image;
layout(set = 0, binding = 2, rgba8) writeonly uniform image2D display_image;
layout(set = 0, binding = 3) uniform sampler2D unlit_image;
layout(push_constant) uniform Push {
    float exposure_change;
    int has_unlit;
};

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size.xy))) return;
    vec4 light = texelFetch(light_image, pixel, 0);
    vec4 exposed = vec4(light.rgb * exposure_change, light.a);
    vec3 display = has_unlit == 0 ? display_from_exposed(kToneCurve, exposed.rgb)
                                  : display_with_unlit(kToneCurve, exposed, texelFetch(unlit_image, pixel, 0).rgb);
    imageStore(display_image, pixel, vec4(srgb_from_linear_8bit(display), 1.0));
}
