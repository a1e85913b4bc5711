// Blended surfaces, drawn back to front over the lit frame with the lighting pass's own code; pre-multiplied output.
// Includers say how a surface is lit: light_surface().
#ifndef CANDELA_BLENDED_SURFACE_GLSL
#define CANDELA_BLENDED_SURFACE_GLSL

layout(location = 4) in vec3 in_position;
layout(location = 0) out vec4 out_light;
layout(location = 1) out vec4 out_unlit;

void main() {
    vec4 base_alpha = base_color_and_alpha();
    vec3 emissive_nit;
    float facing = has(kDoubleSided) && !gl_FrontFacing ? -1.0 : 1.0;
    GBuffer g = evaluate_material(base_alpha, facing, emissive_nit);
#ifdef CANDELA_LOCAL_LIGHT_GLSL
    // A probe sees no emission: the frame lights with it and reflects it by itself.
    if (kCapturesProbe) {
        emissive_nit = vec3(0.0);
        if (has(kUnlit)) base_alpha.rgb = vec3(0.0);
    }
#endif
    if (has(kUnlit)) {
        out_light = vec4(0.0, 0.0, 0.0, base_alpha.a);
        out_unlit = vec4(base_alpha.rgb * base_alpha.a, base_alpha.a);
        return;
    }
    Lit lit = light_surface(g, in_position, view_direction(in_position), uvec2(gl_FragCoord.xy));
    vec3 sum = lit.direct_diffuse + lit.direct_specular + lit.indirect_diffuse + lit.indirect_specular + emissive_nit;
    out_light = vec4(pre_exposed(sum) * base_alpha.a, base_alpha.a);
    out_unlit = vec4(0.0, 0.0, 0.0, base_alpha.a);
}

#endif
