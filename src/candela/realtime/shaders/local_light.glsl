// Light of a place: reflection probes over the distant light, and irradiance volumes in its stead. C++: local_light.cpp.
#ifndef CANDELA_LOCAL_LIGHT_GLSL
#define CANDELA_LOCAL_LIGHT_GLSL

#include "octahedral.glsl"
#include "layer_reflection.glsl"
#include "probes/composition.glsl"
#include "dominant_direction.glsl"
#include "probes/parallax.glsl"
#include "probes/volume.glsl"
#include "spherical_harmonics.glsl"

// C++: LocalLightBit.
layout(constant_id = 22) const uint kLocalLight = 0u;
const uint kLocalProbes = 1u;
const uint kLocalVolumes = 2u;
const uint kLocalCapture = 4u;
const bool kCapturesProbe = (kLocalLight & kLocalCapture) != 0u;

// The same words under three types. Quad 0: x probes, y quad of the first one's record, z volumes, w of theirs; quad 1, as
// numbers: x, y tiles of the atlas, z texels of a tile, w levels.
layout(set = 0, binding = 13, std430) readonly buffer LocalQuads { uvec4 local_quads[]; };
layout(set = 0, binding = 13, std430) readonly buffer LocalVectors { vec4 local_vectors[]; };
layout(set = 0, binding = 13, std430) readonly buffer LocalWords { uint local_words[]; };
layout(set = 0, binding = 14) uniform sampler2D probe_atlas;

const uint kProbeQuads = 15u;
const uint kVolumeQuads = 6u;

vec3 to_local(uint record, vec3 direction) {
    return vec3(dot(local_vectors[record].xyz, direction), dot(local_vectors[record + 1u].xyz, direction),
                dot(local_vectors[record + 2u].xyz, direction));
}
vec3 point_to_local(uint record, vec3 position) {
    return to_local(record, position) + vec3(local_vectors[record].w, local_vectors[record + 1u].w, local_vectors[record + 2u].w);
}
vec3 from_local(uint record, vec3 direction) {
    return direction.x * local_vectors[record].xyz + direction.y * local_vectors[record + 1u].xyz +
           direction.z * local_vectors[record + 2u].xyz;
}

// One level of a probe's maps. Two explicit fetches about it: gutters differ from level to level.
vec4 probe_level(vec2 tile, vec2 encoded, float level) {
    float size = local_vectors[1].z * exp2(-level);
    vec2 within = (encoded * 0.5 + 0.5) * ((size - 2.0) / size) + 1.0 / size;
    return textureLod(probe_atlas, (tile + within) / local_vectors[1].xy, level);
}
vec4 probe_ld(vec2 tile, vec3 direction, float perceptual_roughness) {
    vec2 encoded = octahedral_encode(direction);
    float last = local_vectors[1].w - 1.0;
    float level = sqrt(perceptual_roughness) * last;
    float finer = min(floor(level), last - 1.0);
    return mix(probe_level(tile, encoded, finer), probe_level(tile, encoded, finer + 1.0), level - finer);
}

// Weight of a probe's influence at a point in its frame.
float influence_of(uint record, vec3 local) {
    vec4 size_shape = local_vectors[record + 3u];
    vec4 tile_margin = local_vectors[record + 5u];
    return probe_influence(int(size_shape.w), local, size_shape.xyz, tile_margin.z, local_vectors[record + 4u].w);
}

// What the probes reflect towards a viewer, and how much of a lobe they answer for. dominant: unit, of the lobe. reach: the
// largest influence of a probe.
ProbeSum probes_specular(vec3 position, vec3 dominant, float perceptual_roughness, out float reach) {
    ProbeSum sum = empty_probe_sum();
    reach = 0.0;
    uint record = local_quads[0].y;
    for (uint i = 0u; i < local_quads[0].x && sum.alpha < 0.999; ++i, record += kProbeQuads) {
        vec3 local = point_to_local(record, position);
        float influence = influence_of(record, local);
        if (influence <= 0.0) continue;
        reach = max(reach, influence);
        vec4 size_shape = local_vectors[record + 3u];
        ProbeLookup at = probe_lookup(int(size_shape.w), size_shape.xyz, local_vectors[record + 4u].xyz, local,
                                      to_local(record, dominant), perceptual_roughness);
        vec4 tile_unit = local_vectors[record + 5u];
        vec4 ld = probe_ld(tile_unit.xy, from_local(record, at.direction), at.perceptual_roughness);
        add_probe(sum, ld.rgb * (tile_unit.w / max(ld.a, 1.0e-4)), ld.a * influence);
    }
    return sum;
}

