#pragma once

#include "common/contact_scenes.hpp"

/// What the tests of irradiance volumes place and light.
namespace candela::test {

inline scene::IrradianceVolume volume(const glm::vec3& middle, const glm::vec3& half_size_m,
                                      const glm::ivec3& cells,
                                      float fade_m = scene::IrradianceVolume{}.fade_m) {
    scene::IrradianceVolume v;
    v.world = at(middle);
    v.half_size_m = half_size_m;
    v.cells = cells;
    v.fade_m = fade_m;
    return v;
}

/// Two closed rooms of 2 m, one lamp: x from -2 to 2, a wall of 6 cm at 0.
inline scene::Scene bright_and_dark_room() {
    scene::Scene s;
    s.materials.push_back(grey(0.7f));
    for (const float side : {-1.0f, 1.0f}) {
        place(s, box({2.2f, 0.1f, 1.2f}), at({0, side * 1.1f, 0}));
        place(s, box({2.2f, 1.2f, 0.1f}), at({0, 0, side * 1.1f}));
        place(s, box({0.1f, 1.2f, 1.2f}), at({side * 2.1f, 0, 0}));
    }
    place(s, box({0.03f, 1.2f, 1.2f}), glm::mat4(1.0f));
    scene::Light lamp;
    lamp.position = {-1.0f, 0.3f, 0.1f};
    lamp.intensity = 100.0f;
    s.lights.push_back(lamp);
    return s;
}

}  // namespace candela::test
