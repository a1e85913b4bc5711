#pragma once

#include <glm/mat4x4.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::io {

/// A box in the world, in double.
struct WorldBox {
    glm::dvec3 min{std::numeric_limits<double>::infinity()};
    glm::dvec3 max{-std::numeric_limits<double>::infinity()};
    [[nodiscard]] bool empty() const noexcept { return !(min.x <= max.x); }
    [[nodiscard]] glm::dvec3 center() const { return 0.5 * (min + max); }
    [[nodiscard]] double diagonal() const;
    void extend(const WorldBox& other);
};

/// Bounds of a box whose corners were transformed.
[[nodiscard]] WorldBox transformed(const scene::Aabb& bounds, const glm::dmat4& matrix);

/// The point about which a scene is kept in single precision: 0, 0, 0 unless its instances, or what its first
/// camera stands among, are so far from there that rounding would show. Then the middle of its bounds; of a
/// scene that is itself wide the camera, or else the middle of half of its instances. Rounded to a power of
/// two of about the scene's size, so that coordinates keep their digits.
[[nodiscard]] glm::dvec3 choose_origin(const std::vector<WorldBox>& instances,
                                       const std::optional<glm::dvec3>& camera);

/// How a mesh is brought to a middling size about its own origin, exactly undone by its instances: file =
/// middle + unit * stored. Vertices in a map's coordinates, or of 1e-8 m, lose their digits in cross products
/// otherwise.
struct MeshFrame {
    glm::dvec3 middle{0.0};
    double unit = 1.0;  ///< a power of two
    [[nodiscard]] bool identity() const { return middle == glm::dvec3(0.0) && unit == 1.0; }
    [[nodiscard]] glm::dmat4 matrix() const;
};
[[nodiscard]] MeshFrame choose_mesh_frame(const scene::Aabb& bounds);
void apply(const MeshFrame& frame, scene::Primitive& p);

}  // namespace candela::io
