#version 460
#extension GL_GOOGLE_include_directive : require
// Depth of what stands between a light and the scene; the masks of masked surfaces need more than the position.
#include "features.glsl"

layout(location = 0) in vec3 position;
layout(location = 3) in vec2 uv0;
layout(location = 4) in vec2 uv1;
layout(location = 5) in vec4 color;

layout(location = 2) out vec4 out_uv;
layout(location = 3) out vec4 out_color;

layout(push_constant) uniform Push { mat4 object_to_clip; };

void main() {
    out_uv = has(kAlphaMask) ? vec4(uv0, uv1) : vec4(0.0);
    out_color = has(kAlphaMask) ? color : vec4(0.0);
    gl_Position = object_to_clip * vec4(position, 1.0);
}
