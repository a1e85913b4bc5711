#pragma once

#include <array>
#include <vector>

#include "candela/realtime/frame.hpp"

namespace candela::realtime {

/// Last passes of a still: sums samples in 32 bit, unpacks the G-buffer's AOVs and reads everything back.
class PicturePass {
  public:
    PicturePass(const gpu::Device& device, const FrameResources& frame);

    /// Adds this frame to the sums; the view's first sample starts new ones.
    void add(const FrameBuild& build, const Surfaces& surfaces, const Lit& lit);

    /// RGBA planes, row 0 on top: the sum of the samples divided by their number. Submits and waits.
    struct Planes {
        /// a: the fraction of the pixel that shows light and not unlit surfaces.
        std::vector<glm::vec4> light_nit;
        std::vector<glm::vec4> unlit;  ///< display-linear, times the rest; empty without unlit surfaces
        std::array<std::vector<glm::vec4>, kAovCount> aovs;  ///< empty without AOVs
        std::vector<glm::uvec2> ids;                         ///< of the last sample
    };
    [[nodiscard]] Planes read(gpu::Commands& commands, gpu::FrameGraph& graph, std::uint32_t samples);

  private:
    const gpu::Device* device_;
    gpu::ComputePipeline accumulate_;
    gpu::ComputePipeline unpack_;
    /// Adds `from` times the scale to the sum.
    void accumulate(gpu::PassContext& c, const FrameBuild& build, gpu::Image& from, gpu::Image& sum,
                    float scale) const;

    gpu::ImageRef ids_;
    gpu::Image sum_;
    gpu::Image unlit_sum_;
    std::array<gpu::Image, kAovCount> aov_sums_;
};

/// Pass of an interactive frame: exposure, tone curve and sRGB transfer into an 8 bit image.
class PresentPass {
  public:
    PresentPass(const gpu::Device& device, const FrameResources& frame, std::uint32_t tone_curve);
    void add(const FrameBuild& build, const Lit& lit);
    [[nodiscard]] gpu::Image& display() noexcept { return display_; }

  private:
    gpu::ComputePipeline pipeline_;
    gpu::Image display_;
};

}  // namespace candela::realtime
