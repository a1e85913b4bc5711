#version 460
#extension GL_GOOGLE_include_directive : require
// One level of the LD term (Frostbite 4.9.2, equation 53: weighted by N.L, N = V = R), by filtered importance sampling
// (Krivanek & Colbert 2008): each sample reads the level of the source whose texels are as large as its share of the
// sphere, so that few samples see everything and no small sun is missed.
#include "basis.glsl"
#include "octahedral_map.glsl"
#include "sampling.glsl"
#include "sequence.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D source;
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D level_image;
layout(push_constant) uniform Push {
    int size;           // texels a side of the level, gutters included
    int sample_count;
    float alpha;
    float source_size;  // of level 0 of the source
    float source_levels;
    int left;  // texels before the level's first column in the image
};

// Direction of a texel; a gutter is the interior texel across the fold (OctahedralMap).
vec3 texel_direction(ivec2 texel) {
    vec2 e = octahedral_unfolded((vec2(texel) - 0.5) / float(size - 2) * 2.0 - 1.0);
    return octahedral_decode(e);
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(size)))) return;
    vec3 n = texel_direction(texel);
    vec3 t;
    vec3 b;
    orthonormal_basis(n, t, b);
    float interior = source_size - 2.0;
    float texel_solid_angle = 4.0 * PI / (interior * interior);
    vec3 sum = vec3(0.0);
    float weight = 0.0;
    for (uint i = 0u; i < uint(sample_count); ++i) {
        vec3 h = sample_ggx_ndf(hammersley(i, uint(sample_count)) + vec2(0.5 / float(sample_count), 0.0), alpha);
        float NoL = 2.0 * h.z * h.z - 1.0;
        if (NoL <= 0.0) continue;
        vec3 l = to_world(vec3(2.0 * h.z * h.x, 2.0 * h.z * h.y, NoL), t, b, n);
        // Half-vector density over solid angle of l, with v = n: D NoH / (4 VoH) = D / 4.
        float pdf = pdf_reflected(pdf_ggx_ndf(h, alpha), h.z);
        float share = 1.0 / (float(sample_count) * pdf);
        // Without Krivanek & Colbert's bias of one level up: it brightens what is beside a bright half by 5 %.
        float level = clamp(0.5 * log2(share / texel_solid_angle), 0.0, source_levels - 1.0);
        float finer = min(floor(level), source_levels - 2.0);
        float finer_size = source_size * exp2(-finer);
        vec2 encoded = octahedral_encode(l);
        vec3 radiance = mix(sample_octahedral(source, encoded, finer_size, finer),
                            sample_octahedral(source, encoded, 0.5 * finer_size, finer + 1.0), level - finer);
        sum += radiance * NoL;
        weight += NoL;
    }
    imageStore(level_image, texel + ivec2(left, 0), vec4(sum / weight, 1.0));
}
