#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "candela/gpu/device.hpp"

namespace candela::gpu {

/// How a resource is used by the next command; Commands derives barriers and layouts from it.
enum class Use : std::uint8_t {
    undefined,
    sampled,        ///< texture or uniform/storage read in any shader
    storage_read,   ///< buffer read in any shader
    storage_write,  ///< written (and read) by a compute shader; images in GENERAL layout
    color_target,
    depth_target,
    transfer_source,
    transfer_destination,
    vertex_input,               ///< vertex and index buffers
    indirect_and_storage_read,  ///< dispatch arguments in a buffer that the shader reads too
};

/// Last use, so that the next one knows what to wait for.
struct UseState {
    Use use = Use::undefined;
};

enum class MemoryKind : std::uint8_t {
    device,    ///< fast for the device, not mapped
    upload,    ///< mapped, written by the host
    readback,  ///< mapped, read by the host
};

class Buffer {
  public:
    Buffer() = default;
    /// `bytes` > 0; `usage` gets the transfer bits by itself.
    Buffer(const Device& device, std::size_t bytes, VkBufferUsageFlags usage, MemoryKind kind);
    /// Without memory of its own: bind() gives it a part of a block, device local, before it is used.
    [[nodiscard]] static Buffer unbound(const Device& device, std::size_t bytes, VkBufferUsageFlags usage);
    [[nodiscard]] VkMemoryRequirements requirements(const Device& device) const;
    void bind(const Device& device, VkDeviceMemory block, VkDeviceSize offset);

    [[nodiscard]] VkBuffer handle() const noexcept { return buffer_.get(); }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    /// Host address of upload and readback buffers; nullptr for device memory.
    [[nodiscard]] std::byte* mapped() const noexcept { return mapped_; }
    template <class T>
    [[nodiscard]] std::span<T> mapped_as() const noexcept {
        return {reinterpret_cast<T*>(mapped_), size_ / sizeof(T)};
    }
    explicit operator bool() const noexcept { return static_cast<bool>(buffer_); }

    UseState state;

  private:
    Owned<VkDeviceMemory> memory_;
    Owned<VkBuffer> buffer_;
    std::size_t size_ = 0;
    std::byte* mapped_ = nullptr;
};

struct ImageDesc {
    std::uint32_t width = 1;
    std::uint32_t height = 1;
    VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
    VkImageUsageFlags usage = 0;  ///< transfer bits are added
    std::uint32_t mip_levels = 1;
};

/// A 2D image with a view of all mips and one view a mip.
class Image {
  public:
    Image() = default;
    Image(const Device& device, const ImageDesc& desc);
    /// Without memory of its own: bind() gives it a part of a block, before it is used.
    [[nodiscard]] static Image unbound(const Device& device, const ImageDesc& desc);
    [[nodiscard]] VkMemoryRequirements requirements(const Device& device) const;
    void bind(const Device& device, VkDeviceMemory block, VkDeviceSize offset);

    [[nodiscard]] VkImage handle() const noexcept { return image_.get(); }
    [[nodiscard]] VkImageView view() const noexcept { return view_.get(); }
    [[nodiscard]] VkImageView mip_view(std::uint32_t level) const {
        return mip_views_.empty() ? view_.get() : mip_views_.at(level).get();
    }
    [[nodiscard]] const ImageDesc& desc() const noexcept { return desc_; }
    [[nodiscard]] VkImageAspectFlags aspect() const noexcept;
    [[nodiscard]] VkExtent2D extent() const noexcept { return {desc_.width, desc_.height}; }
    explicit operator bool() const noexcept { return static_cast<bool>(image_); }

    UseState state;

  private:
    Owned<VkDeviceMemory> memory_;
    Owned<VkImage> image_;
    Owned<VkImageView> view_;
    std::vector<Owned<VkImageView>> mip_views_;
    ImageDesc desc_;
};

struct SamplerDesc {
    VkFilter magnify = VK_FILTER_LINEAR;
    VkFilter minify = VK_FILTER_LINEAR;
    VkSamplerMipmapMode mip = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    VkSamplerAddressMode wrap_u = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSamplerAddressMode wrap_v = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    float max_lod = VK_LOD_CLAMP_NONE;
    float anisotropy = 1.0f;
};
[[nodiscard]] Owned<VkSampler> create_sampler(const Device& device, const SamplerDesc& desc);

/// Levels of a full mip chain down to 1 x 1.
[[nodiscard]] std::uint32_t full_mip_count(std::uint32_t width, std::uint32_t height);

}  // namespace candela::gpu
