#include "candela/realtime/shape_pass.hpp"

#include "candela_shaders/shape_all_frag.hpp"
#include "candela_shaders/shape_frag.hpp"
#include "candela_shaders/shape_vert.hpp"

namespace candela::realtime {

ShapePass::ShapePass(const gpu::Device& device, const FrameResources& frame, const GpuScene& scene)
    : layout_(device, {{{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}},
                       sizeof(std::uint32_t)}),
      shapes_(shape_lights(scene.light_list)) {
    if (shapes_.empty()) return;
    gpu::GraphicsDesc desc;
    desc.vertex = shaders::shape_vert;
    desc.fragment = frame.all_targets ? shaders::shape_all_frag : shaders::shape_frag;
    desc.color_formats = {kGBufferFormat, frame.light_format()};
    if (frame.all_targets) desc.color_formats.push_back(kIdFormat);
    desc.blends.assign(desc.color_formats.size(), gpu::Blend::off);
    desc.depth_format = kDepthFormat;
    // Both faces: the camera may be within the box, and a fragment is the same from either.
    desc.cull_back_faces = false;
    pipeline_ = gpu::create_graphics_pipeline(device, desc, layout_);
}

void ShapePass::record(gpu::Commands& commands, FrameResources& frame, GpuScene& scene) const {
    if (shapes_.empty()) return;
    commands.begin_pass("shapes of lights");
    commands.use(scene.lights, gpu::Use::storage_read);
    commands.use(scene.light_tables, gpu::Use::storage_read);
    const std::array bindings{gpu::bind_buffer(frame.frame_block), gpu::bind_buffer(scene.lights),
                              gpu::bind_buffer(scene.light_tables)};
    const VkDescriptorSet set = commands.descriptors().allocate(layout_, 0, bindings);
    std::vector<gpu::ColorTarget> targets{{&frame.gbuffer}, {&frame.light}};
    if (frame.all_targets) targets.push_back({&frame.ids});
    commands.begin_rendering(targets, gpu::DepthTarget{&frame.depth});
    const auto& vk = commands.device().vk;
    const VkCommandBuffer buffer = commands.handle();
    vk.vkCmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.pipeline.get());
    vk.vkCmdBindDescriptorSets(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.handle(), 0, 1, &set, 0,
                               nullptr);
    vk.vkCmdSetFrontFace(buffer, VK_FRONT_FACE_COUNTER_CLOCKWISE);
    for (const std::uint32_t index : shapes_) {
        vk.vkCmdPushConstants(buffer, layout_.handle(), layout_.push_stages(), 0, sizeof(index), &index);
        vk.vkCmdDraw(buffer, 36, 1, 0, 0);
    }
    commands.end_rendering();
}

}  // namespace candela::realtime
