#pragma once

#include "candela/measure/area_truth.hpp"
#include "candela/measure/lit_scene.hpp"
#include "candela/measure/numerics.hpp"

namespace candela::measure {

/// A technique of shading/lights/rectangle.glsl: n, to the centre, right, up, half width, half height.
using RectangleTechnique = float (*)(shading::vec3, shading::vec3, shading::vec3, shading::vec3, float,
                                     float);

/// A rectangle that lights the scene of Frostbite's figures of area lights.
struct LitRectangle {
    RectangleLight light;

    [[nodiscard]] RectangleLight seen_from(const glm::dvec3& position) const {
        RectangleLight l = light;
        l.center -= position;
        return l;
    }
    [[nodiscard]] LitScene scene() const {
        LitScene out;
        out.lamp = [l = light](const glm::dvec3& origin, const glm::dvec3& direction) {
            return ray_to_rectangle(origin, direction, l.center, l.right * l.half_width,
                                    l.up * l.half_height);
        };
        return out;
    }
    [[nodiscard]] Illuminance by(RectangleTechnique f) const {
        return [f, self = *this](const glm::dvec3& n, const glm::dvec3& position) {
            using shading::vec3;
            const RectangleLight l = self.seen_from(position);
            return double(f(vec3(n), vec3(l.center), vec3(l.right), vec3(l.up), float(l.half_width),
                            float(l.half_height)));
        };
    }
    [[nodiscard]] Illuminance truth() const {
        return [self = *this](const glm::dvec3& n, const glm::dvec3& position) {
            return illuminance_truth(n, self.seen_from(position), 4);
        };
    }
};

}  // namespace candela::measure
