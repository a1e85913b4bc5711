#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <vector>

#include "candela/scene/scene.hpp"

namespace candela::realtime {

/// An emissive triangle in world space, counter-clockwise seen from its front.
struct EmissivePiece {
    std::array<glm::vec3, 3> corners;
    glm::vec3 nit;  ///< a texture is its mean over the triangle
    bool two_sided = false;

    [[nodiscard]] glm::vec3 vector_area() const {
        return 0.5f * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    }
    [[nodiscard]] glm::vec3 centroid() const { return (corners[0] + corners[1] + corners[2]) / 3.0f; }
};

/// The emissive triangles of one primitive of one instance; triangles whose texture is black are left out.
struct EmissivePart {
    std::uint32_t instance = 0;
    std::uint32_t material = 0;
    std::vector<EmissivePiece> pieces;
};

/// Of every instance, unlit materials apart; parts without pieces are left out.
[[nodiscard]] std::vector<EmissivePart> emissive_parts(const scene::Scene& scene);

}  // namespace candela::realtime
