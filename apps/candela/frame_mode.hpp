#pragma once

#include <string>

#include "candela/realtime/renderer.hpp"
#include "job.hpp"

namespace candela::app {

struct FrameModeOptions {
    bool integrate = false;  ///< the frame's integrals in full instead of its techniques
    std::uint32_t samples = 4;
    std::uint32_t seed = 0;
    bool aovs = false;
    Shadows shadows = Shadows::map;  ///< map in real time, ray in integrate, or none
    std::uint32_t shadow_atlas_texels = 4096;
    std::string label = "rendering";  ///< of what is shown while it lasts
};

/// Samples a pixel of a mode on the device when nothing is said: realtime, or integrate.
[[nodiscard]] std::uint32_t default_samples(bool integrate);

struct FrameModeStill {
    realtime::Still still;
    double setup_s = 0.0;
    double render_s = 0.0;
    std::uint32_t unshadowed_lights = 0;
};

/// Renders the job on the device, its probes filled first where its techniques read them. Throws Error.
[[nodiscard]] FrameModeStill render_on_device(const gpu::Device& device, Job& job,
                                              const FrameModeOptions& options);

}  // namespace candela::app
