#pragma once

#include <vector>

#include "candela/realtime/frame_resources.hpp"

namespace candela::realtime {

/// Pass 3: lights the G-buffer, one compute pipeline a shading class over its own tiles; by the profile's
/// techniques or, when the frame integrates, by a sample of the integrals.
class LightingPass {
  public:
    LightingPass(const gpu::Device& device, const FrameResources& frame, const GpuScene& scene);
    void record(gpu::Commands& commands, FrameResources& frame, GpuScene& scene) const;

  private:
    struct ClassPipeline {
        ShadingClass shading_class;
        gpu::ComputePipeline pipeline;
    };
    std::vector<ClassPipeline> pipelines_;
};

}  // namespace candela::realtime
