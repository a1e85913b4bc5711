#pragma once

#include <glm/vec4.hpp>

#include "candela/bake/ltc_table.hpp"
#include "candela/scene/progress.hpp"

/// The fit behind the table of linearly transformed cosines: Heitz et al. 2016, on the lobe D V
/// cos of height-correlated GGX without Fresnel, over its albedo.
namespace candela::bake {

struct LtcEntry {
    glm::vec4 texel;
    float error = 0.0f;  ///< as LtcTable::errors
};

/// The matrix with the smallest error, from a start. Nelder & Mead's simplex (1965) on half the integral of
/// |lobe - fit|; the papers take the cube, which the tails, and with them small lights, have no weight in.
/// Deterministic.
[[nodiscard]] LtcEntry fit_ltc_entry(float NoV, float perceptual_roughness, const glm::vec4& start);

/// Where the fit of the roughest entry of a column starts, and where that of another one starts: from its
/// rougher neighbour, whose widths scale with alpha.
[[nodiscard]] glm::vec4 rough_ltc_start(float NoV);
[[nodiscard]] glm::vec4 next_ltc_start(const glm::vec4& rougher, float perceptual_roughness,
                                       float rougher_perceptual_roughness);

/// The error of a texel that was not fitted here, such as an interpolated one.
[[nodiscard]] float ltc_error(float NoV, float perceptual_roughness, const glm::vec4& texel);

/// All entries, each started from its rougher neighbour, on all cores. The result does not depend on their
/// number.
[[nodiscard]] LtcTable fit_ltc_table(const ProgressFunction& progress = {});

}  // namespace candela::bake
