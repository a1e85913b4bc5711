// The integrals that shade.glsl approximates, by brute force: L = sum over lights of the integral of f(v,l) Lin(l) <n.l>
// over directions, without visibility. Lights without extent are exact; the environment is drawn from in two ways,
// by its own luminance and by the lobes of the BSDF, put together by the power heuristic (Veach 1995).
#ifndef CANDELA_INTEGRATE_GLSL
#define CANDELA_INTEGRATE_GLSL

#include "shade.glsl"
#include "bsdf_sampling.glsl"
#include "environment_sampling.glsl"
#include "sequence.glsl"

// C++: Strategy.
const int kStrategyBoth = 0;
const int kStrategyLight = 1;
const int kStrategyBsdf = 2;
layout(constant_id = 15) const int kStrategy = kStrategyBoth;

// bake/environment_distribution.hpp: height + 1 entries of rows, then height rows of width + 1 entries.
layout(set = 0, binding = 6, std430) readonly buffer EnvironmentDistribution { float environment_cdf[]; };

// Dimensions of the random sequence, two numbers each.
const uint kPairEnvironment = 0u;
const uint kPairBsdf = 1u;
const uint kPairLobe = 2u;

// One direction towards a light that has extent, and the densities in 1/sr with which the two ways draw it.
struct LightDraw {
    vec3 l;
    vec3 luminance_nit;
    float pdf_light;
    float pdf_bsdf;
};

// Largest i in [0, count) with cdf[first + i] <= u, and how far u is into that step, in [0,1).
int search_cdf(int first, int count, float u, out float fraction, out float share) {
    int low = 0;
    int high = count;
    while (high - low > 1) {
        int middle = (low + high) >> 1;
        if (environment_cdf[first + middle] <= u) {
            low = middle;
        } else {
            high = middle;
        }
    }
    float below = environment_cdf[first + low];
    share = environment_cdf[first + low + 1] - below;
    fraction = share > 0.0 ? min((u - below) / share, 0.99999994) : 0.5;
    return low;
}

float cdf_step(int index) { return environment_cdf[index + 1] - environment_cdf[index]; }
int first_of_row(int row, ivec2 size) { return size.y + 1 + row * (size.x + 1); }

float environment_pdf(ivec2 texel, ivec2 size) {
    float share = cdf_step(texel.y) * cdf_step(first_of_row(texel.y, size) + texel.x);
    return environment_texel_pdf(share, texel.y, size);
}

vec3 environment_luminance_nit(vec3 direction, ivec2 size) {
    BilinearTexels t = environment_bilinear(direction, size);
    vec3 top = mix(texelFetch(background_map, t.low, 0).rgb, texelFetch(background_map, ivec2(t.high.x, t.low.y), 0).rgb,
                   t.fraction.x);
    vec3 bottom = mix(texelFetch(background_map, ivec2(t.low.x, t.high.y), 0).rgb,
                      texelFetch(background_map, t.high, 0).rgb, t.fraction.x);
    return mix(top, bottom, t.fraction.y) * frame.environment.z;
}

vec3 sample_environment(vec2 u, ivec2 size, out float pdf) {
    vec2 fraction;
    vec2 share;
    ivec2 texel;
    texel.y = search_cdf(0, size.y, u.y, fraction.y, share.y);
    texel.x = search_cdf(first_of_row(texel.y, size), size.x, u.x, fraction.x, share.x);
    pdf = environment_texel_pdf(share.x * share.y, texel.y, size);
    return environment_texel_direction(texel, fraction, size);
}

// Adds one draw. by_light: which of its two densities it was drawn with.
void add_draw(SurfacePoint p, LightDraw draw, bool by_light, float scale, inout vec3 diffuse_nit,
              inout vec3 specular_nit) {
    float pdf = by_light ? draw.pdf_light : draw.pdf_bsdf;
    float other = by_light ? draw.pdf_bsdf : draw.pdf_light;
    float NoL = dot(p.g.normal, draw.l);
    if (NoL <= 0.0 || !(pdf > 0.0)) return;
    float weight = kStrategy == kStrategyBoth ? power_heuristic(pdf, other) : 1.0;
    vec3 diffuse;
    vec3 specular;
    evaluate(p, draw.l, NoL, diffuse, specular);
    vec3 weighted_nit = draw.luminance_nit * (scale * weight * NoL / pdf);
    diffuse_nit += diffuse * weighted_nit;
    specular_nit += specular * weighted_nit;
}

void integrate_environment(SurfacePoint p, uvec2 pixel, inout Lit lit) {
    GBuffer g = p.g;
    vec3 tangent = g.tangent;
    vec3 bitangent = p.bitangent;
    if (!kShadeLayers) orthonormal_basis(g.normal, tangent, bitangent);
    float coat_NoV = p.NoV;
    vec4 coat_dfg = vec4(0.0);
    if (kShadeLayers) {
        coat_NoV = max(dot(g.coat_normal, p.v), 1.0e-4);
        coat_dfg = directional_albedo(coat_NoV, g.surface.coat_perceptual_roughness);
    }
    BsdfLobes lobes = bsdf_lobes(g.surface, techniques(), p.NoV, coat_NoV, p.dfg, coat_dfg);
    ivec2 size = textureSize(background_map, 0);
    uint seed = pixel_seed(pixel, frame.random.y);
    float scale = 1.0 / float(frame.random.z);
    for (uint i = 0u; i < frame.random.z; ++i) {
        uint index = frame.random.x * frame.random.z + i;
        LightDraw draw;
        if (kStrategy != kStrategyBsdf) {
            vec3 d = sample_environment(sobol_owen_pair(index, kPairEnvironment, seed), size, draw.pdf_light);
            draw.l = from_environment(d);
            // What the surface faces away from weighs nothing: its texels need no reading.
            if (dot(g.normal, draw.l) > 0.0) {
                draw.luminance_nit = environment_luminance_nit(d, size);
                draw.pdf_bsdf =
                    pdf_bsdf(lobes, g.surface, g.normal, tangent, bitangent, g.coat_normal, p.v, draw.l);
                add_draw(p, draw, true, scale, lit.indirect_diffuse, lit.indirect_specular);
            }
        }
        if (kStrategy != kStrategyLight) {
            float choice = sobol_owen_pair(index, kPairLobe, seed).x;
            draw.l = sample_bsdf(lobes, g.surface, g.normal, tangent, bitangent, g.coat_normal, p.v, choice,
                                 sobol_owen_pair(index, kPairBsdf, seed));
            if (dot(g.normal, draw.l) > 0.0) {
                vec3 d = to_environment(draw.l);
                draw.luminance_nit = environment_luminance_nit(d, size);
                draw.pdf_light = environment_pdf(environment_texel(d, size), size);
                draw.pdf_bsdf =
                    pdf_bsdf(lobes, g.surface, g.normal, tangent, bitangent, g.coat_normal, p.v, draw.l);
                add_draw(p, draw, false, scale, lit.indirect_diffuse, lit.indirect_specular);
            }
        }
    }
}

// One sample of the integrals at a surface point; its mean over frame.random.x converges to them. A light with extent
// is added as the environment is: a function that draws from its shape, its density for what the BSDF drew, and
// add_draw for both.
Lit integrate(GBuffer g, vec3 position, vec3 v, uvec2 pixel) {
    SurfacePoint p = surface_point(g, position, v);
    Lit lit = kNoLight;
    if (kHasLights) {
        for (int i = 0; i < frame.size.z; ++i) add_punctual_light(lights[i], p, lit);
    }
    if (kHasEnvironment) integrate_environment(p, pixel, lit);
    return lit;
}

#endif
