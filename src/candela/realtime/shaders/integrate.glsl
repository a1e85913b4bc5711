// The integrals that shade.glsl approximates, by brute force: L = sum over lights of the integral of f(v,l) Lin(l) <n.l>
// over directions, times visibility where the tables hold a scene for rays. Lights without extent are exact. What has
// extent (the environment, suns, shapes, emissive triangles) is drawn from in two ways, by its own light and by the lobes
// of the BSDF, put together by the power heuristic (Veach 1995).
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
// The strategy and, above it, what the tables hold (C++: IntegrateVariant): what is not there is not in the pipeline.
layout(constant_id = 15) const int kIntegrate = 0;
const int kStrategy = kIntegrate & 3;
const bool kCastsRays = (kIntegrate & 4) != 0;
const bool kHasEmitters = (kIntegrate & 8) != 0;
const bool kHasAsked = (kIntegrate & 16) != 0;
const bool kHasTransparency = (kIntegrate & 32) != 0;
const bool kHasInstances = (kIntegrate & 64) != 0;

#include "emitters.glsl"

// bake/environment_distribution.hpp: for each row of cells and one more the cumulative share, then for each row as many
// of its cells.
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
int first_of_row(int row, ivec2 cells) { return cells.y + 1 + row * (cells.x + 1); }

float environment_pdf(vec3 direction) {
    ivec2 cells = environment_cells();
    ivec2 cell = environment_texel(direction, cells);
    float share = cdf_step(cell.y) * cdf_step(first_of_row(cell.y, cells) + cell.x);
    return environment_texel_pdf(share, cell.y, cells);
}

vec3 environment_luminance_nit(vec3 direction, ivec2 size) {
    BilinearTexels t = environment_bilinear(direction, size);
    vec3 top = mix(texelFetch(background_map, t.low, 0).rgb, texelFetch(background_map, ivec2(t.high.x, t.low.y), 0).rgb,
                   t.fraction.x);
    vec3 bottom = mix(texelFetch(background_map, ivec2(t.low.x, t.high.y), 0).rgb,
                      texelFetch(background_map, t.high, 0).rgb, t.fraction.x);
    return mix(top, bottom, t.fraction.y) * frame.environment.z;
}

