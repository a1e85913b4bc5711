#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "candela/scene/progress.hpp"

namespace candela::bake {

enum class DfgVisibility : std::uint8_t { smith_correlated, smith_uncorrelated, schlick_smith };

/// Directional albedos for other programs: f0 scale, f90 bias, Disney's diffuse (1 with schlick_smith, whose
/// diffuse is Lambert's) and sheen. x is the root of NoV, y the perceptual roughness, 0 and 1 at the centres
/// of the outer texels, as shading/dfg.glsl has it.
struct DfgTable {
    std::uint32_t size = 0;
    std::vector<glm::vec4> texels;

    /// Bilinear.
    [[nodiscard]] glm::vec4 read(float NoV, float perceptual_roughness) const;
};

/// One texel's four numbers by quadrature of `sample_count` points.
[[nodiscard]] glm::vec4 dfg_entry(DfgVisibility visibility, float NoV, float perceptual_roughness,
                                  std::uint32_t sample_count);

[[nodiscard]] DfgTable bake_dfg(DfgVisibility visibility, std::uint32_t size, std::uint32_t sample_count,
                                const ProgressFunction& progress = {});

}  // namespace candela::bake
