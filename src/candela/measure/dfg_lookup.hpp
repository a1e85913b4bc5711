#pragma once

#include "candela/truth/albedo_table.hpp"
#include "shading/dfg.glsl"

namespace candela::measure {

enum class DfgKind : std::uint8_t { smith_correlated, ue4_schlick_smith };

/// The first two channels of the table that the frame reads (bake/dfg_table.cpp) and the path tracer shares:
/// scale of f0 and bias.
class DfgLookup {
  public:
    explicit DfgLookup(DfgKind kind);

    /// Bilinear, as a sampler reads it. Both in [0,1].
    [[nodiscard]] glm::vec2 read(float NoV, float perceptual_roughness) const;

  private:
    truth::AlbedoTable table_;
};

/// Scale and bias of both models by `samples` visible normals drawn independently of the table's quadrature,
/// summed in double precision. x, y: height-correlated Smith; z, w: Schlick-Smith with k = alpha / 2.
[[nodiscard]] glm::dvec4 dfg_truth(float NoV, float perceptual_roughness, std::uint32_t samples);

}  // namespace candela::measure
