#pragma once

#include "candela/realtime/frame.hpp"

namespace candela::realtime {

/// After the G-buffer: the shapes of the lights that the camera sees, with their luminance. Their pixels are
/// unlit ones to the passes that follow.
class ShapePass {
  public:
    ShapePass(const gpu::Device& device, const FrameResources& frame, const GpuScene& scene);
    [[nodiscard]] Surfaces add(const FrameBuild& build, Surfaces surfaces) const;

  private:
    gpu::PipelineLayout layout_;
    gpu::GraphicsPipeline pipeline_;
    std::vector<std::uint32_t> shapes_;  ///< indices into the list of lights
};

}  // namespace candela::realtime
