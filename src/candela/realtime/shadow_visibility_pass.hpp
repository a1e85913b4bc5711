#pragma once

#include <map>

#include "candela/realtime/frame.hpp"
#include "candela/realtime/shadow_plan.hpp"
#include "candela/realtime/shadow_views.hpp"

namespace candela::realtime {

/// How much of each light the opaque surfaces see: a byte a pixel and light, before they are lit. One
/// dispatch a light, with a pipeline for its kind of map and its shape.
class ShadowVisibilityPass {
  public:
    ShadowVisibilityPass(const gpu::Device& device, const FrameResources& frame,
                         std::span<const scene::Light> lights);

    /// Lights whose visibility finds room: 128 MiB, and 16 lights whatever the size of the picture.
    [[nodiscard]] static std::size_t most_lights(const FrameResources& frame);
    /// Makes room for that many lights. Between submissions.
    static void reserve(const gpu::Device& device, FrameResources& frame, std::size_t lights);

    /// The plan's lights are indices into `lights`. Both outlive the graph; the plan may change between
    /// executions.
    [[nodiscard]] gpu::BufferRef add(const FrameBuild& build, const gpu::ImageRef& shadow_maps,
                                     const Surfaces& surfaces, const ShadowPlan& plan,
                                     const std::vector<scene::Light>& lights) const;

  private:
    using Variant = std::pair<ShadowKind, ShadowShape>;
    [[nodiscard]] static Variant variant_of(const FrameResources& frame, const scene::Light& light);
    void find_visibility(gpu::PassContext& c, const FrameBuild& build, gpu::Image& receivers,
                         const ShadowPlan& plan, const std::vector<scene::Light>& lights) const;

    gpu::ComputePipeline receivers_;
    std::map<Variant, gpu::ComputePipeline> pipelines_;
};

}  // namespace candela::realtime
