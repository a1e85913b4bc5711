#pragma once

#include <vector>

#include "candela/realtime/frame.hpp"

namespace candela::realtime {

/// Pass 3: lights the G-buffer, one compute pipeline a shading class over its own tiles; by the profile's
/// techniques or, when the frame integrates, by a sample of the integrals.
class LightingPass {
  public:
    LightingPass(const gpu::Device& device, const FrameResources& frame, const GpuScene& scene);
    [[nodiscard]] Lit add(const FrameBuild& build, const Surfaces& surfaces, const Tiles& tiles) const;

  private:
    struct ClassPipeline {
        ShadingClass shading_class;
        gpu::ComputePipeline pipeline;
    };
    std::vector<ClassPipeline> pipelines_;
};

}  // namespace candela::realtime
