#pragma once

#include <map>

#include "candela/realtime/frame.hpp"
#include "candela/realtime/shadow_views.hpp"
#include "candela/realtime/shadow_visibility_pass.hpp"

namespace candela::realtime {

/// Pass 0: the shadow atlas, and before surfaces are lit what they see of its lights. Every light that casts
/// shadows draws the scene's opaque and masked surfaces as it sees them; blended ones let all light through.
/// What does not follow the camera is drawn once.
class ShadowPass {
  public:
    ShadowPass(const gpu::Device& device, const FrameResources& frame, const GpuScene& gpu_scene,
               const scene::Scene& scene, std::uint32_t atlas_texels);

    /// Decides what has to be drawn for this camera, and tells the shaders. Between submissions. `moving`: a
    /// frame of a camera that may have moved draws its cascades whether it did or not.
    void prepare(gpu::Commands& commands, FrameResources& frame, GpuScene& gpu_scene,
                 const scene::Camera& camera, bool moving);
    /// The shadow atlas.
    [[nodiscard]] gpu::ImageRef add_maps(const FrameBuild& build);
    /// After the surfaces are drawn: what they see of each light.
    [[nodiscard]] gpu::BufferRef add_visibility(const FrameBuild& build, const gpu::ImageRef& shadow_maps,
                                                const Surfaces& surfaces) const;

    /// Lights that should cast shadows but found no room in the atlas.
    [[nodiscard]] std::uint32_t unshadowed() const noexcept { return plan_.unshadowed; }

  private:
    void make_pipelines(const FrameResources& frame, const GpuScene& gpu_scene);
    void set_plan(gpu::Commands& commands, FrameResources& frame, GpuScene& gpu_scene, ShadowPlan plan);
    void set_records(std::size_t slot, std::span<const ShadowRecord> records);
    void draw_pending(gpu::Commands& commands, FrameResources& frame, const GpuScene& gpu_scene);
    void draw(gpu::Commands& commands, const ShadowView& view, const GpuScene& gpu_scene);

    const gpu::Device* device_;
    std::uint32_t budget_texels_;
    scene::Aabb bounds_;
    std::vector<scene::Aabb> boxes_;    ///< of what is drawn
    std::vector<scene::Light> lights_;  ///< of the scene, then emissive surfaces
    ShadowVisibilityPass visibility_;
    std::uint32_t first_emissive_ = 0;
    ShadowPlan plan_;
    std::vector<ShadowRequest> planned_for_;
    std::vector<ShadowRecord> records_;
    std::vector<ShadowView> cascades_;  ///< as drawn last
    std::vector<ShadowView> pending_;
    bool fresh_atlas_ = false;
    gpu::PipelineLayout layout_;
    std::map<std::uint32_t, gpu::GraphicsPipeline> pipelines_;
    std::vector<VkDescriptorSet> material_sets_;
    gpu::DescriptorAllocator descriptors_;
};

/// Bits of the specialization constant kShadowKinds: 1 << ShadowKind for each kind that the scene's lights
/// need, then one for lights with extent and one for those without.
[[nodiscard]] std::uint32_t shadow_kind_bits(const scene::Scene& scene,
                                             std::span<const scene::Light> emissive_shapes);

}  // namespace candela::realtime
