#pragma once

#include "candela/gpu/device.hpp"
#include "candela/realtime/renderer.hpp"
#include "common/scenes.hpp"

namespace candela::test {

inline gpu::DeviceOptions validated() {
    gpu::DeviceOptions options;
    options.validation = true;
    return options;
}

inline realtime::RendererOptions options(const std::string& profile, std::uint32_t size = 32,
                                         std::uint32_t samples = 1) {
    realtime::RendererOptions o;
    o.width = o.height = size;
    o.samples = samples;
    o.profile = realtime::profile_by_name(profile);
    return o;
}

inline glm::vec3 center(const realtime::Still& still) {
    return glm::vec3(still.planes.light_nit[std::size_t{still.height / 2} * still.width + still.width / 2]);
}

}  // namespace candela::test
