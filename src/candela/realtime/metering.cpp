#include "candela/realtime/metering.hpp"

#include <algorithm>
#include <cmath>

#include "candela/realtime/exposure_meter.hpp"
#include "candela_shaders/histogram_comp.hpp"

namespace candela::realtime {

MeteringPass::MeteringPass(const gpu::Device& device)
    : pipeline_(gpu::create_compute_pipeline(
          device, shaders::histogram_comp,
          {{{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
             VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}},
           4})),
      histogram_(device, kMeterBins * sizeof(std::uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                 gpu::MemoryKind::readback) {}

void MeteringPass::add(const FrameBuild& build, const Lit& lit) const {
    FrameResources& frame = build.frame;
    gpu::PassBuilder pass = build.graph.pass("metering");
    pass.read(lit.light);
    const gpu::BufferRef histogram = pass.write(build.graph.import("histogram", histogram_));
    build.graph.keep(histogram);
    pass.record([this, &frame, light = lit.light](gpu::PassContext& c) {
        c.commands.fill(histogram_, 0);
        c.commands.use(histogram_, gpu::Use::storage_write);
        const std::array bindings{gpu::bind_buffer(frame.frame_block),
                                  gpu::bind_sampled(c.image(light).view(), frame.nearest.get()),
                                  gpu::bind_buffer(histogram_)};
        // About 16,000 pixels are plenty for an average, whatever the size of the picture.
        const double pixels = static_cast<double>(frame.width) * frame.height;
        const auto step = static_cast<std::int32_t>(std::max(1.0, std::floor(std::sqrt(pixels / 16000.0))));
        const auto ustep = static_cast<std::uint32_t>(step);
        const std::uint32_t count = groups(frame.width, ustep) * groups(frame.height, ustep);
        c.commands.dispatch(pipeline_, bindings, gpu::push(step), groups(count, 64));
    });
}

std::span<const std::uint32_t> MeteringPass::bins() const {
    return histogram_.mapped_as<const std::uint32_t>();
}

}  // namespace candela::realtime
