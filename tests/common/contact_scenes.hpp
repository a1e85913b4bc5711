#pragma once

#include <glm/gtc/matrix_transform.hpp>

#include "common/scenes.hpp"

/// Scenes in which something touches something: where shadows leak, peel off and show their resolution.
namespace candela::test {

/// An axis-aligned box about the origin, facing outwards.
inline scene::Primitive box(const glm::vec3& half_m, std::uint32_t material = 0) {
    scene::Primitive p;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            const auto first = static_cast<std::uint32_t>(p.positions.size());
            glm::vec3 n(0.0f);
            n[axis] = side;
            const glm::vec3 u{n.y, n.z, n.x};
            const glm::vec3 v = glm::cross(n, u);
            for (const auto& [x, y] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
                p.positions.push_back(half_m * (n + x * u + y * v));
                p.normals.push_back(n);
                p.uv[0].emplace_back(0.5f + 0.5f * x, 0.5f + 0.5f * y);
                p.bounds.extend(p.positions.back());
            }
            for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(first + i);
        }
    }
    p.material = material;
    return p;
}

/// Adds a mesh of its own at a place.
inline void place(scene::Scene& s, scene::Primitive primitive, const glm::mat4& world) {
    s.instances.push_back({"placed", static_cast<std::uint32_t>(s.meshes.size()), world});
    s.meshes.push_back({"mesh", {std::move(primitive)}});
}

inline glm::mat4 at(const glm::vec3& position_m) {
    return glm::translate(glm::mat4(1.0f), position_m);
}

/// A grey ground of 2 * half_m at y = 0.
inline scene::Scene ground(float half_m) {
    scene::Scene s;
    s.materials.push_back(grey(0.5f));
    place(s, square(half_m), glm::rotate(glm::mat4(1.0f), -1.57079633f, {1.0f, 0.0f, 0.0f}));
    return s;
}

/// A light at `position` that looks at `target`.
inline scene::Light light_at(scene::LightType type, const glm::vec3& position, const glm::vec3& target,
                             float intensity) {
    scene::Light light;
    light.type = type;
    light.position = position;
    light.direction = glm::normalize(target - position);
    const glm::vec3 side = glm::abs(light.direction.y) > 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    light.right = glm::normalize(glm::cross(light.direction, side));
    light.intensity = intensity;
    return light;
}

}  // namespace candela::test
