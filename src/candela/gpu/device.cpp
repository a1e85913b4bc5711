#include "candela/gpu/device.hpp"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include "candela/gpu/instance.hpp"
#include "candela/scene/error.hpp"

namespace candela::gpu {

void check(VkResult result, const char* call) {
    if (result == VK_SUCCESS) return;
    const std::string text =
        std::string(call) + " failed (VkResult " + std::to_string(static_cast<int>(result)) + ")";
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            throw machine_error(text, {}, "out of memory: a smaller --size or fewer --samples needs less");
        case VK_ERROR_DEVICE_LOST:
            throw machine_error(text, {}, "the GPU was reset; --device cpu renders without it");
        default:
            throw machine_error(text);
    }
}

std::filesystem::path user_cache_folder() {
    if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && *xdg == '/')
        return std::filesystem::path(xdg) / "candela";
    if (const char* home = std::getenv("HOME"); home && *home == '/') {
        return std::filesystem::path(home) / ".cache" / "candela";
    }
    return {};
}

namespace {

int preference(const DeviceInfo& info) {
    switch (info.kind) {
        case DeviceKind::discrete:
            return 4;
        case DeviceKind::integrated:
            return 3;
        case DeviceKind::virtual_gpu:
            return 2;
        case DeviceKind::cpu:
            return 1;
        default:
            return 0;
    }
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

bool matches(const DeviceInfo& info, const std::string& select) {
    if (select == "auto") return true;
    if (select == "cpu") return info.kind == DeviceKind::cpu;
    if (std::all_of(select.begin(), select.end(), [](unsigned char c) { return std::isdigit(c); })) {
        return std::to_string(info.index) == select;
    }
    return lower(info.name).find(lower(select)) != std::string::npos;
}

DeviceInfo choose(const std::vector<DeviceInfo>& devices, const std::string& select) {
    const DeviceInfo* best = nullptr;
    std::string refused;
    for (const DeviceInfo& info : devices) {
        if (!matches(info, select)) continue;
        if (!info.usable) {
            refused = info.name + ": " + info.why_unusable;
        } else if (!best || preference(info) > preference(*best)) {
            best = &info;
        }
    }
    if (best) return *best;
    if (!refused.empty()) throw machine_error("no usable Vulkan device", "--device " + select, refused);
    if (select != "auto") {
        throw Error(Fault::usage, "no such device", "--device " + select, "candela info lists the devices");
    }
    throw machine_error("no Vulkan device", {}, "install a GPU driver, or mesa-vulkan-drivers for the CPU");
}

std::vector<DeviceInfo> describe_all(VkInstance instance) {
    std::vector<DeviceInfo> infos;
    for (const VkPhysicalDevice device : physical_devices(instance)) {
        infos.push_back(describe(device, static_cast<std::uint32_t>(infos.size())));
    }
    return infos;
}

std::uint32_t find_queue_family(VkPhysicalDevice physical) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    constexpr VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & wanted) == wanted) return i;
    }
    throw machine_error("the device has no queue for graphics and compute");
}

std::string hex(const std::uint8_t* bytes, std::size_t count) {
    constexpr const char* digits = "0123456789abcdef";
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
        text += digits[bytes[i] >> 4];
        text += digits[bytes[i] & 15];
    }
    return text;
}

std::vector<char> read_cache(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

std::vector<DeviceInfo> list_devices() {
    MessageLog log;
    const Instance instance = create_instance(false, log);
    return describe_all(instance.instance.get());
}

struct Device::State {
    MessageLog log;
    Instance instance;
    VkPhysicalDevice physical{};
    DeviceInfo info;
    VkPhysicalDeviceProperties properties{};
    VkPhysicalDeviceMemoryProperties memory{};
    float max_anisotropy = 1.0f;
    std::uint32_t queue_family = 0;
    Owned<VkDevice> device;
    VkQueue queue{};
    Owned<VkPipelineCache> cache;
    std::filesystem::path cache_file;
    std::size_t cache_bytes_loaded = 0;
    std::atomic<std::uint64_t> allocated_bytes = 0;
    std::atomic<std::uint64_t> peak_bytes = 0;
};

Device::Device(const DeviceOptions& options) : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.instance = create_instance(options.validation, s.log);
    s.info = choose(describe_all(s.instance.instance.get()), options.select);
    s.physical = physical_devices(s.instance.instance.get())[s.info.index];
    vkGetPhysicalDeviceProperties(s.physical, &s.properties);
    vkGetPhysicalDeviceMemoryProperties(s.physical, &s.memory);
    s.queue_family = find_queue_family(s.physical);

    VkPhysicalDeviceFeatures available{};
    vkGetPhysicalDeviceFeatures(s.physical, &available);
    VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    v13.dynamicRendering = VK_TRUE;
    v13.synchronization2 = VK_TRUE;
    v13.maintenance4 = VK_TRUE;  // glslc writes LocalSizeId for Vulkan 1.3
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &v13, {}};
    features.features.independentBlend = VK_TRUE;
    features.features.samplerAnisotropy = available.samplerAnisotropy;
    features.features.fragmentStoresAndAtomics = available.fragmentStoresAndAtomics;
    if (available.samplerAnisotropy)
        s.max_anisotropy = std::min(8.0f, s.properties.limits.maxSamplerAnisotropy);

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = s.queue_family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features};
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    VkDevice device{};
    check(vkCreateDevice(s.physical, &info, nullptr, &device), "vkCreateDevice");
    volkLoadDeviceTable(&vk, device);
    s.device = {device, [destroy = vk.vkDestroyDevice](VkDevice d) { destroy(d, nullptr); }};
    vk.vkGetDeviceQueue(device, s.queue_family, 0, &s.queue);

    std::vector<char> cached;
    if (!options.cache_folder.empty()) {
        s.cache_file = options.cache_folder /
                       ("pipelines-" + hex(s.properties.pipelineCacheUUID, VK_UUID_SIZE) + ".bin");
        cached = read_cache(s.cache_file);
    }
    s.cache_bytes_loaded = cached.size();
    VkPipelineCacheCreateInfo cache_info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    cache_info.initialDataSize = cached.size();
    cache_info.pInitialData = cached.data();
    VkPipelineCache cache{};
    check(vk.vkCreatePipelineCache(device, &cache_info, nullptr, &cache), "vkCreatePipelineCache");
    s.cache = {cache, [device, destroy = vk.vkDestroyPipelineCache](VkPipelineCache c) {
                   destroy(device, c, nullptr);
               }};
}

