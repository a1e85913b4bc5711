#include "candela/gpu/pipeline.hpp"

#include <array>

namespace candela::gpu {
namespace {

Owned<VkShaderModule> create_module(const Device& device, SpirV code) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = code.size_bytes();
    info.pCode = code.data();
    VkShaderModule module{};
    check(device.vk.vkCreateShaderModule(device.handle(), &info, nullptr, &module), "vkCreateShaderModule");
    return {module,
            [&device](VkShaderModule m) { device.vk.vkDestroyShaderModule(device.handle(), m, nullptr); }};
}

Owned<VkPipeline> own(const Device& device, VkPipeline pipeline) {
    return {pipeline, [&device](VkPipeline p) { device.vk.vkDestroyPipeline(device.handle(), p, nullptr); }};
}

/// Keeps the map entries alive as long as the VkSpecializationInfo that points at them.
struct SpecializationData {
    explicit SpecializationData(const Specialization& constants) {
        for (std::uint32_t i = 0; i < constants.size(); ++i) entries.push_back({i, i * 4u, 4u});
        info.mapEntryCount = static_cast<std::uint32_t>(entries.size());
        info.pMapEntries = entries.data();
        info.dataSize = constants.size() * 4;
        info.pData = constants.data();
    }
    std::vector<VkSpecializationMapEntry> entries;
    VkSpecializationInfo info{};
};

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits bit, VkShaderModule module,
                                      const VkSpecializationInfo& constants) {
    VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage = bit;
    info.module = module;
    info.pName = "main";
    info.pSpecializationInfo = &constants;
    return info;
}

VkPipelineColorBlendAttachmentState blend_state(Blend blend) {
    VkPipelineColorBlendAttachmentState state{};
    if (blend == Blend::write_nothing) return state;
    state.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                           VK_COLOR_COMPONENT_A_BIT;
    if (blend == Blend::premultiplied_over) {
        state.blendEnable = VK_TRUE;
        state.srcColorBlendFactor = state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
        state.dstColorBlendFactor = state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    }
    if (blend == Blend::cover) {
        state.blendEnable = VK_TRUE;
        state.srcColorBlendFactor = state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
        state.dstColorBlendFactor = state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    }
    return state;
}

}  // namespace

PipelineLayout::PipelineLayout(const Device& device, const LayoutDesc& desc) : desc_(desc) {
    std::vector<VkDescriptorSetLayout> handles;
    for (const auto& types : desc.sets) {
        std::vector<VkDescriptorSetLayoutBinding> bindings;
        for (const VkDescriptorType type : types) {
            bindings.push_back(
                {static_cast<std::uint32_t>(bindings.size()), type, 1, VK_SHADER_STAGE_ALL, nullptr});
        }
        VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
        info.bindingCount = static_cast<std::uint32_t>(bindings.size());
        info.pBindings = bindings.data();
        VkDescriptorSetLayout layout{};
        check(device.vk.vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &layout),
              "vkCreateDescriptorSetLayout");
        sets_.emplace_back(layout, [&device](VkDescriptorSetLayout l) {
            device.vk.vkDestroyDescriptorSetLayout(device.handle(), l, nullptr);
        });
        handles.push_back(layout);
    }
    const VkPushConstantRange push{VK_SHADER_STAGE_ALL, 0, desc.push_bytes};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = static_cast<std::uint32_t>(handles.size());
    info.pSetLayouts = handles.data();
    info.pushConstantRangeCount = desc.push_bytes ? 1 : 0;
    info.pPushConstantRanges = &push;
    VkPipelineLayout layout{};
    check(device.vk.vkCreatePipelineLayout(device.handle(), &info, nullptr, &layout),
          "vkCreatePipelineLayout");
    layout_ = {layout, [&device](VkPipelineLayout l) {
                   device.vk.vkDestroyPipelineLayout(device.handle(), l, nullptr);
               }};
}

ComputePipeline create_compute_pipeline(const Device& device, SpirV code, const LayoutDesc& layout,
                                        const Specialization& constants) {
    ComputePipeline out;
    out.layout = PipelineLayout(device, layout);
    const Owned<VkShaderModule> module = create_module(device, code);
    const SpecializationData specialization(constants);
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = stage(VK_SHADER_STAGE_COMPUTE_BIT, module.get(), specialization.info);
    info.layout = out.layout.handle();
    VkPipeline pipeline{};
    check(device.vk.vkCreateComputePipelines(device.handle(), device.pipeline_cache(), 1, &info, nullptr,
                                             &pipeline),
          "vkCreateComputePipelines");
    out.pipeline = own(device, pipeline);
    return out;
}

