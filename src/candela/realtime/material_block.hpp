#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>

#include "candela/realtime/gpu_scene.hpp"
#include "candela/scene/material.hpp"

namespace candela::realtime {

/// Order of a material's textures: binding = 1 + slot (shaders/material.glsl).
enum TextureSlotName : std::size_t {
    slot_base_color,
    slot_metallic_roughness,
    slot_normal,
    slot_occlusion,
    slot_emissive,
    slot_specular,
    slot_specular_color,
    slot_clearcoat,
    slot_clearcoat_roughness,
    slot_clearcoat_normal,
    slot_sheen_color,
    slot_sheen_roughness,
    slot_anisotropy,
};

/// std140 layout of the uniform block in shaders/material.glsl.
struct MaterialBlock {
    glm::vec4 base_color;
    glm::vec4 emissive_nit;        // w: alpha cutoff
    glm::vec4 specular_color;      // coloured dielectric f0 factor (or the specular colour of
                                   // specular-glossiness); w: f90 weight
    glm::vec4 metallic_roughness;  // x metallic, y perceptual roughness, z normal scale, w occlusion strength
    glm::vec4 sheen;               // rgb, w perceptual roughness
    glm::vec4 clearcoat_anisotropy;  // x coat, y coat perceptual roughness, z coat normal scale, w anisotropy
                                     // strength
    glm::vec4 f0_rotation;  // x dielectric f0 from ior, y cos, z sin of the anisotropy rotation, w 1 where
                            // metallic and specular are at their defaults
    std::array<glm::vec4, 2 * kMaterialTextures> uv;  // rows of the 2 x 3 transform; first row's w: uv set
};

[[nodiscard]] MaterialBlock material_block(const scene::Material& material);

/// The material's texture uses in slot order.
[[nodiscard]] std::array<const scene::TextureRef*, kMaterialTextures> texture_refs(
    const scene::Material& material);

/// Bits of Feature that follow from the material alone.
[[nodiscard]] std::uint32_t material_features(const scene::Material& material,
                                              scene::FullyRoughRule fully_rough);

}  // namespace candela::realtime