Device::~Device() {
    vk.vkDeviceWaitIdle(state_->device.get());
    save_pipeline_cache();
}

VkDevice Device::handle() const noexcept {
    return state_->device.get();
}
VkPhysicalDevice Device::physical() const noexcept {
    return state_->physical;
}
VkQueue Device::queue() const noexcept {
    return state_->queue;
}
std::uint32_t Device::queue_family() const noexcept {
    return state_->queue_family;
}
VkPipelineCache Device::pipeline_cache() const noexcept {
    return state_->cache.get();
}
const DeviceInfo& Device::info() const noexcept {
    return state_->info;
}
const VkPhysicalDeviceLimits& Device::limits() const noexcept {
    return state_->properties.limits;
}
float Device::max_anisotropy() const noexcept {
    return state_->max_anisotropy;
}
std::vector<std::string> Device::validation_messages() const {
    return state_->log.messages();
}
bool Device::validating() const noexcept {
    return state_->instance.validating;
}
std::uint64_t Device::peak_memory_bytes() const noexcept {
    return state_->peak_bytes;
}

bool Device::supports(VkFormat format, VkFormatFeatureFlags features) const {
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(state_->physical, format, &properties);
    return (properties.optimalTilingFeatures & features) == features;
}

Owned<VkDeviceMemory> Device::allocate(const VkMemoryRequirements& requirements,
                                       VkMemoryPropertyFlags wanted) const {
    State& s = *state_;
    const auto find = [&](VkMemoryPropertyFlags flags) {
        for (std::uint32_t i = 0; i < s.memory.memoryTypeCount; ++i) {
            if ((requirements.memoryTypeBits >> i & 1u) &&
                (s.memory.memoryTypes[i].propertyFlags & flags) == flags) {
                return i;
            }
        }
        return VK_MAX_MEMORY_TYPES;
    };
    std::uint32_t type = find(wanted);
    if (type == VK_MAX_MEMORY_TYPES)
        type = find(wanted & ~VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_HOST_CACHED_BIT});
    if (type == VK_MAX_MEMORY_TYPES && wanted == VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) type = find(0);
    if (type == VK_MAX_MEMORY_TYPES)
        throw machine_error("the device has no memory of the kind that is needed");

    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.allocationSize = requirements.size;
    info.memoryTypeIndex = type;
    VkDeviceMemory memory{};
    check(vk.vkAllocateMemory(s.device.get(), &info, nullptr, &memory), "vkAllocateMemory");
    const std::uint64_t now = s.allocated_bytes += requirements.size;
    s.peak_bytes = std::max(s.peak_bytes.load(), now);
    return {memory, [this, size = requirements.size](VkDeviceMemory m) {
                vk.vkFreeMemory(state_->device.get(), m, nullptr);
                state_->allocated_bytes -= size;
            }};
}

void Device::save_pipeline_cache() const noexcept {
    try {
        const State& s = *state_;
        if (s.cache_file.empty()) return;
        std::size_t size = 0;
        if (vk.vkGetPipelineCacheData(s.device.get(), s.cache.get(), &size, nullptr) != VK_SUCCESS) return;
        if (size <= s.cache_bytes_loaded) return;
        std::vector<char> data(size);
        if (vk.vkGetPipelineCacheData(s.device.get(), s.cache.get(), &size, data.data()) != VK_SUCCESS)
            return;
        std::error_code error;
        std::filesystem::create_directories(s.cache_file.parent_path(), error);
        const std::filesystem::path temporary = s.cache_file.string() + ".tmp";
        {
            std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
            out.write(data.data(), static_cast<std::streamsize>(size));
            if (!out) return;
        }
        std::filesystem::rename(temporary, s.cache_file, error);
    } catch (...) {
        return;
    }
}

}  // namespace candela::gpu
