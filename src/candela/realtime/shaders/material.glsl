// Evaluates every factor and texture of glTF 2.0 and the KHR_materials_* extensions into a G-buffer entry.
#ifndef CANDELA_MATERIAL_GLSL
#define CANDELA_MATERIAL_GLSL

#include "base_color.glsl"
#include "footprint.glsl"
#include "fully_rough.glsl"
#include "gbuffer.glsl"

layout(constant_id = 28) const int kNormalMapFilter = 0;

layout(location = 0) in vec3 in_normal;
layout(location = 1) in vec4 in_tangent;

// A read of a normal map: its unit normal before and after the scale, and the length of the average that filtering made it
// from, in the levels (C++: mip_chain) and in this read, which says how much roughness was lost (Frostbite 5.3).
struct MappedNormal {
    vec3 scaled;
    float z;
    float average_length;
};
MappedNormal mapped_normal(sampler2D map, vec2 uv, float scale) {
    vec4 texel = texture(map, uv);
    vec3 n = texel.xyz * 2.0 - 1.0;
    vec3 scaled = vec3(n.xy * scale, n.z);
    float n_length = sqrt(max(dot(n, n), 1e-12));
    vec2 texels = vec2(textureSize(map, 0));
    float texels_per_pixel = max(length(dFdx(uv) * texels), length(dFdy(uv) * texels));
    // Integrals read the file's texels alone, and have the spread from their samples.
    if (textureQueryLevels(map) == 1) texels_per_pixel = 0.0;
    return MappedNormal(scaled * inversesqrt(max(dot(scaled, scaled), 1e-12)), n.z / n_length,
                        filtered_normal_length(average_normal_length(texel.a), n_length, texels_per_pixel));
}

