#include "candela/gpu/commands.hpp"

#include <algorithm>
#include <cstring>

namespace candela::gpu {
namespace {

constexpr std::uint32_t kMaxPasses = 64;

struct Scope {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
    VkImageLayout layout;
    bool writes;
};

constexpr VkPipelineStageFlags2 kShaders = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
                                           VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT |
                                           VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;

Scope scope_of(Use use) {
    switch (use) {
        case Use::sampled:
            return {kShaders, VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_UNIFORM_READ_BIT,
                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, false};
        case Use::storage_read:
            return {kShaders, VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_UNIFORM_READ_BIT,
                    VK_IMAGE_LAYOUT_GENERAL, false};
        case Use::storage_write:
            return {kShaders, VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT,
                    VK_IMAGE_LAYOUT_GENERAL, true};
        case Use::color_target:
            return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true};
        case Use::depth_target:
            return {
                VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
                VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, true};
        case Use::transfer_source:
            return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                    VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, false};
        case Use::transfer_destination:
            return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, true};
        case Use::vertex_input:
            return {VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT,
                    VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT,
                    VK_IMAGE_LAYOUT_UNDEFINED, false};
        case Use::indirect_and_storage_read:
            return {kShaders | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                    VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT,
                    VK_IMAGE_LAYOUT_UNDEFINED, false};
        default:
            return {VK_PIPELINE_STAGE_2_TOP_OF_PIPE_BIT, 0, VK_IMAGE_LAYOUT_UNDEFINED, false};
    }
}

VkAttachmentLoadOp load_op(Load load) {
    switch (load) {
        case Load::clear:
            return VK_ATTACHMENT_LOAD_OP_CLEAR;
        case Load::discard:
            return VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        default:
            return VK_ATTACHMENT_LOAD_OP_LOAD;
    }
}

void depend(const Device& device, VkCommandBuffer buffer, const VkDependencyInfo& info) {
    device.vk.vkCmdPipelineBarrier2(buffer, &info);
}

}  // namespace

Commands::Commands(const Device& device) : device_(&device), descriptors_(device) {
    const auto& vk = device.vk;
    VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool_info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool_info.queueFamilyIndex = device.queue_family();
    VkCommandPool pool{};
    check(vk.vkCreateCommandPool(device.handle(), &pool_info, nullptr, &pool), "vkCreateCommandPool");
    pool_ = {pool,
             [&device](VkCommandPool p) { device.vk.vkDestroyCommandPool(device.handle(), p, nullptr); }};
    VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = pool;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    check(vk.vkAllocateCommandBuffers(device.handle(), &info, &buffer_), "vkAllocateCommandBuffers");
    const VkFenceCreateInfo fence_info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkFence fence{};
    check(vk.vkCreateFence(device.handle(), &fence_info, nullptr, &fence), "vkCreateFence");
    fence_ = {fence, [&device](VkFence f) { device.vk.vkDestroyFence(device.handle(), f, nullptr); }};
    if (device.limits().timestampComputeAndGraphics) {
        VkQueryPoolCreateInfo query_info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
        query_info.queryType = VK_QUERY_TYPE_TIMESTAMP;
        query_info.queryCount = kMaxPasses + 1;
        VkQueryPool queries{};
        check(vk.vkCreateQueryPool(device.handle(), &query_info, nullptr, &queries), "vkCreateQueryPool");
        queries_ = {queries,
                    [&device](VkQueryPool q) { device.vk.vkDestroyQueryPool(device.handle(), q, nullptr); }};
        nanoseconds_per_tick_ = static_cast<double>(device.limits().timestampPeriod);
    }
}

Commands::~Commands() {
    device_->vk.vkDeviceWaitIdle(device_->handle());
}

void Commands::begin() {
    descriptors_.reset();
    passes_.clear();
    VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(device_->vk.vkBeginCommandBuffer(buffer_, &info), "vkBeginCommandBuffer");
    if (queries_) device_->vk.vkCmdResetQueryPool(buffer_, queries_.get(), 0, kMaxPasses + 1);
}

void Commands::timestamp(std::uint32_t query) {
    if (!queries_ || query > kMaxPasses) return;
    device_->vk.vkCmdWriteTimestamp2(buffer_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_.get(), query);
}

void Commands::begin_pass(std::string name) {
    timestamp(static_cast<std::uint32_t>(passes_.size()));
    passes_.push_back(std::move(name));
}

