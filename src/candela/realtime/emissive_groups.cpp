#include "candela/realtime/emissive_groups.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "shading/language.glsl"

namespace candela::realtime {
namespace {

BoundingRectangle bounding_along(const EmissiveGroup& group, const glm::vec3& normal,
                                 const glm::vec3& right) {
    const glm::vec3 up = glm::cross(right, normal);
    glm::vec2 low(std::numeric_limits<float>::infinity());
    glm::vec2 high(-std::numeric_limits<float>::infinity());
    for (const EmissivePiece& piece : group.pieces) {
        for (const glm::vec3& corner : piece.corners) {
            const glm::vec2 at(glm::dot(corner - group.center, right), glm::dot(corner - group.center, up));
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
    }
    const glm::vec2 middle = 0.5f * (low + high);
    return {group.center + middle.x * right + middle.y * up, right, 0.5f * (high.x - low.x),
            0.5f * (high.y - low.y)};
}

/// Far longer than a sphere of its area, and no rectangle either.
bool is_long(const EmissiveGroup& g) {
    const float radius_m = std::sqrt(g.area_m2 / (4.0f * shading::PI));
    if (g.pieces.size() < 2 ||
        std::max(g.half_extent_m.x, std::max(g.half_extent_m.y, g.half_extent_m.z)) <= 2.5f * radius_m)
        return false;
    const std::optional<BoundingRectangle> flat = bounding_rectangle(g);
    return !flat || g.area_m2 < 0.95f * flat->area_m2();
}

int longest_axis(const glm::vec3& extent) {
    return extent.x >= std::max(extent.y, extent.z) ? 0 : extent.y >= extent.z ? 1 : 2;
}

std::pair<EmissiveGroup, EmissiveGroup> halves(EmissiveGroup group) {
    const int axis = longest_axis(group.half_extent_m);
    const auto middle = group.pieces.begin() + static_cast<std::ptrdiff_t>(group.pieces.size() / 2);
    std::nth_element(group.pieces.begin(), middle, group.pieces.end(),
                     [axis](const EmissivePiece& a, const EmissivePiece& b) {
                         return a.centroid()[axis] < b.centroid()[axis];
                     });
    std::vector<EmissivePiece> second(middle, group.pieces.end());
    group.pieces.erase(middle, group.pieces.end());
    return {EmissiveGroup(std::move(group.pieces)), EmissiveGroup(std::move(second))};
}

void halve_long_groups(std::vector<EmissiveGroup>& groups, std::size_t max_groups) {
    const auto length_of = [](const EmissiveGroup& g) {
        return is_long(g) ? glm::length(g.half_extent_m) : 0.0f;
    };
    while (groups.size() < max_groups) {
        const auto longest = std::max_element(
            groups.begin(), groups.end(),
            [&](const EmissiveGroup& a, const EmissiveGroup& b) { return length_of(a) < length_of(b); });
        if (!is_long(*longest)) return;
        auto [first, second] = halves(std::move(*longest));
        *longest = std::move(first);
        groups.push_back(std::move(second));
    }
}

/// What splitting needs to know of a part.
struct Summary {
    std::size_t part = 0;
    glm::vec3 center{0.0f};
    scene::Aabb box;
    glm::vec3 vector_area_m2{0.0f};
    float flux = 0.0f;  ///< area times luminance
};

struct Cluster {
    std::vector<Summary> members;
    float flux = 0.0f;
    glm::vec3 extent_m{0.0f};
    scene::Aabb centers;
    glm::vec3 facing{0.0f};      ///< normal of the member with the largest area that has one
    float apart = 0.0f;          ///< 0: all face one way; 1: they face against one another
    bool splits_facing = false;  ///< by the way they face, not in space
    float spread = 0.0f;         ///< the larger, the sooner it is split; 0: never

    Cluster(std::vector<Summary> from, float scene_extent_m) : members(std::move(from)) {
        scene::Aabb box;
        glm::vec3 sum(0.0f);
        float sum_of_lengths = 0.0f;
        float largest = 0.0f;
        for (const Summary& s : members) {
            flux += s.flux;
            box.extend(s.box);
            centers.extend(s.center);
            const float length = glm::length(s.vector_area_m2);
            sum += s.vector_area_m2;
            sum_of_lengths += length;
            if (length <= largest) continue;
            largest = length;
            facing = s.vector_area_m2 / length;
        }
        extent_m = box.max - box.min;
        if (sum_of_lengths > 0.0f) apart = 1.0f - glm::length(sum) / sum_of_lengths;
        splits_facing = apart > 0.01f && scene_extent_m * apart > 0.25f * glm::length(extent_m);
        if (members.size() > 1)
            spread =
                flux * (shading::square(glm::length(extent_m)) + shading::square(scene_extent_m * apart));
    }

    /// Members of the first half come first; their number, 0 or all when nothing tells them apart.
    std::size_t partition() {
        if (splits_facing) {
            const auto middle = std::partition(members.begin(), members.end(), [this](const Summary& s) {
                return glm::dot(s.vector_area_m2, facing) > 0.7f * glm::length(s.vector_area_m2);
            });
            return static_cast<std::size_t>(middle - members.begin());
        }
        const glm::vec3 between = centers.max - centers.min;
        const int axis = longest_axis(between);
        const float plane = 0.5f * (centers.min[axis] + centers.max[axis]);
        const auto middle = std::partition(members.begin(), members.end(),
                                           [=](const Summary& s) { return s.center[axis] < plane; });
        return static_cast<std::size_t>(middle - members.begin());
    }
};

Summary summary_of(const EmissivePart& part, std::size_t index) {
    const EmissiveGroup group(part.pieces);
    Summary s;
    s.part = index;
    s.center = group.center;
    for (const EmissivePiece& piece : part.pieces)
        for (const glm::vec3& corner : piece.corners) s.box.extend(corner);
    // A closed surface faces no way.
    if (group.front_m2() > 0.5f * group.area_m2) s.vector_area_m2 = group.vector_area_m2;
    s.flux = group.area_m2 * shading::luminance(group.nit);
    return s;
}

/// Pieces that face one way.
struct Face {
    glm::vec3 normal;
    std::vector<EmissivePiece> pieces;
    float flux = 0.0f;
};

/// The faces of a box or of another body with few flat sides; none of a rounded one.
std::vector<Face> flat_faces(const EmissivePart& part) {
    constexpr std::size_t most_faces = 6;
    std::vector<Face> faces;
    for (const EmissivePiece& piece : part.pieces) {
        if (piece.two_sided) return {};
        const glm::vec3 vector = piece.vector_area();
        const float area_m2 = glm::length(vector);
        if (!(area_m2 > 0.0f)) continue;
        const auto face = std::find_if(faces.begin(), faces.end(), [&](const Face& f) {
            return glm::dot(f.normal, vector) > 0.999f * area_m2;
        });
        if (face == faces.end() && faces.size() == most_faces) return {};
        Face& of = face != faces.end() ? *face : faces.emplace_back(Face{vector / area_m2, {}, 0.0f});
        of.pieces.push_back(piece);
        of.flux += area_m2 * shading::luminance(piece.nit);
    }
    return faces;
}

/// A lit window that is a box shines from its front, not from a sphere that would put a spot on the wall
/// about it. Sides too narrow to matter (an eighth of the widest one) give their light to the others.
std::vector<EmissivePart> split_into_faces(std::vector<EmissivePart> parts) {
    std::vector<EmissivePart> out;
    for (EmissivePart& part : parts) {
        std::vector<Face> faces = flat_faces(part);
        float all = 0.0f;
        float widest = 0.0f;
        for (const Face& f : faces) {
            all += f.flux;
            widest = std::max(widest, f.flux);
        }
        std::erase_if(faces, [=](const Face& f) { return f.flux < 0.125f * widest; });
        if (faces.empty()) out.push_back(std::move(part));
        float kept = 0.0f;
        for (const Face& f : faces) kept += f.flux;
        for (Face& f : faces) {
            for (EmissivePiece& piece : f.pieces) piece.nit *= all / kept;
            out.push_back({part.instance, part.material, std::move(f.pieces)});
        }
    }
    return out;
}

std::vector<EmissiveGroup> split_from_the_top(const std::vector<EmissivePart>& parts,
                                              std::size_t max_groups) {
    std::vector<Summary> all;
    scene::Aabb box;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        all.push_back(summary_of(parts[i], i));
        box.extend(all.back().box);
    }
    const float scene_extent_m = glm::length(box.max - box.min);
    std::vector<Cluster> clusters{Cluster(std::move(all), scene_extent_m)};
    while (clusters.size() < max_groups) {
        const auto widest =
            std::max_element(clusters.begin(), clusters.end(),
                             [](const Cluster& a, const Cluster& b) { return a.spread < b.spread; });
        if (!(widest->spread > 0.0f)) break;
        const std::size_t first = widest->partition();
        if (first == 0 || first == widest->members.size()) {
            widest->spread = 0.0f;
            continue;
        }
        const auto middle = widest->members.begin() + static_cast<std::ptrdiff_t>(first);
        Cluster second({middle, widest->members.end()}, scene_extent_m);
        *widest = Cluster({widest->members.begin(), middle}, scene_extent_m);
        clusters.push_back(std::move(second));
    }
    std::vector<EmissiveGroup> groups;
    for (const Cluster& cluster : clusters) {
        std::vector<EmissivePiece> pieces;
        for (const Summary& s : cluster.members)
            pieces.insert(pieces.end(), parts[s.part].pieces.begin(), parts[s.part].pieces.end());
        groups.emplace_back(std::move(pieces));
    }
    return groups;
}

}  // namespace

EmissiveGroup::EmissiveGroup(std::vector<EmissivePiece> from) : pieces(std::move(from)) {
    scene::Aabb bounds;
    for (const EmissivePiece& piece : pieces) {
        const glm::vec3 vector = piece.vector_area();
        const float area = glm::length(vector) * (piece.two_sided ? 2.0f : 1.0f);
        area_m2 += area;
        if (!piece.two_sided) vector_area_m2 += vector;
        nit += area * piece.nit;
        center += area * piece.centroid();
        for (const glm::vec3& corner : piece.corners) bounds.extend(corner);
    }
    nit /= area_m2;
    center /= area_m2;
    half_extent_m = 0.5f * (bounds.max - bounds.min);
}

std::optional<BoundingRectangle> bounding_rectangle(const EmissiveGroup& group) {
    constexpr std::size_t tried_pieces = 64;
    if (group.front_m2() < 0.95f * group.area_m2) return std::nullopt;
    const glm::vec3 normal = glm::normalize(group.vector_area_m2);
    float height_m = 0.0f;
    for (const EmissivePiece& piece : group.pieces)
        for (const glm::vec3& corner : piece.corners)
            height_m = std::max(height_m, std::abs(glm::dot(corner - group.center, normal)));
    if (height_m > 0.05f * glm::length(group.half_extent_m)) return std::nullopt;
    std::optional<BoundingRectangle> best;
    const std::size_t stride = (group.pieces.size() + tried_pieces - 1) / tried_pieces;
    for (std::size_t i = 0; i < group.pieces.size(); i += stride) {
        const EmissivePiece& piece = group.pieces[i];
        for (std::size_t c = 0; c < 3; ++c) {
            glm::vec3 edge = piece.corners[(c + 1) % 3] - piece.corners[c];
            edge -= normal * glm::dot(edge, normal);
            if (!(glm::length(edge) > 0.0f)) continue;
            const BoundingRectangle b = bounding_along(group, normal, glm::normalize(edge));
            if (!best || b.area_m2() < best->area_m2()) best = b;
        }
    }
    return best && best->area_m2() > 0.0f ? best : std::nullopt;
}

std::vector<EmissiveGroup> group_emissive(std::vector<EmissivePart> parts, std::size_t max_groups) {
    parts = split_into_faces(std::move(parts));
    if (parts.size() > max_groups) return split_from_the_top(parts, max_groups);
    std::vector<EmissiveGroup> groups;
    for (EmissivePart& part : parts) groups.emplace_back(std::move(part.pieces));
    halve_long_groups(groups, max_groups);
    return groups;
}

}  // namespace candela::realtime
