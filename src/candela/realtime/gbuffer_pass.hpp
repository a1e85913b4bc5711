#pragma once

#include "candela/realtime/frame.hpp"
#include "candela/realtime/mesh_pipelines.hpp"

namespace candela::realtime {

/// Pass 1: rasterizes every opaque and masked surface into the G-buffer; emissive and unlit colour go
/// straight into the light buffer.
class GBufferPass {
  public:
    GBufferPass(const gpu::Device& device, const FrameResources& frame, const GpuScene& scene);
    /// With the unlit colours cleared, which surfaces are drawn into later.
    [[nodiscard]] Surfaces add(const FrameBuild& build) const;

  private:
    MeshPipelines pipelines_;
};

}  // namespace candela::realtime
