#include "candela/realtime/material_block.hpp"

#include <cmath>

#include "shading/fresnel.glsl"

namespace candela::realtime {

std::array<const scene::TextureRef*, kMaterialTextures> texture_refs(const scene::Material& m) {
    return {&m.base_color_texture,       &m.metallic_roughness_texture, &m.normal_texture,
            &m.occlusion_texture,        &m.emissive_texture,           &m.specular_texture,
            &m.specular_color_texture,   &m.clearcoat.texture,          &m.clearcoat.roughness_texture,
            &m.clearcoat.normal_texture, &m.sheen.color_texture,        &m.sheen.roughness_texture,
            &m.anisotropy.texture};
}

namespace {

/// Karis 2014: "Metallic and Specular material outputs aren't connected".
bool default_nonmetal(const scene::Material& m) {
    return m.workflow == scene::Workflow::metallic_roughness && m.metallic == 0.0f && m.specular == 1.0f &&
           !m.specular_texture && m.specular_color == glm::vec3(1.0f) && !m.specular_color_texture &&
           m.ior == 1.5f;
}

}  // namespace

MaterialBlock material_block(const scene::Material& m) {
    MaterialBlock block{};
    block.base_color = m.base_color;
    block.emissive_nit = glm::vec4(m.emissive_nit, m.alpha_cutoff);
    block.specular_color = glm::vec4(m.specular_color, m.specular);
    block.metallic_roughness =
        glm::vec4(m.metallic, m.perceptual_roughness, m.normal_scale, m.occlusion_strength);
    block.sheen = glm::vec4(m.sheen.color, m.sheen.perceptual_roughness);
    block.clearcoat_anisotropy = glm::vec4(m.clearcoat.factor, m.clearcoat.perceptual_roughness,
                                           m.clearcoat.normal_scale, m.anisotropy.strength);
    const float f0 = m.ior > 0.0f ? shading::f0_from_ior(m.ior) : 1.0f;
    block.f0_rotation = glm::vec4(f0, std::cos(m.anisotropy.rotation_rad),
                                  std::sin(m.anisotropy.rotation_rad), default_nonmetal(m) ? 1.0f : 0.0f);
    const auto refs = texture_refs(m);
    for (std::size_t i = 0; i < refs.size(); ++i) {
        const scene::TextureRef& ref = *refs[i];
        const float c = std::cos(ref.rotation_rad);
        const float s = std::sin(ref.rotation_rad);
        // KHR_texture_transform: translation * rotation * scale, uv with v down, counter-clockwise angle.
        block.uv[2 * i] =
            glm::vec4(c * ref.scale.x, s * ref.scale.y, ref.offset.x, static_cast<float>(ref.uv_set));
        block.uv[2 * i + 1] = glm::vec4(-s * ref.scale.x, c * ref.scale.y, ref.offset.y, 0.0f);
    }
    return block;
}

std::uint32_t material_features(const scene::Material& m, scene::FullyRoughRule fully_rough) {
    std::uint32_t features = 0;
    const auto refs = texture_refs(m);
    for (std::size_t slot = 0; slot < refs.size(); ++slot) {
        if (!*refs[slot]) continue;
        features |= 1u << slot;
        if (refs[slot]->uv_set == 1) features |= feature_uv1;
    }
    const bool colored_f0 = m.specular_color != glm::vec3(1.0f) || m.specular_color_texture ||
                            m.workflow == scene::Workflow::specular_glossiness;
    const bool sheen = m.sheen.color != glm::vec3(0.0f);
    if (m.clearcoat.factor > 0.0f || sheen || m.anisotropy.strength > 0.0f || colored_f0)
        features |= feature_layered;
    if (m.emissive_nit != glm::vec3(0.0f)) features |= feature_emissive;
    if (m.alpha_mode == scene::AlphaMode::mask) features |= feature_alpha_mask;
    if (m.unlit) features |= feature_unlit;
    if (m.workflow == scene::Workflow::specular_glossiness) features |= feature_specular_glossiness;
    if (m.double_sided) features |= feature_double_sided;
    if (scene::is_fully_rough(m, fully_rough)) features |= feature_fully_rough;
    return features;
}

}  // namespace candela::realtime