vec3 sample_environment(vec2 u, out float pdf) {
    ivec2 cells = environment_cells();
    vec2 fraction;
    vec2 share;
    ivec2 cell;
    cell.y = search_cdf(0, cells.y, u.y, fraction.y, share.y);
    cell.x = search_cdf(first_of_row(cell.y, cells), cells.x, u.x, fraction.x, share.x);
    pdf = environment_texel_pdf(share.x * share.y, cell.y, cells);
    return environment_texel_direction(cell, fraction, cells);
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
    if (kCastsRays) {
        r.rays = ray_origins(p.position, p.v, p.g.surface_normal);
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

// One sample of a direction, by whichever strategy.
struct Draw {
    vec3 l;
    vec3 direct;     // cd/m^2, or lx of lights without extent, times all but the BSDF, the cosine and the weight
    vec3 indirect;   // of the environment
    vec3 unblocked;  // as direct, its visibility found already or not asked for
    float distance_m;
    float pdf;      // 1/sr with which it was drawn; 0: nothing
    bool only;      // no other strategy samples it
    bool blocked;   // direct and indirect are multiplied by visibility
    bool weighted;  // what it carries is weighted against the other strategy already
};
const Draw kNoDraw = Draw(vec3(0.0, 0.0, 1.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, false, false, false);

Draw from_arrival(Arrival a, float probability, bool shadows) {
    return Draw(a.l, a.light, vec3(0.0), vec3(0.0), a.distance_m, a.pdf * probability, a.delta, shadows, false);
}

Draw environment_draw(Receiver r, uint index, uint seed, ivec2 size) {
    Draw d = kNoDraw;
    vec3 local = sample_environment(sobol_owen_pair(index, kPairEnvironment, seed), d.pdf);
    d.l = from_environment(local);
    d.distance_m = kNoEnd;
    d.blocked = true;
    // What the surface faces away from weighs nothing: its texels need no reading.
    if (dot(r.p.g.normal, d.l) > 0.0) d.indirect = environment_luminance_nit(local, size);
    return d;
}

Draw emitter_draw(Receiver r, uint index, uint seed) {
    float probability;
    uint item = sample_emitter(r.p.position, r.p.g.normal, sobol_owen_pair(index, kPairChoice, seed).y, probability);
    if (probability <= 0.0) return kNoDraw;
    uvec4 what = emitter_item(item);
    return from_arrival(sample_item(what, sobol_owen_pair(index, kPairEmitter, seed), r.p.position), probability,
                        what.z != 0u);
}

Draw asked_draw(Receiver r, uint k, uint index, uint seed) {
    uvec4 what = table_quads[asked_first() + k];
    Light light = light_at(what.x);
    if (type_of(light) == kLightSun) {
        return from_arrival(sample_sun_light(light, sobol_owen_pair(index, kPairAsked + k, seed)), 1.0, what.y != 0u);
    }
    return from_arrival(only_arrival(light, r.p.position), 1.0, what.y != 0u);
}

// The next emitter from `node` on that the ray from the receiver enters, and the node after it; false: there is none.
// The loops nest from cheap to dear (Aila & Laine 2009, "Understanding the Efficiency of Ray Traversal on GPUs"): lanes of
// a SIMD device meet again before the dear part, which a software device otherwise runs for every box that is passed.
bool next_emitter_along(vec3 position, vec3 l, vec3 inverse, inout uint node, out uint item) {
    uint count = emitter_node_count();
    item = 0u;
    while (true) {
        bool leaf = false;
        while (node < count && !leaf) {
            uvec4 low = emitter_low(node);
            uvec4 high = emitter_high(node);
            bool met = meets_box(uintBitsToFloat(low.xyz), uintBitsToFloat(high.xyz), position, inverse, kNoEnd);
            leaf = met && (high.w & kEmitterLeaf) != 0u;
            item = high.w & kEmitterFirst;
            node = met ? node + 1u : low.w;
        }
        if (!leaf) return false;
        if (enters_item(emitter_item(item), position, l)) return true;
    }
    return false;
}

// What arrives along a direction that the BSDF drew with density pdf, weighted: every emitter that the ray enters, as none
// occludes another.
vec3 emitters_along(Receiver r, vec3 l, float pdf) {
    vec3 sum = vec3(0.0);
    vec3 position = r.p.position;
    vec3 inverse = ray_inverse(l);
    uint node = 0u;
    uint item;
    while (next_emitter_along(position, l, inverse, node, item)) {
        uvec4 what = emitter_item(item);
        Arrival a = item_from(what, position, l);
        if (!(a.pdf > 0.0) || max_component(a.light) <= 0.0) continue;
        float weight = 1.0;
        if (kStrategy == kStrategyBoth) {
            weight = power_heuristic(pdf, a.pdf * emitter_probability(position, r.p.g.normal, item));
        }
        if (kCastsRays && what.z != 0u) weight *= visible(r.rays, l, a.distance_m);
        sum += a.light * weight;
    }
    return sum;
}

// The suns in a direction that the BSDF drew: first those that cast shadows, then the others.
void suns_along(vec3 l, float pdf, out vec3 shadowed, out vec3 unshadowed) {
    shadowed = unshadowed = vec3(0.0);
    for (uint k = 0u; k < asked_count(); ++k) {
        uvec4 what = table_quads[asked_first() + k];
        Light light = light_at(what.x);
        if (type_of(light) != kLightSun) continue;
        Arrival a = sun_from(light, l);
        if (!(a.pdf > 0.0)) continue;
        vec3 weighted = a.light * (kStrategy == kStrategyBoth ? power_heuristic(pdf, a.pdf) : 1.0);
        if (what.y != 0u) {
            shadowed += weighted;
        } else {
            unshadowed += weighted;
        }
    }
}

// A direction that the BSDF samples, with all that it sees of the sky, suns and emitters.
Draw bsdf_draw(Receiver r, uint index, uint seed, ivec2 size) {
    GBuffer g = r.p.g;
    Draw d = kNoDraw;
    d.l = sample_bsdf(r.lobes, g.surface, g.normal, r.tangent, r.bitangent, g.coat_normal, r.p.v,
                      sobol_owen_pair(index, kPairChoice, seed).x, sobol_owen_pair(index, kPairBsdf, seed));
    if (dot(g.normal, d.l) <= 0.0) return kNoDraw;
    d.pdf = pdf_bsdf(r.lobes, g.surface, g.normal, r.tangent, r.bitangent, g.coat_normal, r.p.v, d.l);
    if (!(d.pdf > 0.0)) return kNoDraw;
    d.distance_m = kNoEnd;
    d.blocked = true;
    d.weighted = true;
    if (kHasEmitters) d.unblocked = emitters_along(r, d.l, d.pdf);
    if (kHasAsked) {
        vec3 suns;
        suns_along(d.l, d.pdf, d.direct, suns);
        d.unblocked += suns;
    }
    if (kHasEnvironment) {
        vec3 local = to_environment(d.l);
        float other = environment_pdf(local);
        d.indirect = environment_luminance_nit(local, size) *
                     (kStrategy == kStrategyBoth ? power_heuristic(d.pdf, other) : 1.0);
    }
    return d;
}

void add_draw(Receiver r, Draw d, float scale, inout Lit lit) {
    float NoL = dot(r.p.g.normal, d.l);
    if (NoL <= 0.0 || !(d.pdf > 0.0)) return;
    float weight = NoL * scale / d.pdf;
    if (kStrategy == kStrategyBoth && !d.only && !d.weighted) {
        GBuffer g = r.p.g;
        weight *= power_heuristic(d.pdf, pdf_bsdf(r.lobes, g.surface, g.normal, r.tangent, r.bitangent, g.coat_normal,
                                                  r.p.v, d.l));
    }
    if (kCastsRays && d.blocked && max_component(d.direct + d.indirect) > 0.0) {
        float through = visible(r.rays, d.l, d.distance_m);
        d.direct *= through;
        d.indirect *= through;
    }
    d.direct += d.unblocked;
    if (max_component(d.direct + d.indirect) <= 0.0) return;
    vec3 diffuse;
    vec3 specular;
    evaluate(r.p, techniques(), d.l, NoL, diffuse, specular);
    lit.direct_diffuse += diffuse * (d.direct * weight);
    lit.direct_specular += specular * (d.direct * weight);
    if (kHasEnvironment && has_two_forms(techniques())) {
        evaluate(r.p, image_based_form(techniques()), d.l, NoL, diffuse, specular);
    }
    lit.indirect_diffuse += diffuse * (d.indirect * weight);
    lit.indirect_specular += specular * (d.indirect * weight);
}

const uint kStrategies = 3u;

// One sample of the integrals at a surface point; its mean over frame.random.x converges to them. Environment, emitters
// and BSDF are sampled in straight code, once a sample: a software device runs all code of a loop's body at every turn.
// What they found, and the lights that are sampled individually, then end in the same code.
Lit integrate(GBuffer g, vec3 position, vec3 v, uvec2 pixel) {
    Receiver r = receiver(surface_point(g, position, v));
    Lit lit = kNoLight;
    uint seed = pixel_seed(pixel, frame.random.y);
    ivec2 size = textureSize(background_map, 0);
    uint draws = frame.random.z;
    uint asked = kHasAsked ? asked_count() : 0u;
    float scale = 1.0 / float(draws);
    for (uint k = 0u; k < draws; ++k) {
        uint index = frame.random.x * draws + k;
        Draw sampled[kStrategies] = Draw[](kNoDraw, kNoDraw, kNoDraw);
        if (kHasEnvironment && kStrategy != kStrategyBsdf) sampled[0] = environment_draw(r, index, seed, size);
        if (kHasEmitters && kStrategy != kStrategyBsdf) sampled[1] = emitter_draw(r, index, seed);
        if (kStrategy != kStrategyLight) sampled[2] = bsdf_draw(r, index, seed, size);
        for (uint i = 0u; i < kStrategies + asked; ++i) {
            Draw d;
            if (!kHasAsked || i < kStrategies) {
                d = sampled[min(i, kStrategies - 1u)];
            } else {
                d = asked_draw(r, i - kStrategies, index, seed);
                // Of what is exact once is enough.
                if (d.only && k != 0u) continue;
                if (d.only) d.pdf *= scale;
                if (!d.only && kStrategy == kStrategyBsdf) continue;
            }
            add_draw(r, d, scale, lit);
        }
    }
    return lit;
}

#endif
