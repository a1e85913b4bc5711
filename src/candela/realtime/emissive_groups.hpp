#pragma once

#include <optional>
#include <vector>

#include "candela/realtime/emissive_pieces.hpp"

namespace candela::realtime {

/// Emissive pieces that real time takes for one light, with their sums. Of two-sided pieces both sides count,
/// and their normals cancel.
struct EmissiveGroup {
    std::vector<EmissivePiece> pieces;
    float area_m2 = 0.0f;
    glm::vec3 vector_area_m2{0.0f};  ///< sum of area times normal
    glm::vec3 nit{0.0f};             ///< mean over the area
    glm::vec3 center{0.0f};          ///< mean over the area
    glm::vec3 half_extent_m{0.0f};

    explicit EmissiveGroup(std::vector<EmissivePiece> from);
    /// Area of what shines to the front of the whole, the rest shines all around.
    [[nodiscard]] float front_m2() const { return glm::length(vector_area_m2); }
};

/// About all corners in a flat group's plane.
struct BoundingRectangle {
    glm::vec3 center;
    glm::vec3 right;  ///< unit; up is cross(right, normal)
    float half_width_m = 0.0f;
    float half_height_m = 0.0f;
    [[nodiscard]] float area_m2() const { return 4.0f * half_width_m * half_height_m; }
};
/// The smallest one with a side along an edge of some piece; none for a group that is not flat.
[[nodiscard]] std::optional<BoundingRectangle> bounding_rectangle(const EmissiveGroup& group);

/// Puts the pieces of all parts into at most max_groups groups. A body with few flat sides is taken for its
/// sides. With few parts each is a group, cut in halves where it is long. Many parts are split from the top,
/// like a light tree (Conty Estevez & Kulla 2018): what has the largest flux times extent first, by the way
/// that its parts face where they face apart, else in space. So no group holds both sides of a street.
[[nodiscard]] std::vector<EmissiveGroup> group_emissive(std::vector<EmissivePart> parts,
                                                        std::size_t max_groups);

}  // namespace candela::realtime
