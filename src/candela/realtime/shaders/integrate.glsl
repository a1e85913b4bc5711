// The integrals that shade.glsl approximates, by brute force: L = sum over lights of the integral of f(v,l) Lin(l) <n.l>
// over directions, times visibility where the tables hold a scene for rays. Lights without extent are exact. What has
// extent (the environment, suns, shapes, emissive triangles) is drawn from in two ways, by its own light and by the lobes
// of the BSDF, put together by the power heuristic (Veach 1995).
#ifndef CANDELA_INTEGRATE_GLSL
#define CANDELA_INTEGRATE_GLSL

#include "shade.glsl"
#include "bsdf_sampling.glsl"
#include "environment_sampling.glsl"
#include "emitters.glsl"
#include "sequence.glsl"

// C++: Strategy.
const int kStrategyBoth = 0;
const int kStrategyLight = 1;
const int kStrategyBsdf = 2;
layout(constant_id = 15) const int kStrategy = kStrategyBoth;

// bake/environment_distribution.hpp: height + 1 entries of rows, then height rows of width + 1 entries.
float environment_cdf(int index) { return table_floats[environment_first_float() + uint(index)]; }

// Dimensions of the random sequence, two numbers each.
const uint kPairEnvironment = 0u;
const uint kPairBsdf = 1u;
const uint kPairChoice = 2u;  // of the lobe, and of the emitter
const uint kPairEmitter = 3u;
const uint kPairAsked = 4u;  // and on: one a sun

// Largest i in [0, count) with cdf[first + i] <= u, and how far u is into that step, in [0,1).
int search_cdf(int first, int count, float u, out float fraction, out float share) {
    int low = 0;
    int high = count;
    while (high - low > 1) {
        int middle = (low + high) >> 1;
        if (environment_cdf(first + middle) <= u) {
            low = middle;
        } else {
            high = middle;
        }
    }
    float below = environment_cdf(first + low);
    share = environment_cdf(first + low + 1) - below;
    fraction = share > 0.0 ? min((u - below) / share, 0.99999994) : 0.5;
    return low;
}

float cdf_step(int index) { return environment_cdf(index + 1) - environment_cdf(index); }
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

// A surface point with what all its draws share.
struct Receiver {
    SurfacePoint p;
    RayOrigins rays;
    vec3 tangent;
    vec3 bitangent;
    BsdfLobes lobes;
};

Receiver receiver(SurfacePoint p) {
    Receiver r;
    r.p = p;
    if (casts_rays()) {
        r.rays = ray_origins(p.position, p.v, p.g.normal);
        r.p.position = r.rays.position;
    }
    GBuffer g = p.g;
    r.tangent = g.tangent;
    r.bitangent = p.bitangent;
    if (!kShadeLayers) orthonormal_basis(g.normal, r.tangent, r.bitangent);
    float coat_NoV = p.NoV;
    vec4 coat_dfg = vec4(0.0);
    if (kShadeLayers) {
        coat_NoV = max(dot(g.coat_normal, p.v), 1.0e-4);
        coat_dfg = directional_albedo(coat_NoV, g.surface.coat_perceptual_roughness);
    }
    r.lobes = bsdf_lobes(g.surface, techniques(), p.NoV, coat_NoV, p.dfg, coat_dfg);
    return r;
}

float lobes_pdf(Receiver r, vec3 l) {
    return pdf_bsdf(r.lobes, r.p.g.surface, r.p.g.normal, r.tangent, r.bitangent, r.p.g.coat_normal, r.p.v, l);
}

// Adds light from direction l, where `light` holds all but the BSDF and the cosine.
void add_light(Receiver r, vec3 l, vec3 light, inout vec3 diffuse_nit, inout vec3 specular_nit) {
    float NoL = dot(r.p.g.normal, l);
    vec3 diffuse;
    vec3 specular;
    evaluate(r.p, l, NoL, diffuse, specular);
    diffuse_nit += diffuse * (light * NoL);
    specular_nit += specular * (light * NoL);
}

