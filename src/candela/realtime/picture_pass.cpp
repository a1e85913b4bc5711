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

void PicturePass::accumulate(gpu::PassContext& c, const FrameBuild& build, gpu::Image& from, gpu::Image& sum,
                             float scale) const {
    const FrameResources& frame = build.frame;
    const AccumulateBlock block{{frame.width, frame.height}, scale, build.view.first_sample ? 1 : 0};
    const std::array bindings{gpu::bind_sampled(from.view(), frame.nearest.get()),
                              gpu::bind_storage(sum.view())};
    c.commands.dispatch(accumulate_, bindings, gpu::push(block), groups(frame.width, 8),
                        groups(frame.height, 8));
}

void PicturePass::add(const FrameBuild& build, const Surfaces& surfaces, const Lit& lit) {
    FrameResources& frame = build.frame;
    gpu::FrameGraph& graph = build.graph;
    gpu::PassBuilder pass = graph.pass("accumulate");
    // What the samples before have added.
    const auto sum = [&](gpu::PassBuilder& p, const std::string& name, gpu::Image& image) {
        graph.keep(p.write(graph.import(name, image), gpu::Load::keep));
    };
    pass.read(lit.light);
    sum(pass, "sum of light", sum_);
    if (frame.has_unlit) {
        pass.read(lit.unlit);
        sum(pass, "sum of unlit", unlit_sum_);
    }
    pass.record([this, build, lit](gpu::PassContext& c) {
        accumulate(c, build, c.image(lit.light), sum_, build.view.nit_per_unit);
        if (build.frame.has_unlit) accumulate(c, build, c.image(lit.unlit), unlit_sum_, 1.0f);
    });
    if (!frame.write_aovs) return;

    ids_ = surfaces.ids;
    graph.keep(ids_);
    std::array<gpu::ImageRef, kAovCount> aovs = lit.aovs;
    gpu::PassBuilder unpack = graph.pass("unpack aovs");
    unpack.read(surfaces.gbuffer);
    unpack.read(surfaces.depth);
    for (const Aov aov : {Aov::albedo, Aov::normal, Aov::distance}) {
        gpu::ImageRef& image = aovs[static_cast<std::size_t>(aov)];
        image = unpack.write(image);
    }
    unpack.record([this, &frame, surfaces, aovs](gpu::PassContext& c) {
        std::vector<gpu::Binding> bindings{
            gpu::bind_buffer(frame.frame_block),
            gpu::bind_sampled(c.image(surfaces.gbuffer).view(), frame.nearest.get()),
            gpu::bind_sampled(c.image(surfaces.depth).view(), frame.nearest.get())};
        for (const Aov aov : {Aov::albedo, Aov::normal, Aov::distance})
            bindings.push_back(gpu::bind_storage(c.image(aovs[static_cast<std::size_t>(aov)]).view()));
        c.commands.dispatch(unpack_, bindings, {}, groups(frame.width, 8), groups(frame.height, 8));
    });
    gpu::PassBuilder add = graph.pass("accumulate aovs");
    for (std::size_t i = 0; i < kAovCount; ++i) {
        add.read(aovs[i]);
        sum(add, "sum of aov " + std::to_string(i), aov_sums_[i]);
    }
    add.record([this, build, aovs](gpu::PassContext& c) {
        for (std::size_t i = 0; i < kAovCount; ++i)
            accumulate(c, build, c.image(aovs[i]), aov_sums_[i], 1.0f);
    });
}

PicturePass::Planes PicturePass::read(gpu::Commands& commands, gpu::FrameGraph& graph,
                                      std::uint32_t samples) {
    Planes planes;
    planes.light_nit = read_mean(*device_, commands, sum_, samples);
    if (unlit_sum_) planes.unlit = read_mean(*device_, commands, unlit_sum_, samples);
    if (ids_.version == 0) return planes;
    for (std::size_t i = 0; i < kAovCount; ++i)
        planes.aovs[i] = read_mean(*device_, commands, aov_sums_[i], samples);
    planes.ids = read_image<glm::uvec2>(*device_, commands, graph.image(ids_));
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

void PresentPass::add(const FrameBuild& build, const Lit& lit) {
    FrameResources& frame = build.frame;
    gpu::PassBuilder pass = build.graph.pass("present");
    pass.read(lit.light);
    pass.read(lit.unlit);
    build.graph.keep(pass.write(build.graph.import("display", display_)));
    pass.record([this, &frame, &view = build.view, lit](gpu::PassContext& c) {
        const std::array bindings{gpu::bind_buffer(frame.frame_block),
                                  gpu::bind_sampled(c.image(lit.light).view(), frame.nearest.get()),
                                  gpu::bind_storage(display_.view()),
                                  gpu::bind_sampled(c.image(lit.unlit).view(), frame.nearest.get())};
        const PresentBlock block{view.exposure_change, frame.has_unlit ? 1 : 0};
        c.commands.dispatch(pipeline_, bindings, gpu::push(block), groups(frame.width, 8),
                            groups(frame.height, 8));
    });
}

}  // namespace candela::realtime
