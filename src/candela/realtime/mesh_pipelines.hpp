#pragma once

#include <map>

#include "candela/realtime/frame_resources.hpp"

namespace candela::realtime {

/// Pipelines that draw meshes, one for each set of features that the scene's materials need, made on first
/// use.
class MeshPipelines {
  public:
    /// `desc` is complete but for constants and culling; `variant` fills the constants beside the features.
    MeshPipelines(const gpu::Device& device, gpu::PipelineLayout layout, gpu::GraphicsDesc desc,
                  ShadeVariant variant);

    void prepare(const FrameResources& frame, const GpuScene& scene, bool blended);

    /// Draws inside begin_rendering()/end_rendering(). `set0` is bound as set 0.
    void draw(gpu::Commands& commands, const gpu::Buffer& vertices, const gpu::Buffer& indices,
              std::span<const Draw* const> draws, VkDescriptorSet set0) const;

    [[nodiscard]] const gpu::PipelineLayout& layout() const noexcept { return layout_; }

  private:
    const gpu::Device* device_;
    gpu::PipelineLayout layout_;
    gpu::GraphicsDesc desc_;
    ShadeVariant variant_;
    std::map<std::uint32_t, gpu::GraphicsPipeline> pipelines_;
    mutable std::vector<VkDescriptorSet> material_sets_;
    mutable gpu::DescriptorAllocator descriptors_;
};

/// Vertex buffer layout of `Vertex`.
void describe_vertices(gpu::GraphicsDesc& desc);

}  // namespace candela::realtime