// The same for diffuse light, from the probes' harmonics: what captures have instead of an irradiance volume.
ProbeSum probes_diffuse(vec3 position, vec3 direction) {
    ProbeSum sum = empty_probe_sum();
    uint record = local_quads[0].y;
    for (uint i = 0u; i < local_quads[0].x && sum.alpha < 0.999; ++i, record += kProbeQuads) {
        float influence = influence_of(record, point_to_local(record, position));
        if (influence <= 0.0) continue;
        vec4 value = vec4(0.0);
        for (int k = 0; k < kShCoefficients; ++k) value += local_vectors[record + 6u + uint(k)] * sh_basis(k, direction);
        value = max(value, vec4(0.0));
        add_probe(sum, value.rgb / max(value.a, 1.0e-4), min(value.a, 1.0) * influence);
    }
    return sum;
}

// Mean and mean square of the distances that a probe sees in a direction.
vec2 probe_distances(uint first_word, vec3 direction) {
    vec2 at = (octahedral_encode(direction) * 0.5 + 0.5) * float(kDistanceSize) - 0.5;
    ivec2 low = ivec2(floor(at));
    vec2 f = at - floor(at);
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 texel = octahedral_fold(low + step, kDistanceSize);
        vec2 w = mix(1.0 - f, f, vec2(step));
        sum += unpackHalf2x16(local_words[first_word + uint(texel.y * kDistanceSize + texel.x)]) * (w.x * w.y);
    }
    // Stored as the deviation, which half floats hold better than a square.
    return vec2(sum.x, sum.x * sum.x + sum.y * sum.y);
}

// Irradiance / pi from one probe's harmonics, two a word: five words a channel.
vec3 probe_irradiance(uint quad, vec2 b[5]) {
    uvec4 q0 = local_quads[quad];
    uvec4 q1 = local_quads[quad + 1u];
    uvec4 q2 = local_quads[quad + 2u];
    uvec4 q3 = local_quads[quad + 3u];
    float red = dot(unpackHalf2x16(q0.x), b[0]) + dot(unpackHalf2x16(q0.y), b[1]) + dot(unpackHalf2x16(q0.z), b[2]) +
                dot(unpackHalf2x16(q0.w), b[3]) + dot(unpackHalf2x16(q1.x), b[4]);
    float green = dot(unpackHalf2x16(q1.y), b[0]) + dot(unpackHalf2x16(q1.z), b[1]) + dot(unpackHalf2x16(q1.w), b[2]) +
                  dot(unpackHalf2x16(q2.x), b[3]) + dot(unpackHalf2x16(q2.y), b[4]);
    float blue = dot(unpackHalf2x16(q2.z), b[0]) + dot(unpackHalf2x16(q2.w), b[1]) + dot(unpackHalf2x16(q3.x), b[2]) +
                 dot(unpackHalf2x16(q3.y), b[3]) + dot(unpackHalf2x16(q3.z), b[4]);
    return max(vec3(red, green, blue), vec3(0.0));
}

// rgb: irradiance / pi of a volume in cd/m^2; w: its influence.
vec4 volume_irradiance(uint record, vec3 position, vec3 n, vec3 v, vec3 direction) {
    vec3 local = point_to_local(record, position);
    vec4 size_fade = local_vectors[record + 3u];
    float outside_m = outside_box_m(local, size_fade.xyz);
    float influence = volume_influence(outside_m, size_fade.w);
    if (influence <= 0.0) return vec4(0.0);
    ivec3 cells = ivec3(local_quads[record + 4u].xyz);
    uvec4 places = local_quads[record + 5u];  // first quad of the harmonics, first word of the distances, nit per unit
    vec3 spacing = 2.0 * size_fade.xyz / vec3(cells);
    float least = min(spacing.x, min(spacing.y, spacing.z));
    vec3 local_n = to_local(record, n);
    // Off the surface, where the mean distances of a texel no longer hold the surface itself.
    vec3 seen_at = local + (0.8 * local_n + 0.2 * to_local(record, v)) * (0.3 * least);

    vec2 basis[5];
    for (int k = 0; k < 4; ++k) basis[k] = vec2(sh_basis(2 * k, direction), sh_basis(2 * k + 1, direction));
    basis[4] = vec2(sh_basis(8, direction), 0.0);

    vec3 at = clamp((local + size_fade.xyz) / spacing - 0.5, vec3(0.0), vec3(cells - 1));
    ivec3 low = min(ivec3(at), max(cells - 2, ivec3(0)));
    vec3 f = at - vec3(low);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    vec2 seen = vec2(0.0);
    for (int i = 0; i < 8; ++i) {
        ivec3 step = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        ivec3 cell = min(low + step, cells - 1);
        uint probe = uint((cell.z * cells.y + cell.y) * cells.x + cell.x);
        uint quad = places.x + 4u * probe;
        vec3 probe_at = (vec3(cell) + 0.5) * spacing - size_fade.xyz;
        vec3 w3 = max(mix(1.0 - f, f, vec3(step)), vec3(1.0e-3));
        // On a probe there is no direction: any will do.
        vec3 way = seen_at - probe_at + vec3(0.0, 0.0, 1.0e-6);
        vec3 to_probe = probe_at - local;
        to_probe *= inversesqrt(max(dot(to_probe, to_probe), 1.0e-12));
        float way_m = max(length(way), 1.0e-6);
        vec2 distances = probe_distances(places.y + uint(kDistanceSize * kDistanceSize) * probe, from_local(record, way));
        float visible = distance_visibility(distances.x, distances.y, way_m, 0.02 * least);
        float w = probe_weight(facing_weight(local_n, to_probe), visible) * w3.x * w3.y * w3.z;
        float valid = unpackHalf2x16(local_quads[quad + 3u].w).x;  // not inside of something
        w *= valid;
        // Distances end somewhere (truth/irradiance_bake.cpp): what is as far as that may be open.
        float open = distances.x > 1.9 * length(spacing) ? 1.0 : visible;
        seen += vec2(open, 1.0) * (valid * w3.x * w3.y * w3.z);
        sum += probe_irradiance(quad, basis) * w;
        weights += w;
    }
    influence *= influence_beyond(outside_m, seen.x / max(seen.y, 1.0e-20), 0.04 * least);
    return vec4(sum * (uintBitsToFloat(places.z) / max(weights, 1.0e-20)), weights > 0.0 ? influence : 0.0);
}

