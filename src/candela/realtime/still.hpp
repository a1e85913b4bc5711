#pragma once

#include <cstdint>
#include <vector>

#include "candela/gpu/commands.hpp"
#include "candela/realtime/picture_pass.hpp"

namespace candela::realtime {

/// A finished still, scene-referred: luminance in cd/m^2, exposure undone, row 0 on top. An unlit surface's
/// display-linear colour is in light_nit divided by the exposure, and in planes.unlit as it is.
struct Still {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    float ev100 = 0.0f;     ///< of the camera, automatic or not, compensation included
    float exposure = 0.0f;  ///< 1 / cd/m^2: luminance * exposure = 1 is white (shading/exposure.glsl)
    bool metered = false;   ///< the automatic exposure found something to meter
    PicturePass::Planes planes;
    std::vector<gpu::PassTime> pass_times;  ///< of the last sample
};

/// Adds the unlit colours of planes.unlit to planes.light_nit. Call once.
void add_unlit(Still& still);

/// Light in cd/m^2 without unlit surfaces; a: the fraction of the pixel that shows it.
[[nodiscard]] std::vector<glm::vec4> lit_nit(const Still& still);

/// What a display shows, linear in [0,1]: exposure, tone curve (shading/tone_curves.glsl), unlit colours as
/// they are.
[[nodiscard]] std::vector<glm::vec3> display_linear(const Still& still, std::uint32_t tone_curve);

}  // namespace candela::realtime
