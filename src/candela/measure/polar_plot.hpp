#pragma once

#include "candela/measure/drawing.hpp"
#include "candela/scene/photometric.hpp"

namespace candela::measure {

/// The polar diagram of a luminaire as its makers draw it: gamma from 0 at the bottom, C0 (solid) and C90
/// (dashed) on the right, C180 and C270 on the left, rings of intensity; the half that has no light is cut
/// off. `per_klm`: intensities for 1000 lm of the lamps, or of the luminaire where the lamps' flux is not
/// stated.
[[nodiscard]] Drawing polar_plot(const scene::PhotometricProfile& profile, bool per_klm);

}  // namespace candela::measure
