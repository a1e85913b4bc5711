#pragma once

#include "candela/scene/scene.hpp"

/// Negative values in pictures of light: what Lanczos and other sharpening filters leave beside lamps.
namespace candela::scene {

/// Makes them 0. The light of the picture grows by what they had.
void clamp_negative(Environment& environment);

/// Makes them 0 and takes what they had, by solid angle, from the positive texels about them in proportion:
/// those of the smallest square of 2, 4, 8, ... texels a side that has as much. The sum of each channel over
/// all directions stays; a channel whose sum is negative becomes black.
void spread_negative(Environment& environment);

}  // namespace candela::scene
