#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "candela/gpu/device.hpp"

namespace candela::gpu {

/// What the validation layer said. Filled from the Vulkan callback, which may run on any thread.
class MessageLog {
  public:
    void add(const char* text) noexcept;
    [[nodiscard]] std::vector<std::string> messages() const;

  private:
    mutable std::mutex mutex_;
    std::vector<std::string> messages_;
};

struct Instance {
    Owned<VkInstance> instance;
    Owned<VkDebugUtilsMessengerEXT> messenger;
    bool validating = false;
};

/// `log` must outlive the instance; it is used only when `validation` is on and the layer is installed.
[[nodiscard]] Instance create_instance(bool validation, MessageLog& log);

/// In the order the loader gives them.
[[nodiscard]] std::vector<VkPhysicalDevice> physical_devices(VkInstance instance);
[[nodiscard]] DeviceInfo describe(VkPhysicalDevice device, std::uint32_t index);

}  // namespace candela::gpu
