#include "candela/realtime/mesh_pipelines.hpp"

#include <cstddef>

namespace candela::realtime {
namespace {

/// Push constants of shaders/mesh.vert.glsl.
struct ObjectBlock {
    std::array<glm::vec4, 3> rows;
    glm::uvec4 ids;
};

ObjectBlock object_block(const Draw& draw) {
    ObjectBlock block{};
    for (int r = 0; r < 3; ++r) {
        block.rows[static_cast<std::size_t>(r)] =
            glm::vec4(draw.world[0][r], draw.world[1][r], draw.world[2][r], draw.world[3][r]);
    }
    block.ids = glm::uvec4(draw.instance + 1, draw.material + 1, 0, 0);
    return block;
}

}  // namespace

void describe_vertices(gpu::GraphicsDesc& desc) {
    desc.vertex_stride = sizeof(Vertex);
    desc.attributes = {{VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, position)},
                       {VK_FORMAT_R16G16B16A16_SNORM, offsetof(Vertex, normal)},
                       {VK_FORMAT_R16G16B16A16_SNORM, offsetof(Vertex, tangent)},
                       {VK_FORMAT_R32G32_SFLOAT, offsetof(Vertex, uv0)},
                       {VK_FORMAT_R32G32_SFLOAT, offsetof(Vertex, uv1)},
                       {VK_FORMAT_R16G16B16A16_UNORM, offsetof(Vertex, color)}};
}

MeshPipelines::MeshPipelines(const gpu::Device& device, gpu::PipelineLayout layout, gpu::GraphicsDesc desc,
                             ShadeVariant variant)
    : device_(&device),
      layout_(std::move(layout)),
      desc_(std::move(desc)),
      variant_(variant),
      descriptors_(device) {}

void MeshPipelines::prepare(const FrameResources& frame, const GpuScene& scene, bool blended) {
    for (const Draw& draw : scene.draws) {
        if (draw.blended != blended) continue;
        if (!pipelines_.contains(draw.features)) {
            ShadeVariant variant = variant_;
            variant.features = draw.features;
            variant.layers = (draw.features & feature_layered) != 0;
            gpu::GraphicsDesc desc = desc_;
            desc.constants = specialization(frame, variant);
            // An unlit surface covers light without adding any.
            if (blended && (draw.features & feature_unlit) != 0) desc.blends.front() = gpu::Blend::cover;
            desc.cull_back_faces = (draw.features & feature_double_sided) == 0;
            pipelines_.emplace(draw.features, gpu::create_graphics_pipeline(*device_, desc, layout_));
        }
        if (material_sets_.size() <= draw.material) material_sets_.resize(draw.material + 1);
        if (!material_sets_[draw.material]) {
            material_sets_[draw.material] =
                descriptors_.allocate(layout_, 1, scene.material_bindings(draw.material));
        }
    }
}

void MeshPipelines::draw(gpu::Commands& commands, const gpu::Buffer& vertices, const gpu::Buffer& indices,
                         std::span<const Draw* const> draws, VkDescriptorSet set0) const {
    if (draws.empty()) return;
    const auto& vk = device_->vk;
    const VkCommandBuffer buffer = commands.handle();
    const VkBuffer vertex_buffer = vertices.handle();
    const VkDeviceSize zero = 0;
    vk.vkCmdBindVertexBuffers(buffer, 0, 1, &vertex_buffer, &zero);
    vk.vkCmdBindIndexBuffer(buffer, indices.handle(), 0, VK_INDEX_TYPE_UINT32);
    vk.vkCmdBindDescriptorSets(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.handle(), 0, 1, &set0, 0,
                               nullptr);
    const Draw* last = nullptr;
    for (const Draw* draw : draws) {
        if (!last || last->features != draw->features) {
            vk.vkCmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS,
                                 pipelines_.at(draw->features).pipeline.get());
        }
        if (!last || last->material != draw->material) {
            vk.vkCmdBindDescriptorSets(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.handle(), 1, 1,
                                       &material_sets_.at(draw->material), 0, nullptr);
        }
        // Clip space has y down, so glTF's counter-clockwise fronts stay counter-clockwise in Vulkan's
        // framebuffer.
        vk.vkCmdSetFrontFace(buffer,
                             draw->mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
        const ObjectBlock block = object_block(*draw);
        const auto bytes = gpu::push(block);
        vk.vkCmdPushConstants(buffer, layout_.handle(), layout_.push_stages(), 0,
                              static_cast<std::uint32_t>(bytes.size()), bytes.data());
        vk.vkCmdDrawIndexed(buffer, draw->index_count, 1, draw->first_index, draw->vertex_offset, 0);
        last = draw;
    }
}

}  // namespace candela::realtime
