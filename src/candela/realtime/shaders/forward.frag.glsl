#version 460
#extension GL_GOOGLE_include_directive : require
// Blended surfaces, drawn back to front over the lit frame with the lighting pass's own code; pre-multiplied output.
#include "frame.glsl"
#include "material.glsl"
#include "shade.glsl"

layout(location = 4) in vec3 in_position;
layout(location = 0) out vec4 out_light;

void main() {
    vec4 base_alpha = base_color_and_alpha();
    vec3 emissive_nit;
    float facing = has(kDoubleSided) && !gl_FrontFacing ? -1.0 : 1.0;
    GBuffer g = evaluate_material(base_alpha, facing, emissive_nit);
    if (has(kUnlit)) {
        out_light = vec4(base_alpha.rgb * base_alpha.a, base_alpha.a);
        return;
    }
    Lit lit = shade(g, in_position, view_direction(in_position));
    vec3 sum = lit.direct_diffuse + lit.direct_specular + lit.indirect_diffuse + lit.indirect_specular + emissive_nit;
    out_light = vec4(min(sum * frame.exposure.x, vec3(65504.0)) * base_alpha.a, base_alpha.a);
}
