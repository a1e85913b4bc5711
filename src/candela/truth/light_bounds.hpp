#pragma once

#include "candela/truth/light_tree.hpp"
#include "candela/truth/textures.hpp"

namespace candela::truth {

/// Where a light that is not distant is, which way it shines, and its intensity in cd in the direction of
/// most light.
[[nodiscard]] LightBounds light_bounds(const scene::Light& light, const scene::Scene& scene,
                                       const Textures& textures);

}  // namespace candela::truth
