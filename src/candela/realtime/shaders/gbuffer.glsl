// The G-buffer: Frostbite's Table 2 packed by hand into one 4 x 32 bit texel, so that the lighting pass reads it with
// one fetch, and a second texel for the surfaces that have more lobes. docs/decisions/0004-gbuffer.md has the layout.
#ifndef CANDELA_GBUFFER_GLSL
#define CANDELA_GBUFFER_GLSL

#include "bsdf.glsl"
#include "octahedral.glsl"

const uint kClassBackground = 0u;
const uint kClassStandard = 1u;
const uint kClassLayered = 2u;
const uint kClassUnlit = 3u;
const uint kClassCount = 4u;
// The last word of an unlit pixel that shows a light: its luminance is light, not a display's colour.
const uint kEmitterMark = 0xffffffffu;

struct GBuffer {
    uint shading_class;
    vec3 normal;
    vec3 surface_normal;  // interpolated from the vertices, without normal maps
    float occlusion;
    Surface surface;
    vec3 coat_normal;
    vec3 tangent;
    bool default_nonmetal;  // of a material with metallic and specular at their defaults
};

uint unorm(float x, uint bits) { return uint(clamp(x, 0.0, 1.0) * float((1u << bits) - 1u) + 0.5); }
float from_unorm(uint x, uint bits) { return float(x) / float((1u << bits) - 1u); }
uint bits(uint word, int first, int count) { return bitfieldExtract(word, first, count); }

// Depth 0 is infinitely far (depth is reversed): nothing was drawn there, and the texel holds what an earlier frame left.
uint shading_class(float depth, uvec4 g) { return depth == 0.0 ? kClassBackground : g.z >> 28u; }

// 10 bits a channel at gamma 2: steps of 0.1 % at mid grey, finer where it is dark.
uint pack_color10(vec3 c) {
    vec3 r = sqrt(c);
    return unorm(r.x, 10u) | unorm(r.y, 10u) << 10u | unorm(r.z, 10u) << 20u;
}
vec3 unpack_color10(uint w) {
    vec3 r = vec3(from_unorm(bits(w, 0, 10), 10u), from_unorm(bits(w, 10, 10), 10u), from_unorm(bits(w, 20, 10), 10u));
    return r * r;
}

uvec4 pack_gbuffer(GBuffer g) {
    Surface s = g.surface;
    uvec4 w;
    w.x = packSnorm2x16(octahedral_encode(g.normal));
    w.y = pack_color10(s.base_color);
    w.z = unorm(s.perceptual_roughness, 12u) | unorm(s.metallic, 10u) << 12u | (g.default_nonmetal ? 1u << 22u : 0u) |
          g.shading_class << 28u;
    w.w = unorm(sqrt(s.dielectric_f0.x), 16u) | unorm(s.dielectric_f90.x, 8u) << 16u | unorm(g.occlusion, 8u) << 24u;
    return w;
}

// Angle of the tangent about the normal, against the basis that the reader rebuilds from the normal alone.
float tangent_angle(vec3 n, vec3 tangent) {
    vec3 t;
    vec3 b;
    orthonormal_basis(n, t, b);
    return atan(dot(tangent, b), dot(tangent, t));
}

uvec4 pack_layers(GBuffer g) {
    Surface s = g.surface;
    uvec4 w;
    w.x = packSnorm2x16(octahedral_encode(g.coat_normal));
    w.y = packUnorm4x8(vec4(sqrt(s.sheen_color), s.sheen_perceptual_roughness));
    // A lobe is the same after half a turn: 256 steps of half a turn hold 0, 45 and 90 degrees exactly.
    float steps = mod(round(tangent_angle(g.normal, g.tangent) * (256.0 / PI)), 256.0);
    w.z = packUnorm4x8(vec4(sqrt(s.dielectric_f0), steps / 255.0));
    w.w = packUnorm4x8(vec4(s.coat, s.coat_perceptual_roughness, s.anisotropy, 0.0));
    return w;
}

GBuffer unpack_gbuffer(uvec4 w) {
    GBuffer g;
    g.shading_class = w.z >> 28u;
    g.normal = octahedral_decode(unpackSnorm2x16(w.x));
    g.surface_normal = g.normal;
    g.surface.base_color = unpack_color10(w.y);
    g.surface.perceptual_roughness = from_unorm(bits(w.z, 0, 12), 12u);
    g.surface.metallic = from_unorm(bits(w.z, 12, 10), 10u);
    g.default_nonmetal = (w.z & 1u << 22u) != 0u;
    float f0 = from_unorm(bits(w.w, 0, 16), 16u);
    g.surface.dielectric_f0 = vec3(f0 * f0);
    g.surface.dielectric_f90 = vec3(from_unorm(bits(w.w, 16, 8), 8u));
    g.occlusion = from_unorm(bits(w.w, 24, 8), 8u);
    g.surface.coat = 0.0;
    g.surface.coat_perceptual_roughness = 0.0;
    g.surface.sheen_color = vec3(0.0);
    g.surface.sheen_perceptual_roughness = 0.0;
    g.surface.anisotropy = 0.0;
    g.coat_normal = g.normal;
    g.tangent = vec3(1.0, 0.0, 0.0);
    return g;
}

void unpack_layers(uvec4 w, inout GBuffer g) {
    g.coat_normal = octahedral_decode(unpackSnorm2x16(w.x));
    vec4 sheen = unpackUnorm4x8(w.y);
    g.surface.sheen_color = sheen.rgb * sheen.rgb;
    g.surface.sheen_perceptual_roughness = sheen.a;
    vec4 f0_angle = unpackUnorm4x8(w.z);
    // The first texel holds the red channel in 16 bits; only a coloured f0 needs the coarser three.
    g.surface.dielectric_f0 = vec3(g.surface.dielectric_f0.x, f0_angle.y * f0_angle.y, f0_angle.z * f0_angle.z);
    if (f0_angle.x == f0_angle.y && f0_angle.y == f0_angle.z) g.surface.dielectric_f0 = vec3(g.surface.dielectric_f0.x);
    vec3 t;
    vec3 b;
    orthonormal_basis(g.normal, t, b);
    float angle = f0_angle.w * (255.0 / 256.0 * PI);
    g.tangent = cos(angle) * t + sin(angle) * b;
    vec4 rest = unpackUnorm4x8(w.w);
    g.surface.coat = rest.x;
    g.surface.coat_perceptual_roughness = rest.y;
    g.surface.anisotropy = rest.z;
}

#endif
