#include "candela/gpu/instance.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "candela/scene/error.hpp"

namespace candela::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

bool layer_installed(const char* name) {
    std::uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    return std::any_of(layers.begin(), layers.end(),
                       [&](const VkLayerProperties& l) { return std::strcmp(l.layerName, name) == 0; });
}

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    static_cast<MessageLog*>(user)->add(data->pMessage);
    return VK_FALSE;
}

DeviceKind kind_of(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return DeviceKind::discrete;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return DeviceKind::integrated;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return DeviceKind::virtual_gpu;
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return DeviceKind::cpu;
        default:
            return DeviceKind::other;
    }
}

}  // namespace

void MessageLog::add(const char* text) noexcept {
    try {
        const std::lock_guard lock(mutex_);
        messages_.emplace_back(text);
    } catch (...) {
        // Out of memory inside the driver's callback: losing a message is better than throwing through C.
    }
}

std::vector<std::string> MessageLog::messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
}

Instance create_instance(bool validation, MessageLog& log) {
    if (volkInitialize() != VK_SUCCESS) {
        throw machine_error("no Vulkan loader (libvulkan.so.1)", {},
                            "install libvulkan1 and mesa-vulkan-drivers");
    }
    Instance out;
    out.validating = validation && layer_installed(kValidationLayer);

    VkApplicationInfo app{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    app.pApplicationName = "candela";
    app.pEngineName = "candela";
    app.apiVersion = VK_API_VERSION_1_3;

    VkDebugUtilsMessengerCreateInfoEXT messages{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messages.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messages.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messages.pfnUserCallback = on_message;
    messages.pUserData = &log;

    const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &app;
    if (out.validating) {
        info.pNext = &messages;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &kValidationLayer;
        info.enabledExtensionCount = 1;
        info.ppEnabledExtensionNames = &extension;
    }
    VkInstance instance{};
    const VkResult created = vkCreateInstance(&info, nullptr, &instance);
    if (created == VK_ERROR_INCOMPATIBLE_DRIVER) {
        throw machine_error("no Vulkan driver found", {},
                            "install a GPU driver, or mesa-vulkan-drivers for the CPU");
    }
    check(created, "vkCreateInstance");
    volkLoadInstanceOnly(instance);
    out.instance = {instance, [](VkInstance i) { vkDestroyInstance(i, nullptr); }};
    if (out.validating) {
        VkDebugUtilsMessengerEXT messenger{};
        check(vkCreateDebugUtilsMessengerEXT(instance, &messages, nullptr, &messenger),
              "vkCreateDebugUtilsMessengerEXT");
        out.messenger = {messenger, [instance](VkDebugUtilsMessengerEXT m) {
                             vkDestroyDebugUtilsMessengerEXT(instance, m, nullptr);
                         }};
    }
    return out;
}

std::vector<VkPhysicalDevice> physical_devices(VkInstance instance) {
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "vkEnumeratePhysicalDevices");
    return devices;
}

DeviceInfo describe(VkPhysicalDevice device, std::uint32_t index) {
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver, {}};
    vkGetPhysicalDeviceProperties2(device, &properties);
    DeviceInfo info;
    info.index = index;
    info.name = properties.properties.deviceName;
    info.kind = kind_of(properties.properties.deviceType);
    info.api_version = properties.properties.apiVersion;
    if (info.api_version < VK_API_VERSION_1_3) {
        info.why_unusable = "Vulkan 1.3 is needed";
        return info;
    }
    info.driver = std::string(driver.driverName) + " " + driver.driverInfo;

    VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &v13, {}};
    vkGetPhysicalDeviceFeatures2(device, &features);
    if (!v13.dynamicRendering || !v13.synchronization2) {
        info.why_unusable = "dynamic rendering and synchronization2 are needed";
    } else if (!features.features.independentBlend) {
        info.why_unusable = "independent blend is needed";
    }
    info.usable = info.why_unusable.empty();
    return info;
}

}  // namespace candela::gpu
