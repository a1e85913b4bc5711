#pragma once

#include <cstdint>

#include "candela/gpu/commands.hpp"
#include "candela/scene/scene.hpp"

namespace candela::bake {

/// What the frame needs of a distant light. A texel times nit_per_unit is cd/m^2. Octahedral maps have
/// gutters of one texel on every level (octahedral_map.glsl), so that a bilinear fetch never crosses the
/// fold.
struct EnvironmentMaps {
    gpu::Image background;  ///< equirectangular, as given
    gpu::Image specular;    ///< octahedral, GGX-prefiltered (Karis 2013; Frostbite 4.9.2, the LD term), laid
                            ///< out as shading/specular_levels.glsl says
    gpu::Image irradiance;  ///< octahedral, irradiance / pi: what a white Lambert surface shows
    float nit_per_unit = 1.0f;
};

/// Who filters: the device with a shader, or the processor by filter_octahedral.
enum class Prefilter : std::uint8_t { device, processor };

/// Filters an environment where that is quicker.
[[nodiscard]] EnvironmentMaps prefilter_environment(const gpu::Device& device, gpu::Commands& commands,
                                                    const scene::Environment& environment);
[[nodiscard]] EnvironmentMaps prefilter_environment(const gpu::Device& device, gpu::Commands& commands,
                                                    const scene::Environment& environment, Prefilter where);

enum class DfgModel : std::uint8_t { smith_correlated, ue4_schlick_smith };

/// shading/dfg.glsl's table, kDfgSize x kDfgSize, RGBA32F: f0 scale, f90 bias, Disney diffuse, sheen.
[[nodiscard]] gpu::Image create_dfg_table(const gpu::Device& device, gpu::Commands& commands, DfgModel model);

/// Illuminance in lx on a horizontal plane that sees the upper half of the environment, its scale included.
[[nodiscard]] float upward_illuminance_lx(const scene::Environment& environment);

/// Built-in light for scenes that bring none: three softboxes over a dim grey room.
[[nodiscard]] scene::Environment studio_environment();

/// The same luminance from everywhere.
[[nodiscard]] scene::Environment constant_environment(float luminance_nit);

}  // namespace candela::bake
