#pragma once

#include "candela/realtime/blend_order.hpp"
#include "candela/realtime/frame.hpp"
#include "candela/realtime/mesh_pipelines.hpp"

namespace candela::realtime {

/// Pass 4: blended surfaces over the lit frame, back to front.
class ForwardPass {
  public:
    ForwardPass(const gpu::Device& device, const FrameResources& frame, const GpuScene& scene);
    [[nodiscard]] Lit add(const FrameBuild& build, const Surfaces& surfaces, Lit lit);

  private:
    MeshPipelines pipelines_;
    BlendOrder order_;
};

}  // namespace candela::realtime
