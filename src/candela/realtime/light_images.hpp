#pragma once

#include <vector>

#include "candela/scene/material.hpp"

namespace candela::realtime {

/// A picture that a rectangle shows, as shading/lights/rectangle_image.glsl reads it: linear RGB, square
/// levels from `size` texels a side down to one, each smooth, so that reading between its texels does not
/// show them. The last level is the mean.
struct ImagePyramid {
    int size = 1;
    std::vector<float> rgb;
};

/// An image without texels is white. At most 256 texels a side.
[[nodiscard]] ImagePyramid image_pyramid(const scene::Image& image);

}  // namespace candela::realtime
