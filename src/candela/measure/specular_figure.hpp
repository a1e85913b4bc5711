#pragma once

#include <string>
#include <vector>

#include "candela/measure/experiment.hpp"
#include "candela/measure/specular_techniques.hpp"

/// Pictures of metal spheres under one area light: a row a technique, the truth below.
namespace candela::measure {

/// A column: the light in the spheres' frame (radius 1 about the origin, seen from +z at a distance), and the
/// metal's width.
struct SphereColumn {
    ShapedLight light;
    float alpha = 0.1f;
};

/// A disk or rectangle at this place that shines on the spheres, or a sphere or tube (along x); its luminance
/// is display white.
[[nodiscard]] ShapedLight light_towards_spheres(LightShape shape, const glm::vec3& center);

/// Adds a picture with these techniques, by their labels, in this order, and the mean FLIP of each against
/// the truth with the bound of the same index.
void add_specular_figure(Findings& out, const std::string& title, const std::vector<SphereColumn>& columns,
                         const std::vector<std::string>& labels, const std::vector<double>& flip_at_most);

}  // namespace candela::measure
