#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "candela/realtime/frame_resources.hpp"

namespace candela::realtime {

/// Pass 5: histogram of the frame's luminance for the automatic exposure (Frostbite 5.1.1).
class MeteringPass {
  public:
    static constexpr std::uint32_t kBins = 256;

    explicit MeteringPass(const gpu::Device& device);
    void record(gpu::Commands& commands, FrameResources& frame) const;

    /// Bins of the last submitted frame; only after the device has finished it.
    [[nodiscard]] std::span<const std::uint32_t> bins() const;

  private:
    gpu::ComputePipeline pipeline_;
    mutable gpu::Buffer histogram_;
};

/// Average log2 luminance, in stops relative to the histogram's unit, of the bins between two fractions of
/// all metered pixels: extremes (lamps, deep shadow) do not pull the exposure. Returns false when nothing was
/// metered.
[[nodiscard]] bool average_log2_luminance(std::span<const std::uint32_t> bins, double low_fraction,
                                          double high_fraction, float& stops);

/// The EV100 that the automatic exposure gives a finished picture (luminance in cd/m^2), by the same
/// histogram and the same fractions as the frame's; nullopt when it is black.
[[nodiscard]] std::optional<float> metered_ev100(std::span<const glm::vec4> light_nit);

}  // namespace candela::realtime
