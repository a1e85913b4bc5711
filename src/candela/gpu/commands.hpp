#pragma once

#include <array>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "candela/gpu/pipeline.hpp"

namespace candela::gpu {

/// Time of one named pass on the device.
struct PassTime {
    std::string name;
    double milliseconds = 0.0;
};

/// What a target holds before the first draw: what it held, zero, or nothing in particular.
enum class Load : std::uint8_t { keep, clear, discard };

struct ColorTarget {
    Image* image = nullptr;
    Load load = Load::keep;
};
struct DepthTarget {
    Image* image = nullptr;
    Load load = Load::keep;
};

/// Records one command buffer, puts the barriers between passes by itself, and times them: the one-frame
/// graph. A pass says what it uses, how; everything it does not name it must not touch.
class Commands {
  public:
    explicit Commands(const Device& device);
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    void begin();
    /// Submits and waits for the device.
    void submit_and_wait();

    /// Barriers for what the next commands do with a resource.
    void use(Image& image, Use use);
    void use(Buffer& buffer, Use use);
    /// Everything so far ends before anything after: for memory that another resource had.
    void full_barrier();

    /// Starts a named, timed pass; ends the one before.
    void begin_pass(std::string name);

    void dispatch(const ComputePipeline& pipeline, std::span<const Binding> bindings,
                  std::span<const std::byte> push, std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);
    void dispatch_indirect(const ComputePipeline& pipeline, std::span<const Binding> bindings,
                           std::span<const std::byte> push, Buffer& arguments, VkDeviceSize offset);

    void begin_rendering(std::span<const ColorTarget> colors, const std::optional<DepthTarget>& depth);
    void end_rendering();

    void copy(Buffer& from, Buffer& to, VkDeviceSize bytes, VkDeviceSize from_offset = 0);
    void copy(Buffer& from, Image& to, std::uint32_t level = 0, VkDeviceSize from_offset = 0);
    /// Rows [first, first + rows) of level 0, tightly packed from `from_offset` on.
    void copy_rows(Buffer& from, Image& to, std::uint32_t first, std::uint32_t rows,
                   VkDeviceSize from_offset = 0);
    void copy(Image& from, Buffer& to, std::uint32_t level = 0);
    /// Copies one mip level between images of the same size and format.
    void copy_level(Image& from, Image& to, std::uint32_t level);
    void fill(Buffer& buffer, std::uint32_t word);

    [[nodiscard]] VkCommandBuffer handle() const noexcept { return buffer_; }
    [[nodiscard]] const Device& device() const noexcept { return *device_; }
    /// Sets made here live until the next begin().
    [[nodiscard]] DescriptorAllocator& descriptors() noexcept { return descriptors_; }

    /// Times of the passes of the last submission, in order.
    [[nodiscard]] std::vector<PassTime> pass_times() const;

  private:
    void bind(const ComputePipeline& pipeline, std::span<const Binding> bindings,
              std::span<const std::byte> push);
    void timestamp(std::uint32_t query);

    const Device* device_;
    Owned<VkCommandPool> pool_;
    VkCommandBuffer buffer_{};
    Owned<VkFence> fence_;
    Owned<VkQueryPool> queries_;
    DescriptorAllocator descriptors_;
    std::vector<std::string> passes_;
    double nanoseconds_per_tick_ = 0.0;
};

/// Bytes of a trivially copyable push-constant block.
template <class T>
[[nodiscard]] std::span<const std::byte> push(const T& block) {
    static_assert(sizeof(T) <= 128 && sizeof(T) % 4 == 0);
    return std::as_bytes(std::span(&block, 1));
}

/// A device-local buffer with these bytes in it.
[[nodiscard]] Buffer upload_buffer(const Device& device, Commands& commands, std::span<const std::byte> bytes,
                                   VkBufferUsageFlags usage);

}  // namespace candela::gpu
