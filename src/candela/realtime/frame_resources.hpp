#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "candela/bake/environment.hpp"
#include "candela/gpu/commands.hpp"
#include "candela/realtime/gpu_scene.hpp"
#include "candela/realtime/integrate_pass.hpp"
#include "candela/realtime/local_light.hpp"
#include "candela/realtime/profile.hpp"
#include "candela/scene/half_range.hpp"

namespace candela::realtime {

/// std140 layout of shaders/frame.glsl.
struct FrameBlock {
    glm::mat4 world_to_clip;
    glm::mat4 clip_to_world;
    glm::vec4 camera_position;
    glm::vec4 camera_backward;
    glm::vec4 exposure;
    glm::vec4 environment;
    glm::ivec4 size;
    glm::ivec4 tiles;
    glm::vec4 ray;
    glm::vec4 ray_dx;
    glm::vec4 ray_dy;
    glm::ivec4 lights;
    glm::ivec4 light_cells;
    glm::vec4 light_slices;
    glm::uvec4 random;
};

/// Where things are in FrameResources::light_lists, in words: entries used of the room, heads of the tiles'
/// lists, heads of the cells' lists, the list of all lights, room for the other lists. A head is where its
/// list begins.
struct LightListPlaces {
    std::int32_t first_cell = 0;
    std::int32_t first_all = 0;
    std::int32_t first_room = 0;
    std::int32_t room = 0;
    glm::ivec3 cells{0};
};

/// Shading classes of shaders/gbuffer.glsl.
enum class ShadingClass : std::uint32_t { background, standard, layered, unlit };
inline constexpr std::uint32_t kShadingClasses = 4;
inline constexpr std::uint32_t kTileSize = 8;

inline constexpr VkFormat kGBufferFormat = VK_FORMAT_R32G32B32A32_UINT;
inline constexpr VkFormat kUnlitFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
inline constexpr VkFormat kIdFormat = VK_FORMAT_R32G32_UINT;
inline constexpr VkFormat kSurfaceNormalFormat = VK_FORMAT_R32_UINT;
inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
inline constexpr VkFormat kPictureFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

/// The images that AOVs are made of, each the size of the picture.
enum class Aov : std::uint8_t {
    direct_diffuse,
    direct_specular,
    indirect_diffuse,
    indirect_specular,
    emissive,
    albedo,
    normal,
    distance,
};
/// The first five are written by the lighting pass.
inline constexpr std::size_t kLightingAovs = 5;
inline constexpr std::size_t kAovCount = 8;

/// What the passes of a frame share and what lives longer than one. Made by the Renderer. What lives within a
/// frame is in its graph (frame.hpp).
struct FrameResources {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t tiles_x = 0;
    std::uint32_t tiles_y = 0;
    std::size_t most_storage_bytes = std::size_t{128} << 20u;  ///< that a binding may have
    Profile profile;
    std::optional<Strategy> integrate;  ///< the integrals themselves instead of the profile's techniques
    bool half_light = false;            ///< the light buffer is of half floats
    bool write_aovs = false;
    bool has_environment = false;
    std::uint32_t shadow_kinds = 0;  ///< of shadow_kind_bits(); 0: every light shines through everything
    bool has_unlit = false;          ///< unlit colours are kept apart from light
    bool all_targets = false;        ///< the G-buffer pass also writes emission, layers and ids
    bool normal_mapped = false;      ///< and the normals without maps

    gpu::Buffer frame_block;     ///< FrameBlock, host visible
    bool culled_lights = false;  ///< tiles and cells have lists of their own
    LightListPlaces light_places;
    gpu::Buffer light_lists;
    gpu::Image shadow_atlas;     ///< 1 x 1 without shadows; reversed depth, one tile a view of a light
    gpu::Buffer shadow_records;  ///< ShadowRecord, host visible
    gpu::Buffer visibilities;  ///< a byte a pixel and light: tiles of 64 bytes, of one light after the other

    gpu::Image no_layers;   ///< 1 x 1, bound where the frame has none
    gpu::Image no_normals;  ///< the same

    gpu::Image dfg;
    gpu::Image ltc;  ///< 1 x 1 without area lights
    bake::EnvironmentMaps environment;
    IntegrateTables integrate_tables;
    LocalLight local;
    gpu::Owned<VkSampler> clamp;     ///< linear, clamp to edge
    gpu::Owned<VkSampler> repeat_u;  ///< linear, repeats in u
    gpu::Owned<VkSampler> nearest;

    /// Half floats are enough for a frame that is shown. What is above them in one sample of a still belongs
    /// to the mean, and so do samples of an integral, which may be far above it.
    [[nodiscard]] VkFormat light_format() const noexcept {
        return half_light ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT;
    }
    /// The largest number that fits the light buffer; of 32 bit floats, one that sums of samples stay below.
    [[nodiscard]] float light_limit() const noexcept { return half_light ? scene::kLargestHalf : 1.0e30f; }
    [[nodiscard]] std::uint32_t tile_count() const noexcept { return tiles_x * tiles_y; }
};

/// Specialization constants 0...28 of material.glsl, shade.glsl, lights.glsl and others.
struct ShadeVariant {
    std::uint32_t features = 0;
    ShadingClass shading_class = ShadingClass::standard;
    bool layers = false;
    std::uint32_t light_kinds = 0;
    bool emissive = false;
    bool forward = false;
};
[[nodiscard]] gpu::Specialization specialization(const FrameResources& frame, const ShadeVariant& variant);

/// Descriptor types and bindings 0...14 of set 0, which the lighting and the forward pass share.
[[nodiscard]] std::vector<VkDescriptorType> shading_set_layout();
[[nodiscard]] std::vector<gpu::Binding> shading_bindings(const FrameResources& frame, const GpuScene& scene);

/// Work groups of `group` that cover `size`.
[[nodiscard]] constexpr std::uint32_t groups(std::uint32_t size, std::uint32_t group) {
    return (size + group - 1) / group;
}

}  // namespace candela::realtime