void Commands::submit_and_wait() {
    if (!passes_.empty()) timestamp(static_cast<std::uint32_t>(passes_.size()));
    VkMemoryBarrier2 to_host{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    to_host.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    to_host.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    to_host.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
    to_host.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &to_host;
    depend(*device_, buffer_, dependency);
    check(device_->vk.vkEndCommandBuffer(buffer_), "vkEndCommandBuffer");
    VkCommandBufferSubmitInfo buffer_info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
    buffer_info.commandBuffer = buffer_;
    VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &buffer_info;
    check(device_->vk.vkQueueSubmit2(device_->queue(), 1, &submit, fence_.get()), "vkQueueSubmit2");
    check(device_->vk.vkWaitForFences(device_->handle(), 1, fence_.address(), VK_TRUE, UINT64_MAX),
          "vkWaitForFences");
    check(device_->vk.vkResetFences(device_->handle(), 1, fence_.address()), "vkResetFences");
}

std::vector<PassTime> Commands::pass_times() const {
    std::vector<PassTime> times;
    if (!queries_ || passes_.empty()) return times;
    const std::uint32_t count = std::min(static_cast<std::uint32_t>(passes_.size()), kMaxPasses) + 1;
    std::vector<std::uint64_t> ticks(count);
    check(device_->vk.vkGetQueryPoolResults(
              device_->handle(), queries_.get(), 0, count, count * sizeof(std::uint64_t), ticks.data(),
              sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults");
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
        times.push_back(
            {passes_[i], static_cast<double>(ticks[i + 1] - ticks[i]) * nanoseconds_per_tick_ * 1e-6});
    }
    return times;
}

void Commands::use(Image& image, Use next) {
    const Scope from = scope_of(image.state.use);
    const Scope to = scope_of(next);
    if (image.state.use == next && !from.writes) return;
    VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcStageMask = from.stages;
    barrier.srcAccessMask = from.writes ? from.access : 0;
    barrier.dstStageMask = to.stages;
    barrier.dstAccessMask = to.access;
    barrier.oldLayout = from.layout;
    barrier.newLayout = to.layout;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.handle();
    barrier.subresourceRange = {image.aspect(), 0, VK_REMAINING_MIP_LEVELS, 0, 1};
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    depend(*device_, buffer_, info);
    image.state.use = next;
}

void Commands::use(Buffer& buffer, Use next) {
    const Scope from = scope_of(buffer.state.use);
    const Scope to = scope_of(next);
    const Use previous = std::exchange(buffer.state.use, next);
    if (previous == Use::undefined || (!from.writes && !to.writes)) return;
    VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    barrier.srcStageMask = from.stages;
    barrier.srcAccessMask = from.writes ? from.access : 0;
    barrier.dstStageMask = to.stages;
    barrier.dstAccessMask = to.access;
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    depend(*device_, buffer_, info);
}

void Commands::full_barrier() {
    VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    depend(*device_, buffer_, info);
}

void Commands::bind(const ComputePipeline& pipeline, std::span<const Binding> bindings,
                    std::span<const std::byte> constants) {
    const auto& vk = device_->vk;
    vk.vkCmdBindPipeline(buffer_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline.get());
    const VkDescriptorSet set = descriptors_.allocate(pipeline.layout, 0, bindings);
    vk.vkCmdBindDescriptorSets(buffer_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout.handle(), 0, 1, &set,
                               0, nullptr);
    if (!constants.empty()) {
        vk.vkCmdPushConstants(buffer_, pipeline.layout.handle(), pipeline.layout.push_stages(), 0,
                              static_cast<std::uint32_t>(constants.size()), constants.data());
    }
}

void Commands::dispatch(const ComputePipeline& pipeline, std::span<const Binding> bindings,
                        std::span<const std::byte> constants, std::uint32_t x, std::uint32_t y,
                        std::uint32_t z) {
    bind(pipeline, bindings, constants);
    device_->vk.vkCmdDispatch(buffer_, x, y, z);
}

void Commands::dispatch_indirect(const ComputePipeline& pipeline, std::span<const Binding> bindings,
                                 std::span<const std::byte> constants, Buffer& arguments,
                                 VkDeviceSize offset) {
    bind(pipeline, bindings, constants);
    device_->vk.vkCmdDispatchIndirect(buffer_, arguments.handle(), offset);
}

void Commands::begin_rendering(std::span<const ColorTarget> colors, const std::optional<DepthTarget>& depth) {
    std::vector<VkRenderingAttachmentInfo> attachments;
    VkExtent2D extent{};
    for (const ColorTarget& target : colors) {
        VkRenderingAttachmentInfo a{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
        use(*target.image, Use::color_target);
        extent = target.image->extent();
        a.imageView = target.image->view();
        a.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        a.loadOp = load_op(target.load);
        a.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        attachments.push_back(a);
    }
    VkRenderingAttachmentInfo depth_attachment{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    if (depth) {
        use(*depth->image, Use::depth_target);
        extent = depth->image->extent();
        depth_attachment.imageView = depth->image->view();
        depth_attachment.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
        depth_attachment.loadOp = load_op(depth->load);
        depth_attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    }
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = extent;
    info.layerCount = 1;
    info.colorAttachmentCount = static_cast<std::uint32_t>(attachments.size());
    info.pColorAttachments = attachments.data();
    info.pDepthAttachment = depth ? &depth_attachment : nullptr;
    device_->vk.vkCmdBeginRendering(buffer_, &info);
    const VkViewport viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0, 1};
    const VkRect2D scissor{{0, 0}, extent};
    device_->vk.vkCmdSetViewport(buffer_, 0, 1, &viewport);
    device_->vk.vkCmdSetScissor(buffer_, 0, 1, &scissor);
}

void Commands::end_rendering() {
    device_->vk.vkCmdEndRendering(buffer_);
}

void Commands::copy(Buffer& from, Buffer& to, VkDeviceSize bytes, VkDeviceSize from_offset) {
    use(from, Use::transfer_source);
    use(to, Use::transfer_destination);
    const VkBufferCopy region{from_offset, 0, bytes};
    device_->vk.vkCmdCopyBuffer(buffer_, from.handle(), to.handle(), 1, &region);
}

namespace {
VkBufferImageCopy region_of(const Image& image, std::uint32_t level, VkDeviceSize buffer_offset) {
    VkBufferImageCopy region{};
    region.bufferOffset = buffer_offset;
    region.imageSubresource = {image.aspect(), level, 0, 1};
    region.imageExtent = {std::max(1u, image.desc().width >> level),
                          std::max(1u, image.desc().height >> level), 1};
    return region;
}
}  // namespace

void Commands::copy(Buffer& from, Image& to, std::uint32_t level, VkDeviceSize from_offset) {
    use(from, Use::transfer_source);
    use(to, Use::transfer_destination);
    const VkBufferImageCopy region = region_of(to, level, from_offset);
    device_->vk.vkCmdCopyBufferToImage(buffer_, from.handle(), to.handle(),
                                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void Commands::copy_rows(Buffer& from, Image& to, std::uint32_t first, std::uint32_t rows,
                         VkDeviceSize from_offset) {
    use(from, Use::transfer_source);
    use(to, Use::transfer_destination);
    VkBufferImageCopy region = region_of(to, 0, from_offset);
    region.imageOffset.y = static_cast<std::int32_t>(first);
    region.imageExtent.height = rows;
    device_->vk.vkCmdCopyBufferToImage(buffer_, from.handle(), to.handle(),
                                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void Commands::copy(Image& from, Buffer& to, std::uint32_t level) {
    use(from, Use::transfer_source);
    use(to, Use::transfer_destination);
    const VkBufferImageCopy region = region_of(from, level, 0);
    device_->vk.vkCmdCopyImageToBuffer(buffer_, from.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                       to.handle(), 1, &region);
}

void Commands::copy_level(Image& from, Image& to, std::uint32_t level) {
    use(from, Use::transfer_source);
    use(to, Use::transfer_destination);
    VkImageCopy region{};
    region.srcSubresource = {from.aspect(), level, 0, 1};
    region.dstSubresource = {to.aspect(), level, 0, 1};
    region.extent = {std::max(1u, from.desc().width >> level), std::max(1u, from.desc().height >> level), 1};
    device_->vk.vkCmdCopyImage(buffer_, from.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.handle(),
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void Commands::fill(Buffer& buffer, std::uint32_t word) {
    use(buffer, Use::transfer_destination);
    device_->vk.vkCmdFillBuffer(buffer_, buffer.handle(), 0, VK_WHOLE_SIZE, word);
}

Buffer upload_buffer(const Device& device, Commands& commands, std::span<const std::byte> bytes,
                     VkBufferUsageFlags usage) {
    Buffer staging(device, bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::upload);
    std::memcpy(staging.mapped(), bytes.data(), bytes.size());
    Buffer out(device, bytes.size(), usage, MemoryKind::device);
    commands.begin();
    commands.copy(staging, out, bytes.size());
    commands.submit_and_wait();
    return out;
}

}  // namespace candela::gpu
