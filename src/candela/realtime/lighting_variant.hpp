#pragma once

#include "candela/realtime/frame_resources.hpp"

namespace candela::realtime {

/// One pass as three shaders. Specialization constants leave out of a pipeline what a scene does not need,
/// but the driver reads all of the shader to find out: seconds on a software device for lights that a scene
/// has not.
struct LightingVariants {
    gpu::SpirV plain;    ///< lights without extent, without shadows
    gpu::SpirV shadows;  ///< lights without extent
    gpu::SpirV all;
};

[[nodiscard]] inline gpu::SpirV choose(const LightingVariants& v, const FrameResources& frame,
                                       const GpuScene& scene) {
    if ((scene.light_list.kinds & kAreaKinds) != 0) return v.all;
    return frame.shadow_kinds != 0 ? v.shadows : v.plain;
}

}  // namespace candela::realtime
