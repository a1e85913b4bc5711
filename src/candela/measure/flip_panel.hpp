#pragma once

#include "candela/measure/experiment.hpp"

namespace candela::measure {

/// The FLIP map of two panels of one size, in the colours of magma: black 0, pale yellow 1.
[[nodiscard]] Panel flip_panel(const Panel& x, const Panel& reference);

}  // namespace candela::measure
