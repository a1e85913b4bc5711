#pragma once

#include "candela/realtime/blend_order.hpp"
#include "candela/realtime/mesh_pipelines.hpp"

namespace candela::realtime {

/// Pass 4: blended surfaces over the lit frame, back to front.
class ForwardPass {
  public:
    ForwardPass(const gpu::Device& device, const FrameResources& frame, const GpuScene& scene);
    void record(gpu::Commands& commands, FrameResources& frame, GpuScene& scene, const glm::vec3& eye,
                const glm::vec3& backward);

  private:
    MeshPipelines pipelines_;
    BlendOrder order_;
};

}  // namespace candela::realtime