// Of a draw by the light's own way with density pdf, against the BSDF's.
float light_draw_weight(Receiver r, vec3 l, float pdf) {
    return kStrategy == kStrategyBoth ? power_heuristic(pdf, lobes_pdf(r, l)) : 1.0;
}
// Of a draw by the BSDF with density pdf, against the light's own.
float bsdf_draw_weight(float pdf, float pdf_light) {
    return kStrategy == kStrategyBoth ? power_heuristic(pdf, pdf_light) : 1.0;
}

// One draw towards an emitter. probability: of this emitter among others.
void add_arrival(Receiver r, Arrival a, float probability, bool shadows, float scale, inout Lit lit) {
    float pdf = a.pdf * probability;
    if (!(pdf > 0.0) || dot(r.p.g.normal, a.l) <= 0.0 || max_component(a.light) <= 0.0) return;
    if (!a.delta && kStrategy == kStrategyBsdf) return;
    float weight = a.delta ? 1.0 : light_draw_weight(r, a.l, pdf);
    if (shadows) weight *= visible(r.rays, a.l, a.distance_m);
    if (weight > 0.0) add_light(r, a.l, a.light * (scale * weight / pdf), lit.direct_diffuse, lit.direct_specular);
}

void add_environment_draw(Receiver r, uint index, uint seed, ivec2 size, float scale, inout Lit lit) {
    float pdf;
    vec3 d = sample_environment(sobol_owen_pair(index, kPairEnvironment, seed), size, pdf);
    vec3 l = from_environment(d);
    // What the surface faces away from weighs nothing: its texels need no reading.
    if (dot(r.p.g.normal, l) <= 0.0 || !(pdf > 0.0)) return;
    float weight = light_draw_weight(r, l, pdf) * visible(r.rays, l, kNoEnd);
    if (weight <= 0.0) return;
    add_light(r, l, environment_luminance_nit(d, size) * (scale * weight / pdf), lit.indirect_diffuse,
              lit.indirect_specular);
}

void add_emitter_draw(Receiver r, uint index, uint seed, float scale, inout Lit lit) {
    float probability;
    uint item = sample_emitter(r.p.position, r.p.g.normal, sobol_owen_pair(index, kPairChoice, seed).y, probability);
    if (probability <= 0.0) return;
    uvec4 what = emitter_item(item);
    Arrival a = sample_item(what, sobol_owen_pair(index, kPairEmitter, seed), r.p.position);
    add_arrival(r, a, probability, what.z != 0u, scale, lit);
}

// What arrives along a direction that the BSDF drew, weighted: every emitter that the ray enters, as none is in the way
// of another.
vec3 emitters_along(Receiver r, vec3 l, float pdf) {
    vec3 sum = vec3(0.0);
    vec3 position = r.p.position;
    vec3 inverse = ray_inverse(l);
    uint node = 0u;
    uint count = emitter_node_count();
    while (node < count) {
        uvec4 low = emitter_low(node);
        uvec4 high = emitter_high(node);
        if (!meets_box(uintBitsToFloat(low.xyz), uintBitsToFloat(high.xyz), position, inverse, kNoEnd)) {
            node = low.w;
            continue;
        }
        ++node;
        if ((high.w & kEmitterLeaf) == 0u) continue;
        uint item = high.w & kEmitterFirst;
        uvec4 what = emitter_item(item);
        Arrival a = item_from(what, position, l);
        if (!(a.pdf > 0.0) || max_component(a.light) <= 0.0) continue;
        float probability = kStrategy == kStrategyBoth ? emitter_probability(position, r.p.g.normal, item) : 1.0;
        float weight = bsdf_draw_weight(pdf, a.pdf * probability);
        if (what.z != 0u) weight *= visible(r.rays, l, a.distance_m);
        sum += a.light * weight;
    }
    return sum;
}
vec3 suns_along(Receiver r, vec3 l, float pdf, inout float sky_visible) {
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < asked_count(); ++k) {
        uvec4 what = table_quads[asked_first() + k];
        Light light = light_at(what.x);
        if (type_of(light) != kLightSun) continue;
        Arrival a = sun_from(light, l);
        if (!(a.pdf > 0.0)) continue;
        float weight = bsdf_draw_weight(pdf, a.pdf);
        if (what.y != 0u) {
            if (sky_visible < 0.0) sky_visible = visible(r.rays, l, kNoEnd);
            weight *= sky_visible;
        }
        sum += a.light * weight;
    }
    return sum;
}

