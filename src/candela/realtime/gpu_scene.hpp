#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "candela/gpu/commands.hpp"
#include "candela/realtime/light_list.hpp"
#include "candela/scene/diagnostics.hpp"
#include "candela/scene/scene.hpp"

namespace candela::realtime {

/// What a material needs from the shaders; bits of the specialization constant kFeatures
/// (shaders/material.glsl).
enum Feature : std::uint32_t {
    feature_base_color_texture = 1u << 0,
    feature_metallic_roughness_texture = 1u << 1,
    feature_normal_texture = 1u << 2,
    feature_occlusion_texture = 1u << 3,
    feature_emissive_texture = 1u << 4,
    feature_specular_texture = 1u << 5,
    feature_specular_color_texture = 1u << 6,
    feature_clearcoat_texture = 1u << 7,
    feature_clearcoat_roughness_texture = 1u << 8,
    feature_clearcoat_normal_texture = 1u << 9,
    feature_sheen_color_texture = 1u << 10,
    feature_sheen_roughness_texture = 1u << 11,
    feature_anisotropy_texture = 1u << 12,
    feature_alpha_mask = 1u << 13,
    feature_layered =
        1u << 14,  ///< clear coat, sheen, anisotropy or coloured dielectric f0: the second G-buffer
    feature_emissive = 1u << 15,
    feature_unlit = 1u << 16,
    feature_specular_glossiness = 1u << 17,
    feature_vertex_color = 1u << 18,
    feature_double_sided = 1u << 19,
    feature_uv1 = 1u << 20,
    feature_fully_rough = 1u << 21,  ///< scene::is_fully_rough() under the profile
};
inline constexpr std::uint32_t kMaterialTextures = 13;

/// Interleaved vertex as the shaders read it.
struct Vertex {
    glm::vec3 position{0.0f};
    std::int16_t normal[4]{};   // snorm
    std::int16_t tangent[4]{};  // snorm, w = handedness
    glm::vec2 uv0{0.0f};
    glm::vec2 uv1{0.0f};
    std::uint16_t color[4]{};  // unorm
};

struct Draw {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    std::int32_t vertex_offset = 0;
    std::uint32_t material = 0;
    std::uint32_t instance = 0;  ///< index into Scene::instances
    std::uint32_t features = 0;
    glm::mat4 world{1.0f};
    glm::vec3 world_center{0.0f};  ///< for sorting
    scene::Aabb world_bounds;
    bool mirrored = false;
    bool blended = false;
    std::uint32_t blended_surface = 0;  ///< into GpuScene::blended_surfaces
};

/// What sorting the triangles of a blended surface needs on the host.
struct BlendedSurface {
    std::vector<glm::vec3> centroids;    ///< object space, one a triangle
    std::vector<std::uint32_t> indices;  ///< three a triangle
};

/// A scene's geometry, textures, materials and lights in device memory. Lives as long as its device.
class GpuScene {
  public:
    /// with_emissive: emissive surfaces are lights too. filtered_textures: mip maps; without them the texels
    /// of the file are read at any distance, as an integral over the pixel wants them. fully_rough: the
    /// profile's.
    GpuScene(const gpu::Device& device, gpu::Commands& commands, const scene::Scene& scene,
             bool with_emissive, bool filtered_textures, scene::FullyRoughRule fully_rough);

    /// Tells the shaders where each light's shadow is: its place in the plan by index into Scene::lights, -1:
    /// none. Submits.
    void link_shadows(const gpu::Device& device, gpu::Commands& commands, std::span<const int> places);

    gpu::Buffer vertices;
    gpu::Buffer indices;
    gpu::Buffer materials;  ///< uniform blocks, material_stride apart
    LightList light_list;
    gpu::Buffer lights;         ///< storage, LightList::blocks
    gpu::Buffer light_reaches;  ///< storage, LightList::reaches
    gpu::Buffer light_tables;   ///< storage, LightList::tables
    std::uint32_t light_count = 0;
    std::uint32_t visible_shapes = 0;  ///< lights that the camera sees as what they are
    std::vector<Draw> draws;
    std::vector<BlendedSurface> blended_surfaces;
    bool any_emissive = false;  ///< emissive or unlit surfaces among the opaque draws
    bool any_layered = false;
    bool any_unlit = false;  ///< opaque or blended
    bool any_blended = false;
    bool any_normal_mapped = false;

    /// Layout of set 1: the material's uniform block and its textures.
    [[nodiscard]] static std::vector<VkDescriptorType> material_set_layout();
    /// Bindings of set 1 for one material.
    [[nodiscard]] std::vector<gpu::Binding> material_bindings(std::uint32_t material) const;

  private:
    void upload_geometry(const gpu::Device& device, gpu::Commands& commands, const scene::Scene& scene,
                         scene::FullyRoughRule fully_rough);
    void upload_textures(const gpu::Device& device, gpu::Commands& commands, const scene::Scene& scene,
                         bool filtered);
    void upload_materials(const gpu::Device& device, gpu::Commands& commands, const scene::Scene& scene);
    void upload_lights(const gpu::Device& device, gpu::Commands& commands);

    struct TextureSlot {
        std::uint32_t image = 0;    // into images_
        std::uint32_t sampler = 0;  // into samplers_
    };
    std::vector<gpu::Image> images_;
    std::vector<gpu::Owned<VkSampler>> samplers_;
    std::vector<std::array<TextureSlot, kMaterialTextures>> material_textures_;
    VkDeviceSize material_stride_ = 0;
    VkDeviceSize material_bytes_ = 0;
};

}  // namespace candela::realtime