// Diffuse light in the stead of the distant one: the smallest volume first, what it leaves to the next.
vec3 local_irradiance(vec3 position, vec3 n, vec3 v, vec3 direction, vec3 distant) {
    vec3 sum = vec3(0.0);
    float rest = 1.0;
    if ((kLocalLight & kLocalVolumes) != 0u) {
        uint record = local_quads[0].w;
        for (uint i = 0u; i < local_quads[0].z && rest > 0.001; ++i, record += kVolumeQuads) {
            vec4 light = volume_irradiance(record, position, n, v, direction);
            sum += light.rgb * (light.w * rest);
            rest *= 1.0 - light.w;
        }
    }
    if ((kLocalLight & kLocalProbes) != 0u && rest > 0.001) distant = add_distant(probes_diffuse(position, direction), distant);
    return sum + rest * distant;
}

// Prefiltered light about a lobe, read in one or two places (the other's weight 0), each over what the distant light has there:
// what a probe hides is hidden from that read alone. Where no probe reaches but a volume does, the volume's smooth light is
// nearer to the truth than a sky that may be behind walls.
vec3 local_specular(vec3 position, vec3 n, vec3 v, LobeRead first, LobeRead second, vec3 first_distant, vec3 second_distant) {
    if (kCapturesProbe) return vec3(0.0);
    float reach = 0.0;
    vec3 seen_nit = vec3(0.0);
    vec3 distant_nit = vec3(0.0);
    float open = 0.0;
    for (int i = 0; i < 2; ++i) {
        LobeRead read = i == 0 ? first : second;
        if (read.weight <= 0.0) continue;
        ProbeSum seen = empty_probe_sum();
        if ((kLocalLight & kLocalProbes) != 0u) {
            seen = probes_specular(position, read.direction, read.perceptual_roughness, reach);
        }
        float open_here = read.weight * (1.0 - seen.alpha);
        seen_nit += read.weight * seen.luminance_nit;
        distant_nit += open_here * (i == 0 ? first_distant : second_distant);
        open += open_here;
    }
    if ((kLocalLight & kLocalVolumes) != 0u && reach < 0.999) {
        // The smallest volume first, as for diffuse light.
        vec3 middle = normalize(first.weight * first.direction + second.weight * second.direction);
        uint record = local_quads[0].w;
        float rest = 1.0 - reach;
        vec3 smooth_nit = vec3(0.0);
        for (uint i = 0u; i < local_quads[0].z && rest > 0.001; ++i, record += kVolumeQuads) {
            vec4 light = volume_irradiance(record, position, n, v, middle);
            smooth_nit += light.rgb * (light.w * rest);
            rest *= 1.0 - light.w;
        }
        distant_nit = open * smooth_nit + distant_nit * (reach + rest);
    }
    return seen_nit + distant_nit;
}

// A surface as a probe sees it: from one place, so without what depends on the viewer. Metals are diffuse with their f0 as
// albedo (Frostbite 4.9.1.2).
GBuffer captured_surface(GBuffer g) {
    g.surface.metallic = 0.0;
    g.surface.dielectric_f0 = vec3(0.0);
    g.surface.dielectric_f90 = vec3(0.0);
    g.surface.coat = 0.0;
    g.surface.sheen_color = vec3(0.0);
    return g;
}

#endif
