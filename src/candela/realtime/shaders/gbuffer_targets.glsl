// The G-buffer pass's fragment shader. With GBUFFER_ALL_TARGETS it also writes emission, the second texel and the ids, with
// GBUFFER_SURFACE_NORMALS the normals without maps; scenes that need none of them rasterize into one target.
#include "frame.glsl"
#include "material.glsl"

layout(push_constant) uniform Push {
    vec4 row0;
    vec4 row1;
    vec4 row2;
    uvec4 ids;  // x instance + 1, y material + 1
} object;

layout(location = 0) out uvec4 out_gbuffer;
#ifdef GBUFFER_ALL_TARGETS
layout(location = 1) out vec4 out_light;
layout(location = 2) out uvec4 out_layers;
layout(location = 3) out uvec2 out_ids;
#endif
#ifdef GBUFFER_SURFACE_NORMALS
layout(location = 4) out uint out_surface_normal;
#endif

void main() {
    vec4 base_alpha = base_color_and_alpha();
    vec3 emissive_nit;
    float facing = has(kDoubleSided) && !gl_FrontFacing ? -1.0 : 1.0;
    GBuffer g = evaluate_material(base_alpha, facing, emissive_nit);
    if (masked_out(base_alpha)) discard;
    out_gbuffer = pack_gbuffer(g);
#ifdef GBUFFER_ALL_TARGETS
    // An unlit colour is display-referred: the lighting pass moves it to an image of its own.
    out_light = vec4(has(kUnlit) ? base_alpha.rgb : pre_exposed(emissive_nit), 1.0);
    out_layers = has(kLayered) ? pack_layers(g) : uvec4(0u);
    out_ids = object.ids.xy;
#endif
#ifdef GBUFFER_SURFACE_NORMALS
    out_surface_normal = packSnorm2x16(octahedral_encode(g.surface_normal));
#endif
}
