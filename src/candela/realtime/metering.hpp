#pragma once

#include <cstdint>
#include <span>

#include "candela/realtime/frame.hpp"

namespace candela::realtime {

/// Pass 5: histogram of the frame's luminance for the automatic exposure (Frostbite 5.1.1);
/// exposure_meter.hpp reads it.
class MeteringPass {
  public:
    explicit MeteringPass(const gpu::Device& device);
    void add(const FrameBuild& build, const Lit& lit) const;

    /// Bins of the last submitted frame; only after the device has finished it.
    [[nodiscard]] std::span<const std::uint32_t> bins() const;

  private:
    gpu::ComputePipeline pipeline_;
    mutable gpu::Buffer histogram_;
};

}  // namespace candela::realtime
