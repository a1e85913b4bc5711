#version 460
#extension GL_GOOGLE_include_directive : require
#include "base_color.glsl"

void main() {
    if (masked_out(base_color_and_alpha())) discard;
}