// The material at this fragment. `facing` is +1 on front faces; derivatives must be defined here.
GBuffer evaluate_material(vec4 base_alpha, float facing, out vec3 emissive_nit) {
    GBuffer g;
    g.shading_class = has(kUnlit) ? kClassUnlit : has(kLayered) ? kClassLayered : kClassStandard;
    vec3 vertex_normal = normalize(in_normal) * facing;
    vec3 tangent = in_tangent.xyz;
    vec3 bitangent = in_tangent.w * cross(in_normal, in_tangent.xyz) * facing;
    g.normal = vertex_normal;
    g.surface_normal = vertex_normal;
    MappedNormal mapped = MappedNormal(vec3(0.0, 0.0, 1.0), 1.0, 1.0);
    if (has(kNormalTexture)) {
        mapped = mapped_normal(normal_map, slot_uv(2), material.metallic_roughness.z);
        vec3 t = mapped.scaled;
        g.normal = normalize(t.x * tangent + t.y * bitangent + t.z * vertex_normal);
    }

    emissive_nit = vec3(0.0);
    if (has(kEmissive)) {
        emissive_nit = material.emissive_nit.rgb;
        if (has(kEmissiveTexture)) emissive_nit *= texture(emissive_map, slot_uv(4)).rgb;
    }

    g.occlusion = 1.0;
    if (has(kOcclusionTexture)) {
        g.occlusion = 1.0 + material.metallic_roughness.w * (texture(occlusion_map, slot_uv(3)).r - 1.0);
    }

    Surface s;
    s.base_color = base_alpha.rgb;
    s.metallic = material.metallic_roughness.x;
    s.perceptual_roughness = material.metallic_roughness.y;
    vec3 specular_color = material.specular_color.rgb;
    float specular = material.specular_color.w;
    if (has(kSpecularGlossiness)) {
        float glossiness = 1.0 - material.metallic_roughness.y;
        if (has(kMetallicRoughnessTexture)) {
            vec4 sg = texture(metallic_roughness_map, slot_uv(1));
            specular_color *= sg.rgb;
            glossiness *= sg.a;
        }
        s.metallic = 0.0;
        s.perceptual_roughness = 1.0 - glossiness;
        s.base_color *= 1.0 - max_component(specular_color);
        s.dielectric_f0 = specular_color;
        s.dielectric_f90 = vec3(1.0);
    } else {
        if (has(kMetallicRoughnessTexture)) {
            vec4 mr = texture(metallic_roughness_map, slot_uv(1));
            s.perceptual_roughness *= mr.g;
            s.metallic *= mr.b;
        }
        if (has(kSpecularTexture)) specular *= texture(specular_map, slot_uv(5)).a;
        if (has(kSpecularColorTexture)) specular_color *= texture(specular_color_map, slot_uv(6)).rgb;
        s.dielectric_f0 = min(material.f0_rotation.x * specular_color, vec3(1.0)) * specular;
        s.dielectric_f90 = vec3(specular);
    }

    s.coat = 0.0;
    s.coat_perceptual_roughness = 0.0;
    s.sheen_color = vec3(0.0);
    s.sheen_perceptual_roughness = 0.0;
    s.anisotropy = 0.0;
    g.coat_normal = vertex_normal;
    g.tangent = vec3(1.0, 0.0, 0.0);
    if (has(kLayered)) {
        s.coat = material.clearcoat_anisotropy.x;
        if (has(kClearcoatTexture)) s.coat *= texture(clearcoat_map, slot_uv(7)).r;
        s.coat_perceptual_roughness = material.clearcoat_anisotropy.y;
        if (has(kClearcoatRoughnessTexture)) {
            s.coat_perceptual_roughness *= texture(clearcoat_roughness_map, slot_uv(8)).g;
        }
        if (has(kClearcoatNormalTexture)) {
            float scale = material.clearcoat_anisotropy.z;
            MappedNormal coat = mapped_normal(clearcoat_normal_map, slot_uv(9), scale);
            vec3 t = coat.scaled;
            g.coat_normal = normalize(t.x * tangent + t.y * bitangent + t.z * vertex_normal);
            s.coat_perceptual_roughness =
                perceptual_roughness_under_map(s.coat_perceptual_roughness, coat.average_length, coat.z, scale,
                                               kNormalMapFilter);
        }
        s.sheen_color = material.sheen.rgb;
        if (has(kSheenColorTexture)) s.sheen_color *= texture(sheen_color_map, slot_uv(10)).rgb;
        s.sheen_perceptual_roughness = material.sheen.w;
        if (has(kSheenRoughnessTexture)) s.sheen_perceptual_roughness *= texture(sheen_roughness_map, slot_uv(11)).a;
        s.anisotropy = material.clearcoat_anisotropy.w;
        vec2 direction = vec2(1.0, 0.0);
        if (has(kAnisotropyTexture)) {
            vec3 a = texture(anisotropy_map, slot_uv(12)).rgb;
            direction = a.rg * 2.0 - 1.0;
            s.anisotropy *= a.b;
        }
        vec2 rotation = material.f0_rotation.yz;
        direction = vec2(rotation.x * direction.x - rotation.y * direction.y,
                         rotation.y * direction.x + rotation.x * direction.y);
        vec3 along = direction.x * tangent + direction.y * bitangent;
        along -= g.normal * dot(g.normal, along);
        g.tangent = dot(along, along) > 1e-12 ? normalize(along) : vec3(1.0, 0.0, 0.0);
    }

    if (has(kNormalTexture)) {
        s.perceptual_roughness = perceptual_roughness_under_map(s.perceptual_roughness, mapped.average_length, mapped.z,
                                                                material.metallic_roughness.z, kNormalMapFilter);
    }
    if (kSpecularAa != 0) {
        float pixels = frame.exposure.z;
        vec3 dndx = dFdx(g.normal) * pixels;
        vec3 dndy = dFdy(g.normal) * pixels;
        s.perceptual_roughness = sqrt(alpha_filtered(s.perceptual_roughness * s.perceptual_roughness, dndx, dndy));
        if (has(kLayered)) {
            dndx = dFdx(g.coat_normal) * pixels;
            dndy = dFdy(g.coat_normal) * pixels;
            float alpha = s.coat_perceptual_roughness * s.coat_perceptual_roughness;
            s.coat_perceptual_roughness = sqrt(alpha_filtered(alpha, dndx, dndy));
        }
    }
    g.default_nonmetal = material.f0_rotation.w != 0.0;
    if (has(kFullyRough)) s = fully_rough_surface(s);
    g.surface = s;
    return g;
}

#endif
