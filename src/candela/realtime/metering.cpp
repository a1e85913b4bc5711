#include "candela/realtime/metering.hpp"

#include <algorithm>
#include <cmath>

#include "candela/realtime/exposure_control.hpp"
#include "candela_shaders/histogram_comp.hpp"
#include "shading/exposure.glsl"

namespace candela::realtime {
namespace {

// Of shaders/histogram.comp.glsl.
constexpr float kFirstStop = -16.0f;
constexpr float kBinsPerStop = 8.0f;

}  // namespace

MeteringPass::MeteringPass(const gpu::Device& device)
    : pipeline_(gpu::create_compute_pipeline(
          device, shaders::histogram_comp,
          {{{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
             VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}},
           4})),
      histogram_(device, kBins * sizeof(std::uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                 gpu::MemoryKind::readback) {}

void MeteringPass::record(gpu::Commands& commands, FrameResources& frame) const {
    commands.begin_pass("metering");
    commands.fill(histogram_, 0);
    commands.use(histogram_, gpu::Use::storage_write);
    commands.use(frame.light, gpu::Use::sampled);
    const std::array bindings{gpu::bind_buffer(frame.frame_block),
                              gpu::bind_sampled(frame.light.view(), frame.nearest.get()),
                              gpu::bind_buffer(histogram_)};
    // About 16,000 pixels are plenty for an average, whatever the size of the picture.
    const double pixels = static_cast<double>(frame.width) * frame.height;
    const auto step = static_cast<std::int32_t>(std::max(1.0, std::floor(std::sqrt(pixels / 16000.0))));
    const auto ustep = static_cast<std::uint32_t>(step);
    const std::uint32_t count = groups(frame.width, ustep) * groups(frame.height, ustep);
    commands.dispatch(pipeline_, bindings, gpu::push(step), groups(count, 64));
}

std::span<const std::uint32_t> MeteringPass::bins() const {
    return histogram_.mapped_as<const std::uint32_t>();
}

bool average_log2_luminance(std::span<const std::uint32_t> bins, double low_fraction, double high_fraction,
                            float& stops) {
    double total = 0.0;
    for (const std::uint32_t count : bins) total += count;
    if (total == 0.0) return false;
    double seen = 0.0;
    double sum = 0.0;
    double weight = 0.0;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        const double from = std::max(seen, low_fraction * total);
        seen += bins[i];
        const double inside = std::max(0.0, std::min(seen, high_fraction * total) - from);
        sum += inside * (kFirstStop + (static_cast<double>(i) + 0.5) / kBinsPerStop);
        weight += inside;
    }
    if (weight == 0.0) return false;
    stops = static_cast<float>(sum / weight);
    return true;
}

std::optional<float> metered_ev100(std::span<const glm::vec4> light_nit) {
    double sum = 0.0;
    for (const glm::vec4& nit : light_nit) sum += std::max(shading::luminance(glm::vec3(nit)), 0.0f);
    if (!(sum > 0.0)) return std::nullopt;
    // The histogram spans 32 stops: about the mean, as the frame's does about its exposure.
    const float unit_nit = static_cast<float>(sum / static_cast<double>(light_nit.size()));
    std::array<std::uint32_t, MeteringPass::kBins> bins{};
    for (const glm::vec4& nit : light_nit) {
        const float y = shading::luminance(glm::vec3(nit)) / unit_nit;
        if (!(y > 0.0f)) continue;
        const float bin = (std::log2(y) - kFirstStop) * kBinsPerStop;
        ++bins[static_cast<std::size_t>(std::clamp(bin, 0.0f, static_cast<float>(MeteringPass::kBins - 1)))];
    }
    float stops = 0.0f;
    if (!average_log2_luminance(bins, kMeterLow, kMeterHigh, stops)) return std::nullopt;
    return shading::ev100_from_luminance(std::exp2(stops) * unit_nit);
}

}  // namespace candela::realtime