GraphicsPipeline create_graphics_pipeline(const Device& device, const GraphicsDesc& desc,
                                          const PipelineLayout& layout) {
    const Owned<VkShaderModule> vertex = create_module(device, desc.vertex);
    const Owned<VkShaderModule> fragment = create_module(device, desc.fragment);
    const SpecializationData specialization(desc.constants);
    const std::array stages{stage(VK_SHADER_STAGE_VERTEX_BIT, vertex.get(), specialization.info),
                            stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.get(), specialization.info)};

    const VkVertexInputBindingDescription binding{0, desc.vertex_stride, VK_VERTEX_INPUT_RATE_VERTEX};
    std::vector<VkVertexInputAttributeDescription> attributes;
    for (const VertexAttribute& a : desc.attributes) {
        attributes.push_back({static_cast<std::uint32_t>(attributes.size()), 0, a.format, a.offset});
    }
    VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    input.vertexBindingDescriptionCount = attributes.empty() ? 0 : 1;
    input.pVertexBindingDescriptions = &binding;
    input.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size());
    input.pVertexAttributeDescriptions = attributes.data();

    VkPipelineInputAssemblyStateCreateInfo assembly{
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    raster.cullMode = desc.cull_back_faces ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE;
    raster.lineWidth = 1.0f;
    VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = desc.depth_test;
    depth.depthWriteEnable = desc.depth_write;
    depth.depthCompareOp = VK_COMPARE_OP_GREATER_OR_EQUAL;
    std::vector<VkPipelineColorBlendAttachmentState> blends;
    for (const Blend blend : desc.blends) blends.push_back(blend_state(blend));
    VkPipelineColorBlendStateCreateInfo blending{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blending.attachmentCount = static_cast<std::uint32_t>(blends.size());
    blending.pAttachments = blends.data();
    constexpr std::array dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                        VK_DYNAMIC_STATE_FRONT_FACE};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = static_cast<std::uint32_t>(dynamic_states.size());
    dynamic.pDynamicStates = dynamic_states.data();
    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = static_cast<std::uint32_t>(desc.color_formats.size());
    rendering.pColorAttachmentFormats = desc.color_formats.data();
    rendering.depthAttachmentFormat = desc.depth_format;

    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blending;
    info.pDynamicState = &dynamic;
    info.layout = layout.handle();
    VkPipeline pipeline{};
    check(device.vk.vkCreateGraphicsPipelines(device.handle(), device.pipeline_cache(), 1, &info, nullptr,
                                              &pipeline),
          "vkCreateGraphicsPipelines");
    return {own(device, pipeline)};
}

void DescriptorAllocator::add_pool() {
    constexpr std::uint32_t sets = 256;
    constexpr std::array sizes{VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, sets * 14},
                               VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, sets * 4},
                               VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, sets * 4},
                               VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, sets * 2}};
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = sets;
    info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool{};
    check(device_->vk.vkCreateDescriptorPool(device_->handle(), &info, nullptr, &pool),
          "vkCreateDescriptorPool");
    const Device& device = *device_;
    pools_.emplace_back(pool, [&device](VkDescriptorPool p) {
        device.vk.vkDestroyDescriptorPool(device.handle(), p, nullptr);
    });
}

VkDescriptorSet DescriptorAllocator::allocate(const PipelineLayout& layout, std::size_t set,
                                              std::span<const Binding> bindings) {
    const VkDescriptorSetLayout set_layout = layout.set(set);
    VkDescriptorSet out{};
    for (;;) {
        if (current_ == pools_.size()) add_pool();
        VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
        info.descriptorPool = pools_[current_].get();
        info.descriptorSetCount = 1;
        info.pSetLayouts = &set_layout;
        const VkResult result = device_->vk.vkAllocateDescriptorSets(device_->handle(), &info, &out);
        if (result == VK_SUCCESS) break;
        if (result != VK_ERROR_OUT_OF_POOL_MEMORY && result != VK_ERROR_FRAGMENTED_POOL) {
            check(result, "vkAllocateDescriptorSets");
        }
        ++current_;
    }

    const auto& types = layout.desc().sets.at(set);
    std::vector<VkWriteDescriptorSet> writes(bindings.size());
    std::vector<VkDescriptorBufferInfo> buffers(bindings.size());
    std::vector<VkDescriptorImageInfo> images(bindings.size());
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        const Binding& b = bindings[i];
        buffers[i] = {b.buffer, b.offset, b.range};
        images[i] = {b.sampler, b.view, b.image_layout};
        writes[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        writes[i].dstSet = out;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = types.at(i);
        writes[i].pBufferInfo = &buffers[i];
        writes[i].pImageInfo = &images[i];
    }
    device_->vk.vkUpdateDescriptorSets(device_->handle(), static_cast<std::uint32_t>(writes.size()),
                                       writes.data(), 0, nullptr);
    return out;
}

void DescriptorAllocator::reset() {
    for (const auto& pool : pools_) {
        check(device_->vk.vkResetDescriptorPool(device_->handle(), pool.get(), 0), "vkResetDescriptorPool");
    }
    current_ = 0;
}

}  // namespace candela::gpu
