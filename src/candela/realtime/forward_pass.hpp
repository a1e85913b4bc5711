#pragma once

#include "candela/realtime/mesh_pipelines.hpp"

namespace candela::realtime {

/// Pass 4: blended surfaces over the lit frame, sorted back to front by the centre of their bounds.
class ForwardPass {
  public:
    ForwardPass(const gpu::Device& device, const FrameResources& frame, const GpuScene& scene);
    void record(gpu::Commands& commands, FrameResources& frame, GpuScene& scene, const glm::vec3& eye,
                const glm::vec3& backward) const;

  private:
    MeshPipelines pipelines_;
};

}  // namespace candela::realtime
