#pragma once

#define VK_NO_PROTOTYPES
#include <volk.h>

#include <functional>
#include <utility>

namespace candela::gpu {

/// Throws Error (Fault::machine) that names the call and the result, with a hint for out-of-memory and lost
/// devices.
void check(VkResult result, const char* call);

/// A Vulkan object and the way to destroy it; move-only.
template <class Handle>
class Owned {
  public:
    Owned() = default;
    Owned(Handle handle, std::function<void(Handle)> destroy)
        : handle_(handle), destroy_(std::move(destroy)) {}
    Owned(Owned&& other) noexcept
        : handle_(std::exchange(other.handle_, Handle{})), destroy_(std::move(other.destroy_)) {}
    Owned& operator=(Owned&& other) noexcept {
        std::swap(handle_, other.handle_);
        std::swap(destroy_, other.destroy_);
        return *this;
    }
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;
    ~Owned() {
        if (handle_) destroy_(handle_);
    }

    [[nodiscard]] Handle get() const noexcept { return handle_; }
    [[nodiscard]] const Handle* address() const noexcept { return &handle_; }
    explicit operator bool() const noexcept { return handle_ != Handle{}; }

  private:
    Handle handle_{};
    std::function<void(Handle)> destroy_;
};

}  // namespace candela::gpu
