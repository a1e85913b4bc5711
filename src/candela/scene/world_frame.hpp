#pragma once

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace candela::scene {

/// Where a scene's own coordinates lie: world = origin_m + unit_m * own. Everything in a Scene is in its own
/// coordinates, in single precision; what people and files state and read is in the world's.
struct WorldFrame {
    glm::dvec3 origin_m{0.0};
    double unit_m = 1.0;  ///< a power of two, so that changing the unit rounds nothing

    [[nodiscard]] glm::vec3 to_own(const glm::dvec3& world_m) const {
        return glm::vec3((world_m - origin_m) / unit_m);
    }
    [[nodiscard]] glm::dvec3 to_world(const glm::vec3& own) const {
        return origin_m + unit_m * glm::dvec3(own);
    }
    /// Of an affine matrix to the scene's own coordinates: the one to the world.
    [[nodiscard]] glm::dmat4 to_world(const glm::mat4& own) const {
        return glm::scale(glm::translate(glm::dmat4(1.0), origin_m), glm::dvec3(unit_m)) * glm::dmat4(own);
    }
    /// The way back.
    [[nodiscard]] glm::mat4 to_own(const glm::dmat4& world) const {
        return glm::mat4(glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 / unit_m)) *
                         glm::translate(glm::dmat4(1.0), -origin_m) * world);
    }
};

}  // namespace candela::scene