void add_bsdf_draw(Receiver r, uint index, uint seed, ivec2 size, float scale, inout Lit lit) {
    GBuffer g = r.p.g;
    float choice = sobol_owen_pair(index, kPairChoice, seed).x;
    vec3 l = sample_bsdf(r.lobes, g.surface, g.normal, r.tangent, r.bitangent, g.coat_normal, r.p.v, choice,
                         sobol_owen_pair(index, kPairBsdf, seed));
    if (dot(g.normal, l) <= 0.0) return;
    float pdf = lobes_pdf(r, l);
    if (!(pdf > 0.0)) return;
    float sky_visible = -1.0;  // not known yet
    vec3 direct_nit = emitters_along(r, l, pdf) + suns_along(r, l, pdf, sky_visible);
    vec3 environment_nit = vec3(0.0);
    if (kHasEnvironment) {
        vec3 d = to_environment(l);
        float weight = bsdf_draw_weight(pdf, environment_pdf(environment_texel(d, size), size));
        if (sky_visible < 0.0) sky_visible = visible(r.rays, l, kNoEnd);
        environment_nit = environment_luminance_nit(d, size) * (weight * sky_visible);
    }
    vec3 diffuse = vec3(0.0);
    vec3 specular = vec3(0.0);
    add_light(r, l, vec3(scale / pdf), diffuse, specular);
    lit.direct_diffuse += diffuse * direct_nit;
    lit.direct_specular += specular * direct_nit;
    lit.indirect_diffuse += diffuse * environment_nit;
    lit.indirect_specular += specular * environment_nit;
}

// Lights that every sample asks: those without extent are exact, and a sun has its own draw.
void add_asked_lights(Receiver r, uint first_draw, uint seed, inout Lit lit) {
    for (uint k = 0u; k < asked_count(); ++k) {
        uvec4 what = table_quads[asked_first() + k];
        Light light = light_at(what.x);
        if (type_of(light) != kLightSun) {
            add_arrival(r, only_arrival(light, r.p.position), 1.0, what.y != 0u, 1.0, lit);
            continue;
        }
        for (uint i = 0u; i < frame.random.z; ++i) {
            Arrival a = sample_sun_light(light, sobol_owen_pair(first_draw + i, kPairAsked + k, seed));
            add_arrival(r, a, 1.0, what.y != 0u, 1.0 / float(frame.random.z), lit);
        }
    }
}

// One sample of the integrals at a surface point; its mean over frame.random.x converges to them.
Lit integrate(GBuffer g, vec3 position, vec3 v, uvec2 pixel) {
    Receiver r = receiver(surface_point(g, position, v));
    Lit lit = kNoLight;
    uint seed = pixel_seed(pixel, frame.random.y);
    ivec2 size = textureSize(background_map, 0);
    bool any_emitter = emitter_node_count() > 0u;
    uint draws = frame.random.z;
    uint first_draw = frame.random.x * draws;
    float scale = 1.0 / float(draws);
    add_asked_lights(r, first_draw, seed, lit);
    if (!kHasEnvironment && !any_emitter && asked_count() == 0u) return lit;
    for (uint i = first_draw; i < first_draw + draws; ++i) {
        if (kHasEnvironment && kStrategy != kStrategyBsdf) add_environment_draw(r, i, seed, size, scale, lit);
        if (any_emitter) add_emitter_draw(r, i, seed, scale, lit);
        if (kStrategy != kStrategyLight) add_bsdf_draw(r, i, seed, size, scale, lit);
    }
    return lit;
}

#endif
