#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "candela/gpu/vulkan.hpp"

namespace candela::gpu {

enum class DeviceKind : std::uint8_t { discrete, integrated, virtual_gpu, cpu, other };

struct DeviceInfo {
    std::uint32_t index = 0;
    std::string name;
    std::string driver;  ///< name and version as the driver says them
    DeviceKind kind = DeviceKind::other;
    std::uint32_t api_version = 0;
    bool usable = false;       ///< Vulkan 1.3 with what the frame needs
    std::string why_unusable;  ///< empty when usable
};

struct DeviceOptions {
    std::string select = "auto";  ///< auto | cpu | index | part of a name
    bool validation = false;      ///< VK_LAYER_KHRONOS_validation when installed; messages are collected
    /// Pipelines are kept here between runs; empty: no file.
    std::filesystem::path cache_folder;
};

/// Folder of the user's cache for Candela: $XDG_CACHE_HOME/candela or ~/.cache/candela; empty when neither is
/// known.
[[nodiscard]] std::filesystem::path user_cache_folder();

/// Every Vulkan device of this machine. Throws Error (Fault::machine) when there is no Vulkan loader or
/// driver.
[[nodiscard]] std::vector<DeviceInfo> list_devices();

/// A Vulkan 1.3 device with one graphics-and-compute queue. Everything made from it must be destroyed before
/// it. Not thread-safe: one thread records and submits.
class Device {
  public:
    /// Throws Error: Fault::machine without a usable device, Fault::usage when `select` names none.
    explicit Device(const DeviceOptions& options);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    VolkDeviceTable vk{};  ///< device-level entry points

    [[nodiscard]] VkDevice handle() const noexcept;
    [[nodiscard]] VkPhysicalDevice physical() const noexcept;
    [[nodiscard]] VkQueue queue() const noexcept;
    [[nodiscard]] std::uint32_t queue_family() const noexcept;
    [[nodiscard]] VkPipelineCache pipeline_cache() const noexcept;
    [[nodiscard]] const DeviceInfo& info() const noexcept;
    [[nodiscard]] const VkPhysicalDeviceLimits& limits() const noexcept;
    [[nodiscard]] float max_anisotropy() const noexcept;  ///< 1 where unsupported

    /// True when optimal-tiling images of `format` have all of `features`.
    [[nodiscard]] bool supports(VkFormat format, VkFormatFeatureFlags features) const;

    /// Validation messages so far (warnings and errors); empty when validation is off or the code is right.
    [[nodiscard]] std::vector<std::string> validation_messages() const;
    [[nodiscard]] bool validating() const noexcept;

    /// Allocates memory of `type_bits` with the wanted properties, falling back from device-local to any.
    [[nodiscard]] Owned<VkDeviceMemory> allocate(const VkMemoryRequirements& requirements,
                                                 VkMemoryPropertyFlags wanted) const;
    [[nodiscard]] std::uint64_t peak_memory_bytes() const noexcept;

    /// Writes the pipeline cache file if pipelines were added. Failure is silent: a cache is only a cache.
    void save_pipeline_cache() const noexcept;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace candela::gpu
