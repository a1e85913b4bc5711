#version 460
#extension GL_GOOGLE_include_directive : require
#include "dfg.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kUe4 = false;
layout(set = 0, binding = 0, rgba32f) writeonly uniform image2D table;
layout(push_constant) uniform Push { uint sample_count; };

void main() {
    uvec2 texel = gl_GlobalInvocationID.xy;
    vec2 p = dfg_parameters(texel.x, texel.y);
    vec4 value = kUe4 ? integrate_dfg_ue4(p.x, p.y, sample_count) : integrate_dfg(p.x, p.y, sample_count);
    imageStore(table, ivec2(texel), value);
}
