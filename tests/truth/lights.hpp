#pragma once

#include "trace.hpp"

namespace candela::test {

/// A light of luminance or intensity 1000 about `position` that shines along `direction`; `visible` is off,
/// so that meters may look through it.
inline scene::Light light_of(scene::LightType type, const glm::vec3& position,
                             const glm::vec3& direction = {0, -1, 0}) {
    scene::Light l;
    l.type = type;
    l.position = position;
    l.direction = glm::normalize(direction);
    const glm::vec3 other = std::abs(l.direction.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
    l.right = glm::normalize(other - l.direction * glm::dot(other, l.direction));
    l.intensity = 1000.0f;
    l.radius_m = 0.3f;
    l.half_width_m = 0.6f;
    l.half_height_m = 0.4f;
    l.visible = false;
    return l;
}

inline scene::Scene floor_under(std::vector<scene::Light> lights, const scene::Material& floor = grey(0.5f)) {
    scene::Scene s;
    place(s, flat_square(20.0f, glm::vec3(0.0f), true), floor);
    s.lights = std::move(lights);
    return s;
}

/// Illuminance in lx at the origin of a floor whose normal is +Y.
inline double floor_lx(const scene::Scene& s, truth::Draws draws = truth::Draws::all,
                       std::uint32_t samples = 512) {
    truth::PathOptions o = path_options(true);
    o.draws = draws;
    return mean_luminance(s, spot_meter({2.5f, 0.4f, 0.0f}), o, samples).y * 3.14159265358979 / 0.5;
}
inline double floor_lx(const scene::Light& light) {
    return floor_lx(floor_under({light}));
}

}  // namespace candela::test
