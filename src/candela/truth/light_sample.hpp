#pragma once

#include <glm/vec3.hpp>
#include <limits>

namespace candela::truth {

/// One draw from the lights of a scene.
struct LightSample {
    glm::vec3 direction{0.0f};  ///< unit, from the receiver
    float distance_m = std::numeric_limits<float>::infinity();
    /// Luminance in cd/m^2 of what has an extent; of a light without one the illuminance in lx that it gives
    /// on a plane facing it.
    glm::vec3 light{0.0f};
    float pdf = 0.0f;      ///< 1/sr; of a light without extent the probability; 0: nothing was drawn
    bool delta = false;    ///< without extent: no other way of drawing directions finds it
    bool surface = false;  ///< an emissive triangle: rays find it among the surfaces
    bool casts_shadow = true;
};

}  // namespace candela::truth
