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

Surfaces ShapePass::add(const FrameBuild& build, Surfaces s) const {
    if (shapes_.empty()) return s;
    FrameResources& frame = build.frame;
    GpuScene& scene = build.scene;
    gpu::PassBuilder pass = build.graph.pass("shapes of lights");
    pass.read(build.in.lights);
    pass.read(build.in.light_tables);
    s.gbuffer = pass.color(s.gbuffer, gpu::Load::keep);
    // Where no shape is, lighting writes what has not been written.
    s.light = pass.color(s.light, s.light.version > 0 ? gpu::Load::keep : gpu::Load::discard);
    if (frame.all_targets) s.ids = pass.color(s.ids, gpu::Load::keep);
    s.depth = pass.depth(s.depth, gpu::Load::keep);
    pass.record([this, &frame, &scene](gpu::PassContext& c) {
        const std::array bindings{gpu::bind_buffer(frame.frame_block), gpu::bind_buffer(scene.lights),
                                  gpu::bind_buffer(scene.light_tables)};
        const VkDescriptorSet set = c.commands.descriptors().allocate(layout_, 0, bindings);
        c.begin_rendering();
        const auto& vk = c.commands.device().vk;
        const VkCommandBuffer buffer = c.commands.handle();
        vk.vkCmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.pipeline.get());
        vk.vkCmdBindDescriptorSets(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.handle(), 0, 1, &set, 0,
                                   nullptr);
        vk.vkCmdSetFrontFace(buffer, VK_FRONT_FACE_COUNTER_CLOCKWISE);
        for (const std::uint32_t index : shapes_) {
            vk.vkCmdPushConstants(buffer, layout_.handle(), layout_.push_stages(), 0, sizeof(index), &index);
            vk.vkCmdDraw(buffer, 36, 1, 0, 0);
        }
        c.commands.end_rendering();
    });
    return s;
}

}  // namespace candela::realtime
