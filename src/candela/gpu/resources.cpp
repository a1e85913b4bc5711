#include "candela/gpu/resources.hpp"

#include <algorithm>
#include <bit>

namespace candela::gpu {
namespace {

VkMemoryPropertyFlags properties_of(MemoryKind kind) {
    switch (kind) {
        case MemoryKind::upload:
            return VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        case MemoryKind::readback:
            return VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT |
                   VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
        default:
            return VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    }
}

Owned<VkImageView> create_view(const Device& device, VkImage image, VkFormat format,
                               VkImageAspectFlags aspect, std::uint32_t first_mip, std::uint32_t mips) {
    VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {aspect, first_mip, mips, 0, 1};
    VkImageView view{};
    check(device.vk.vkCreateImageView(device.handle(), &info, nullptr, &view), "vkCreateImageView");
    return {view, [&device](VkImageView v) { device.vk.vkDestroyImageView(device.handle(), v, nullptr); }};
}

}  // namespace

Buffer Buffer::unbound(const Device& device, std::size_t bytes, VkBufferUsageFlags usage) {
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = bytes;
    info.usage = usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VkBuffer handle{};
    check(device.vk.vkCreateBuffer(device.handle(), &info, nullptr, &handle), "vkCreateBuffer");
    Buffer buffer;
    buffer.size_ = bytes;
    buffer.buffer_ = {handle,
                      [&device](VkBuffer b) { device.vk.vkDestroyBuffer(device.handle(), b, nullptr); }};
    return buffer;
}

VkMemoryRequirements Buffer::requirements(const Device& device) const {
    VkMemoryRequirements requirements{};
    device.vk.vkGetBufferMemoryRequirements(device.handle(), handle(), &requirements);
    return requirements;
}

void Buffer::bind(const Device& device, VkDeviceMemory block, VkDeviceSize offset) {
    check(device.vk.vkBindBufferMemory(device.handle(), handle(), block, offset), "vkBindBufferMemory");
}

Buffer::Buffer(const Device& device, std::size_t bytes, VkBufferUsageFlags usage, MemoryKind kind)
    : Buffer(unbound(device, bytes, usage)) {
    memory_ = device.allocate(requirements(device), properties_of(kind));
    bind(device, memory_.get(), 0);
    if (kind != MemoryKind::device) {
        void* address = nullptr;
        check(device.vk.vkMapMemory(device.handle(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &address),
              "vkMapMemory");
        mapped_ = static_cast<std::byte*>(address);
    }
}

Image Image::unbound(const Device& device, const ImageDesc& desc) {
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = desc.format;
    info.extent = {desc.width, desc.height, 1};
    info.mipLevels = desc.mip_levels;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = desc.usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    VkImage handle{};
    check(device.vk.vkCreateImage(device.handle(), &info, nullptr, &handle), "vkCreateImage");
    Image image;
    image.desc_ = desc;
    image.image_ = {handle, [&device](VkImage i) { device.vk.vkDestroyImage(device.handle(), i, nullptr); }};
    return image;
}

VkMemoryRequirements Image::requirements(const Device& device) const {
    VkMemoryRequirements requirements{};
    device.vk.vkGetImageMemoryRequirements(device.handle(), handle(), &requirements);
    return requirements;
}

void Image::bind(const Device& device, VkDeviceMemory block, VkDeviceSize offset) {
    check(device.vk.vkBindImageMemory(device.handle(), handle(), block, offset), "vkBindImageMemory");
    view_ = create_view(device, handle(), desc_.format, aspect(), 0, desc_.mip_levels);
    if (desc_.mip_levels > 1 && (desc_.usage & VK_IMAGE_USAGE_STORAGE_BIT)) {
        for (std::uint32_t level = 0; level < desc_.mip_levels; ++level) {
            mip_views_.push_back(create_view(device, handle(), desc_.format, aspect(), level, 1));
        }
    }
}

Image::Image(const Device& device, const ImageDesc& desc) : Image(unbound(device, desc)) {
    memory_ = device.allocate(requirements(device), VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    bind(device, memory_.get(), 0);
}

VkImageAspectFlags Image::aspect() const noexcept {
    return desc_.format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

Owned<VkSampler> create_sampler(const Device& device, const SamplerDesc& desc) {
    VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.magFilter = desc.magnify;
    info.minFilter = desc.minify;
    info.mipmapMode = desc.mip;
    info.addressModeU = desc.wrap_u;
    info.addressModeV = desc.wrap_v;
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.maxLod = desc.max_lod;
    info.maxAnisotropy = std::min(desc.anisotropy, device.max_anisotropy());
    info.anisotropyEnable = info.maxAnisotropy > 1.0f;
    VkSampler sampler{};
    check(device.vk.vkCreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
    return {sampler, [&device](VkSampler s) { device.vk.vkDestroySampler(device.handle(), s, nullptr); }};
}

std::uint32_t full_mip_count(std::uint32_t width, std::uint32_t height) {
    return static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
}

}  // namespace candela::gpu
