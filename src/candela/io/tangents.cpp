#include "candela/io/tangents.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <unordered_map>

namespace candela::io {
namespace {

using scene::Primitive;

/// Appends a copy of vertex `i` of `from` to `to`, attribute by attribute.
void append_vertex(Primitive& to, const Primitive& from, std::size_t i) {
    const auto copy = [i](auto& target, const auto& source) {
        if (!source.empty()) target.push_back(source[i]);
    };
    copy(to.positions, from.positions);
    copy(to.normals, from.normals);
    copy(to.tangents, from.tangents);
    for (std::size_t set = 0; set < to.uv.size(); ++set) copy(to.uv[set], from.uv[set]);
    copy(to.colors, from.colors);
}

glm::vec3 safe_normalize(const glm::vec3& v, const glm::vec3& fallback) {
    const float length = glm::length(v);
    return length > 1e-20f && std::isfinite(length) ? v / length : fallback;
}

glm::vec3 any_perpendicular(const glm::vec3& n) {
    const glm::vec3 axis = std::abs(n.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(axis - n * glm::dot(n, axis));
}

/// Bitwise key of what MikkTSpace welds: position, normal, uv.
struct WeldKey {
    std::array<float, 8> values;
    bool operator==(const WeldKey& o) const {
        return std::memcmp(values.data(), o.values.data(), sizeof(values)) == 0;
    }
};
struct WeldHash {
    std::size_t operator()(const WeldKey& key) const {
        std::uint64_t hash = 1469598103934665603ull;
        for (const float v : key.values) {
            std::uint32_t word = 0;
            std::memcpy(&word, &v, sizeof(word));
            hash = (hash ^ word) * 1099511628211ull;
        }
        return static_cast<std::size_t>(hash);
    }
};

struct Face {
    glm::vec3 tangent{0.0f};  // unit, of increasing u; zero when the uv triangle has no area
    bool preserves_orientation = true;
    bool degenerate = false;
};

Face face_of(const Primitive& p, const std::vector<glm::vec2>& uv, std::size_t triangle) {
    const std::uint32_t* i = &p.indices[3 * triangle];
    const glm::vec3 e1 = p.positions[i[1]] - p.positions[i[0]];
    const glm::vec3 e2 = p.positions[i[2]] - p.positions[i[0]];
    const glm::vec2 d1 = uv[i[1]] - uv[i[0]];
    const glm::vec2 d2 = uv[i[2]] - uv[i[0]];
    const float area = d1.x * d2.y - d1.y * d2.x;
    Face face;
    face.preserves_orientation = area > 0.0f;
    face.degenerate = area == 0.0f || !std::isfinite(area);
    const glm::vec3 t = (e1 * d2.y - e2 * d1.y) * (face.preserves_orientation ? 1.0f : -1.0f);
    face.tangent = safe_normalize(t, glm::vec3(0.0f));
    if (face.tangent == glm::vec3(0.0f)) face.degenerate = true;
    return face;
}

/// Disjoint sets of corners.
class Groups {
  public:
    explicit Groups(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t find(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::size_t a, std::size_t b) {
        parent_[std::max(find(a), find(b))] = std::min(find(a), find(b));
    }

  private:
    std::vector<std::size_t> parent_;
};

float corner_angle(const Primitive& p, std::size_t corner, const glm::vec3& n) {
    const std::size_t base = corner / 3 * 3;
    const glm::vec3& at = p.positions[p.indices[corner]];
    const auto edge = [&](std::size_t offset) {
        const glm::vec3 e = p.positions[p.indices[base + (corner - base + offset) % 3]] - at;
        return safe_normalize(e - n * glm::dot(n, e), glm::vec3(0.0f));
    };
    return std::acos(std::clamp(glm::dot(edge(1), edge(2)), -1.0f, 1.0f));
}

}  // namespace

void add_flat_normals(Primitive& p) {
    Primitive out;
    out.material = p.material;
    p.normals.clear();
    p.tangents.clear();
    for (std::size_t t = 0; t + 2 < p.indices.size(); t += 3) {
        const glm::vec3& a = p.positions[p.indices[t]];
        const glm::vec3& b = p.positions[p.indices[t + 1]];
        const glm::vec3& c = p.positions[p.indices[t + 2]];
        const glm::vec3 n = safe_normalize(glm::cross(b - a, c - a), glm::vec3(0, 0, 1));
        for (std::size_t corner = 0; corner < 3; ++corner) {
            append_vertex(out, p, p.indices[t + corner]);
            out.normals.push_back(n);
            out.indices.push_back(static_cast<std::uint32_t>(out.indices.size()));
        }
    }
    out.bounds = p.bounds;
    p = std::move(out);
}

void add_tangents(Primitive& p, std::size_t uv_set) {
    const std::vector<glm::vec2>& uv = p.uv.at(uv_set);
    const std::size_t corners = p.indices.size();
    std::vector<Face> faces;
    for (std::size_t t = 0; t < corners / 3; ++t) faces.push_back(face_of(p, uv, t));

    std::unordered_map<WeldKey, std::uint32_t, WeldHash> welds;
    std::vector<std::uint32_t> welded(corners);
    for (std::size_t c = 0; c < corners; ++c) {
        const std::uint32_t v = p.indices[c];
        const glm::vec3& x = p.positions[v];
        const glm::vec3& n = p.normals[v];
        const WeldKey key{{x.x, x.y, x.z, n.x, n.y, n.z, uv[v].x, uv[v].y}};
        welded[c] = welds.try_emplace(key, static_cast<std::uint32_t>(welds.size())).first->second;
    }

    // Corners join across an edge when both of its ends are welded and the faces have the same orientation in
    // uv.
    Groups groups(corners);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> edges;
    for (std::size_t c = 0; c < corners; ++c) {
        const std::size_t next = c / 3 * 3 + (c + 1) % 3;
        const std::pair edge{welded[c], welded[next]};
        edges.try_emplace(edge, c);
        const auto opposite = edges.find({edge.second, edge.first});
        if (opposite == edges.end()) continue;
        const Face& mine = faces[c / 3];
        const std::size_t other = opposite->second;
        const Face& theirs = faces[other / 3];
        if (mine.degenerate || theirs.degenerate ||
            mine.preserves_orientation != theirs.preserves_orientation)
            continue;
        const std::size_t other_next = other / 3 * 3 + (other + 1) % 3;
        groups.join(c, other_next);
        groups.join(next, other);
    }

    std::vector<glm::vec3> sums(corners, glm::vec3(0.0f));
    std::vector<float> handedness(corners, 1.0f);
    for (std::size_t c = 0; c < corners; ++c) {
        const Face& face = faces[c / 3];
        const std::size_t group = groups.find(c);
        // glTF's v runs down the picture while the green of a normal map points up: the sign is MikkTSpace's
        // turned over.
        handedness[group] = face.preserves_orientation ? -1.0f : 1.0f;
        if (face.degenerate) continue;
        const glm::vec3& n = p.normals[p.indices[c]];
        const glm::vec3 t = safe_normalize(face.tangent - n * glm::dot(n, face.tangent), glm::vec3(0.0f));
        sums[group] += t * corner_angle(p, c, n);
    }

    Primitive out;
    out.material = p.material;
    out.bounds = p.bounds;
    std::map<std::pair<std::uint32_t, std::size_t>, std::uint32_t> vertices;
    for (std::size_t c = 0; c < corners; ++c) {
        const std::size_t group = groups.find(c);
        const auto [entry, fresh] =
            vertices.try_emplace({p.indices[c], group}, static_cast<std::uint32_t>(out.positions.size()));
        if (fresh) {
            append_vertex(out, p, p.indices[c]);
            const glm::vec3& n = p.normals[p.indices[c]];
            const glm::vec3 t =
                safe_normalize(sums[group] - n * glm::dot(n, sums[group]), any_perpendicular(n));
            out.tangents.emplace_back(t, handedness[group]);
        }
        out.indices.push_back(entry->second);
    }
    p = std::move(out);
}

}  // namespace candela::io
