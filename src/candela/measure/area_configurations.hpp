#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "candela/measure/area_truth.hpp"
#include "candela/measure/numerics.hpp"

/// Random area lights close to a receiver at the origin whose normal is z.
namespace candela::measure {

/// Uniform numbers, the same in every run.
class RandomNumbers {
  public:
    double operator()(double low, double high) {
        state_ ^= state_ << 13u;
        state_ ^= state_ >> 17u;
        state_ ^= state_ << 5u;
        return low + (high - low) * (double(state_) + 0.5) / 4294967296.0;
    }
    glm::dvec3 direction() {
        const double z = (*this)(-1.0, 1.0);
        const double a = (*this)(0.0, 2.0 * kPi);
        const double r = std::sqrt(1.0 - z * z);
        return {r * std::cos(a), r * std::sin(a), z};
    }
    /// Unit and perpendicular to unit v.
    glm::dvec3 perpendicular(const glm::dvec3& v) { return glm::normalize(glm::cross(v, direction())); }
    /// Unit, on the side of `towards`.
    glm::dvec3 direction_towards(const glm::dvec3& towards) {
        const glm::dvec3 v = direction();
        return glm::dot(v, towards) < 0.0 ? -v : v;
    }

  private:
    std::uint32_t state_ = 0x9e3779b9u;
};

/// How far a light reaches to both sides of its centre along z, the height over the receiver's horizon.
inline double reach(const SphereLight& l) {
    return l.radius;
}
inline double reach(const DiskLight& l) {
    return l.radius * std::sqrt(std::max(1.0 - l.direction.z * l.direction.z, 0.0));
}
inline double reach(const RectangleLight& l) {
    return l.half_width * std::abs(l.right.z) + l.half_height * std::abs(l.up.z);
}
inline double reach(const TubeLight& l) {
    return l.half_length * std::abs(l.axis.z) + l.radius;
}

/// Close range: the centre is within 1 to 3 times the light's largest half extent, a tube's within 0.5 to 3.
/// The light faces the receiver, who is outside of it.
inline void draw(RandomNumbers& u, SphereLight& l) {
    l.radius = u(0.1, 1.0);
    l.center = u.direction() * l.radius * u(1.02, 3.0);
}
inline void draw(RandomNumbers& u, DiskLight& l) {
    l.radius = u(0.1, 1.0);
    l.center = u.direction() * l.radius * u(1.0, 3.0);
    l.direction = -u.direction_towards(l.center);
}
inline void draw(RandomNumbers& u, RectangleLight& l) {
    l.half_width = u(0.1, 1.0);
    l.half_height = u(0.1, 1.0);
    l.center = u.direction() * std::max(l.half_width, l.half_height) * u(1.0, 3.0);
    const glm::dvec3 away = u.direction_towards(l.center);
    l.right = u.perpendicular(away);
    l.up = glm::cross(away, l.right);
}
inline void draw(RandomNumbers& u, TubeLight& l) {
    double outside = 0.0;
    do {
        l.half_length = u(0.1, 1.0);
        l.radius = l.half_length * u(0.02, 0.5);
        l.axis = u.direction();
        l.center = u.direction() * l.half_length * u(0.5, 3.0);
        const double nearest = std::clamp(-glm::dot(l.center, l.axis), -l.half_length, l.half_length);
        outside = glm::length(l.center + nearest * l.axis) / l.radius;
    } while (outside < 1.02);
}

}  // namespace candela::measure
