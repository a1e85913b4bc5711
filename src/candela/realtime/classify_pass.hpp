#pragma once

#include "candela/realtime/frame_resources.hpp"

namespace candela::realtime {

/// Pass 2: sorts tiles into one list a shading class, ready for indirect dispatch.
class ClassifyPass {
  public:
    ClassifyPass(const gpu::Device& device, const FrameResources& frame, const GpuScene& scene);
    void record(gpu::Commands& commands, FrameResources& frame) const;

    /// Bytes of FrameResources::tiles for this many tiles.
    [[nodiscard]] static std::size_t tile_buffer_bytes(std::uint32_t tiles);

  private:
    gpu::ComputePipeline pipeline_;
    mutable gpu::Buffer empty_lists_;  // the dispatch arguments of no tiles at all
};

}  // namespace candela::realtime
