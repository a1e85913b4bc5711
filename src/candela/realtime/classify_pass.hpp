#pragma once

#include "candela/realtime/frame.hpp"

namespace candela::realtime {

/// Pass 2: sorts tiles into one list a shading class, ready for indirect dispatch.
class ClassifyPass {
  public:
    ClassifyPass(const gpu::Device& device, const FrameResources& frame, const GpuScene& scene);
    [[nodiscard]] Tiles add(const FrameBuild& build, const Surfaces& surfaces) const;

  private:
    gpu::ComputePipeline pipeline_;
    mutable gpu::Buffer empty_lists_;  // the dispatch arguments of no tiles at all
};

}  // namespace candela::realtime
