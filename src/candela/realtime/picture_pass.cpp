#include "candela/realtime/picture_pass.hpp"

#include <cstring>

#include "candela_shaders/accumulate_comp.hpp"
#include "candela_shaders/aovs_comp.hpp"
#include "candela_shaders/present_comp.hpp"

namespace candela::realtime {
namespace {

/// Push constants of shaders/accumulate.comp.glsl.
struct AccumulateBlock {
    glm::ivec2 size;
    float scale;
    std::int32_t first;
};

/// Push constants of shaders/present.comp.glsl.
struct PresentBlock {
    float exposure_change;
    std::int32_t has_unlit;
};

gpu::Image picture_image(const gpu::Device& device, const FrameResources& frame) {
    return {device, {frame.width, frame.height, kPictureFormat, VK_IMAGE_USAGE_STORAGE_BIT}};
}

template <class Texel>
std::vector<Texel> read_image(const gpu::Device& device, gpu::Commands& commands, gpu::Image& image) {
    const std::size_t texels = std::size_t{image.desc().width} * image.desc().height;
    gpu::Buffer buffer(device, texels * sizeof(Texel), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                       gpu::MemoryKind::readback);
    commands.begin();
    commands.copy(image, buffer);
    commands.submit_and_wait();
    std::vector<Texel> out(texels);
    std::memcpy(out.data(), buffer.mapped(), texels * sizeof(Texel));
    return out;
}

std::vector<glm::vec4> read_mean(const gpu::Device& device, gpu::Commands& commands, gpu::Image& sum,
                                 std::uint32_t samples) {
    std::vector<glm::vec4> mean = read_image<glm::vec4>(device, commands, sum);
    const float weight = 1.0f / static_cast<float>(samples);
    for (glm::vec4& texel : mean) texel *= weight;
    return mean;
}

}  // namespace

PicturePass::PicturePass(const gpu::Device& device, const FrameResources& frame)
    : device_(&device),
      accumulate_(gpu::create_compute_pipeline(
          device, shaders::accumulate_comp,
          {{{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}},
           sizeof(AccumulateBlock)})),
      sum_(picture_image(device, frame)) {
    if (frame.has_unlit) unlit_sum_ = picture_image(device, frame);
    if (!frame.write_aovs) return;
    std::vector<VkDescriptorType> types{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                        VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                        VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};
    types.insert(types.end(), 3, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    unpack_ = gpu::create_compute_pipeline(device, shaders::aovs_comp, {{types}, 0});
    for (gpu::Image& sum : aov_sums_) sum = picture_image(device, frame);
}

void PicturePass::record(gpu::Commands& commands, FrameResources& frame, float nit_per_unit, bool first) {
    const auto add = [&](gpu::Image& from, gpu::Image& sum, float scale) {
        commands.use(from, gpu::Use::sampled);
        commands.use(sum, gpu::Use::storage_write);
        const AccumulateBlock block{{frame.width, frame.height}, scale, first ? 1 : 0};
        const std::array bindings{gpu::bind_sampled(from.view(), frame.nearest.get()),
                                  gpu::bind_storage(sum.view())};
        commands.dispatch(accumulate_, bindings, gpu::push(block), groups(frame.width, 8),
                          groups(frame.height, 8));
    };
    commands.begin_pass("accumulate");
    add(frame.light, sum_, nit_per_unit);
    if (frame.has_unlit) add(frame.unlit, unlit_sum_, 1.0f);
    if (!frame.write_aovs) return;

    commands.begin_pass("aovs");
    commands.use(frame.gbuffer, gpu::Use::sampled);
    commands.use(frame.depth, gpu::Use::sampled);
    std::vector<gpu::Binding> bindings{gpu::bind_buffer(frame.frame_block),
                                       gpu::bind_sampled(frame.gbuffer.view(), frame.nearest.get()),
                                       gpu::bind_sampled(frame.depth.view(), frame.nearest.get())};
    for (const Aov aov : {Aov::albedo, Aov::normal, Aov::distance}) {
        gpu::Image& image = frame.aovs[static_cast<std::size_t>(aov)];
        commands.use(image, gpu::Use::storage_write);
        bindings.push_back(gpu::bind_storage(image.view()));
    }
    commands.dispatch(unpack_, bindings, {}, groups(frame.width, 8), groups(frame.height, 8));
    for (std::size_t i = 0; i < kAovCount; ++i) add(frame.aovs[i], aov_sums_[i], 1.0f);
}

PicturePass::Planes PicturePass::read(gpu::Commands& commands, FrameResources& frame, std::uint32_t samples) {
    Planes planes;
    planes.light_nit = read_mean(*device_, commands, sum_, samples);
    if (frame.has_unlit) planes.unlit = read_mean(*device_, commands, unlit_sum_, samples);
    if (frame.write_aovs) {
        for (std::size_t i = 0; i < kAovCount; ++i) {
            planes.aovs[i] = read_mean(*device_, commands, aov_sums_[i], samples);
        }
        planes.ids = read_image<glm::uvec2>(*device_, commands, frame.ids);
    }
    return planes;
}

PresentPass::PresentPass(const gpu::Device& device, const FrameResources& frame, std::uint32_t tone_curve)
    : pipeline_(gpu::create_compute_pipeline(
          device, shaders::present_comp,
          {{{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
             VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER}},
           sizeof(PresentBlock)},
          {tone_curve})),
      display_(device, {frame.width, frame.height, VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_USAGE_STORAGE_BIT}) {}

void PresentPass::record(gpu::Commands& commands, FrameResources& frame, float exposure_change) {
    commands.begin_pass("present");
    commands.use(frame.light, gpu::Use::sampled);
    commands.use(frame.unlit, gpu::Use::sampled);
    commands.use(display_, gpu::Use::storage_write);
    const std::array bindings{
        gpu::bind_buffer(frame.frame_block), gpu::bind_sampled(frame.light.view(), frame.nearest.get()),
        gpu::bind_storage(display_.view()), gpu::bind_sampled(frame.unlit.view(), frame.nearest.get())};
    const PresentBlock block{exposure_change, frame.has_unlit ? 1 : 0};
    commands.dispatch(pipeline_, bindings, gpu::push(block), groups(frame.width, 8), groups(frame.height, 8));
}

}  // namespace candela::realtime
