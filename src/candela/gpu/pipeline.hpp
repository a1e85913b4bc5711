#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "candela/gpu/resources.hpp"

namespace candela::gpu {

using SpirV = std::span<const std::uint32_t>;

/// Descriptor types by binding index, one list a set. Every binding is visible to every stage.
struct LayoutDesc {
    std::vector<std::vector<VkDescriptorType>> sets;
    std::uint32_t push_bytes = 0;  ///< at most 128
};

class PipelineLayout {
  public:
    PipelineLayout() = default;
    PipelineLayout(const Device& device, const LayoutDesc& desc);

    [[nodiscard]] VkPipelineLayout handle() const noexcept { return layout_.get(); }
    [[nodiscard]] VkDescriptorSetLayout set(std::size_t index) const { return sets_.at(index).get(); }
    [[nodiscard]] const LayoutDesc& desc() const noexcept { return desc_; }
    [[nodiscard]] VkShaderStageFlags push_stages() const noexcept { return VK_SHADER_STAGE_ALL; }

  private:
    std::vector<Owned<VkDescriptorSetLayout>> sets_;
    Owned<VkPipelineLayout> layout_;
    LayoutDesc desc_;
};

/// Values of `layout(constant_id = i)`, i = 0, 1, ...: int, or the bits of a float, or 0/1 for bool.
using Specialization = std::vector<std::uint32_t>;

struct ComputePipeline {
    PipelineLayout layout;
    Owned<VkPipeline> pipeline;
};
[[nodiscard]] ComputePipeline create_compute_pipeline(const Device& device, SpirV code,
                                                      const LayoutDesc& layout,
                                                      const Specialization& constants = {});

/// cover: what is there times 1 - alpha, nothing added.
enum class Blend : std::uint8_t { off, write_nothing, premultiplied_over, cover };

struct VertexAttribute {
    VkFormat format = VK_FORMAT_R32G32B32_SFLOAT;
    std::uint32_t offset = 0;
};

struct GraphicsDesc {
    SpirV vertex;
    SpirV fragment;
    Specialization constants;  ///< of both stages
    std::uint32_t vertex_stride = 0;
    std::vector<VertexAttribute> attributes;  ///< location = index, one interleaved buffer
    std::vector<VkFormat> color_formats;
    std::vector<Blend> blends;  ///< one a colour target
    VkFormat depth_format = VK_FORMAT_UNDEFINED;
    bool depth_write = true;
    bool depth_test = true;       ///< reversed: greater or equal passes
    bool cull_back_faces = true;  ///< dynamic front face: see Commands::set_front_face
};

struct GraphicsPipeline {
    Owned<VkPipeline> pipeline;
};
/// `layout` must outlive the pipeline's use. Viewport, scissor and front face are dynamic.
[[nodiscard]] GraphicsPipeline create_graphics_pipeline(const Device& device, const GraphicsDesc& desc,
                                                        const PipelineLayout& layout);

/// One descriptor to write; `index` of the initializer list is the binding.
struct Binding {
    VkBuffer buffer{};
    VkDeviceSize offset = 0;
    VkDeviceSize range = VK_WHOLE_SIZE;
    VkImageView view{};
    VkImageLayout image_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    VkSampler sampler{};
};
[[nodiscard]] inline Binding bind_buffer(const Buffer& buffer) {
    Binding b;
    b.buffer = buffer.handle();
    return b;
}
[[nodiscard]] inline Binding bind_sampled(VkImageView view, VkSampler sampler,
                                          VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) {
    Binding b;
    b.view = view;
    b.sampler = sampler;
    b.image_layout = layout;
    return b;
}
[[nodiscard]] inline Binding bind_storage(VkImageView view) {
    Binding b;
    b.view = view;
    b.image_layout = VK_IMAGE_LAYOUT_GENERAL;
    return b;
}

/// Grows by pools of 256 sets; sets live until reset() or destruction.
class DescriptorAllocator {
  public:
    explicit DescriptorAllocator(const Device& device) : device_(&device) {}
    [[nodiscard]] VkDescriptorSet allocate(const PipelineLayout& layout, std::size_t set,
                                           std::span<const Binding> bindings);
    void reset();

  private:
    void add_pool();

    const Device* device_;
    std::vector<Owned<VkDescriptorPool>> pools_;
    std::size_t current_ = 0;
};

}  // namespace candela::gpu
