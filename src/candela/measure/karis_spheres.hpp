#pragma once

#include <vector>

#include "candela/measure/specular_figure.hpp"

namespace candela::measure {

/// The metal spheres of Karis 2013, Figures 10, 12 and 13, from smooth to rough, all under one light.
[[nodiscard]] inline std::vector<SphereColumn> karis_spheres(const ShapedLight& light) {
    std::vector<SphereColumn> out;
    for (const float alpha : {0.02f, 0.05f, 0.1f, 0.25f, 0.5f}) out.push_back({light, alpha});
    return out;
}

[[nodiscard]] inline std::vector<SphereColumn> karis_spheres_under_sphere() {
    ShapedLight light = light_towards_spheres(LightShape::sphere, {-1.2f, 1.6f, 1.6f});
    light.radius = 0.7f;
    return karis_spheres(light);
}

[[nodiscard]] inline std::vector<SphereColumn> karis_spheres_under_tube() {
    ShapedLight light = light_towards_spheres(LightShape::tube, {0.0f, 1.7f, 1.4f});
    light.half_width = 1.5f;
    light.radius = 0.12f;
    return karis_spheres(light);
}

}  // namespace candela::measure
