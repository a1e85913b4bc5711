#include "candela/io/tangents.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <tuple>
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

/// What MikkTSpace knows of a triangle. One without area in uv is `flexible`: it adds nothing to a tangent
/// and takes the orientation of the first group that reaches it. One with two equal positions is `collapsed`:
/// it borrows.
struct Face {
    glm::vec3 tangent{0.0f};  // unit, of increasing u
    bool preserves_orientation = false;
    bool flexible = true;
    bool collapsed = false;
};

bool not_zero(float x) {
    return std::abs(x) > std::numeric_limits<float>::min();
}

Face face_of(const Primitive& p, const std::vector<glm::vec2>& uv, std::size_t triangle) {
    const std::uint32_t* i = &p.indices[3 * triangle];
    const glm::vec3 &x0 = p.positions[i[0]], &x1 = p.positions[i[1]], &x2 = p.positions[i[2]];
    const glm::vec3 e1 = x1 - x0, e2 = x2 - x0;
    const glm::vec2 d1 = uv[i[1]] - uv[i[0]];
    const glm::vec2 d2 = uv[i[2]] - uv[i[0]];
    const float area = d1.x * d2.y - d1.y * d2.x;
    Face face;
    face.collapsed = x0 == x1 || x1 == x2 || x2 == x0;
    face.preserves_orientation = area > 0.0f;
    if (!not_zero(area) || !std::isfinite(area)) return face;
    const float sign = face.preserves_orientation ? 1.0f : -1.0f;
    const glm::vec3 along_u = sign * (e1 * d2.y - e2 * d1.y);
    const glm::vec3 along_v = sign * (e2 * d1.x - e1 * d2.x);
    face.tangent = safe_normalize(along_u, glm::vec3(0.0f));
    face.flexible = !not_zero(glm::length(along_u)) || !not_zero(glm::length(along_v));
    return face;
}

constexpr std::size_t no_corner = static_cast<std::size_t>(-1);

std::size_t next_of(std::size_t corner) {
    return corner / 3 * 3 + (corner + 1) % 3;
}
std::size_t previous_of(std::size_t corner) {
    return corner / 3 * 3 + (corner + 2) % 3;
}

/// For every corner the corner in which the triangle across the edge to the next corner starts that edge;
/// each edge joins at most two triangles, wound oppositely, in the order of the file.
std::vector<std::size_t> opposite_corners(const std::vector<std::uint32_t>& welded,
                                          const std::vector<Face>& faces) {
    struct Edge {
        std::uint32_t low, high;
        std::size_t corner;
    };
    std::vector<Edge> edges;
    for (std::size_t c = 0; c < welded.size(); ++c) {
        if (faces[c / 3].collapsed) continue;
        const auto [low, high] = std::minmax(welded[c], welded[next_of(c)]);
        edges.push_back({low, high, c});
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
    });
    std::vector<std::size_t> opposite(welded.size(), no_corner);
    std::array<std::vector<std::size_t>, 2> waiting;  // for a partner, by direction
    for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
        std::array<std::size_t, 2> taken{};
        for (std::vector<std::size_t>& list : waiting) list.clear();
        for (;
             end < edges.size() && edges[end].low == edges[first].low && edges[end].high == edges[first].high;
             ++end) {
            const std::size_t c = edges[end].corner;
            const std::size_t direction = welded[c] == edges[first].low ? 0 : 1;
            const std::size_t other = 1 - direction;
            if (taken[other] == waiting[other].size()) {
                waiting[direction].push_back(c);
                continue;
            }
            const std::size_t partner = waiting[other][taken[other]++];
            opposite[c] = partner;
            opposite[partner] = c;
        }
    }
    return opposite;
}

struct Grouping {
    std::vector<std::size_t> group;  // by corner; no_corner for collapsed and unreached flexible triangles
    std::vector<bool> preserves_orientation;  // by group
};

/// Groups grow around a welded vertex, across edges, over triangles of the same orientation in uv (as
/// MikkTSpace groups): first the side that starts in the corner, then the one that ends there.
Grouping group_corners(const std::vector<std::uint32_t>& welded, std::vector<Face>& faces) {
    const std::vector<std::size_t> opposite = opposite_corners(welded, faces);
    Grouping out;
    out.group.assign(welded.size(), no_corner);
    const auto grow = [&](std::size_t start) {
        const std::size_t group = out.preserves_orientation.size();
        const bool orientation = faces[start / 3].preserves_orientation;
        out.preserves_orientation.push_back(orientation);
        std::vector<std::size_t> stack{start};
        while (!stack.empty()) {
            const std::size_t c = stack.back();
            stack.pop_back();
            if (out.group[c] != no_corner) continue;
            Face& face = faces[c / 3];
            const std::size_t base = c / 3 * 3;
            const bool untouched = out.group[base] == no_corner && out.group[base + 1] == no_corner &&
                                   out.group[base + 2] == no_corner;
            if (face.flexible && untouched) face.preserves_orientation = orientation;
            if (face.preserves_orientation != orientation) continue;
            out.group[c] = group;
            const std::size_t before = opposite[previous_of(c)];
            if (before != no_corner) stack.push_back(before);
            const std::size_t after = opposite[c];
            if (after != no_corner) stack.push_back(next_of(after));
        }
    };
    for (std::size_t c = 0; c < welded.size(); ++c) {
        const Face& face = faces[c / 3];
        if (!face.collapsed && !face.flexible && out.group[c] == no_corner) grow(c);
    }
    // A collapsed triangle takes what the first sound triangle has at the same welded vertex.
    std::vector<std::size_t> sound(welded.size(), no_corner);
    for (std::size_t c = welded.size(); c-- > 0;) {
        if (out.group[c] != no_corner) sound[welded[c]] = out.group[c];
    }
    for (std::size_t c = 0; c < welded.size(); ++c) {
        if (faces[c / 3].collapsed) out.group[c] = sound[welded[c]];
    }
    return out;
}

float corner_angle(const Primitive& p, std::size_t corner, const glm::vec3& n) {
    const std::size_t base = corner / 3 * 3;
    const glm::vec3& at = p.positions[p.indices[corner]];
    const auto edge = [&](std::size_t offset) {
        const glm::vec3 e = p.positions[p.indices[base + (corner - base + offset) % 3]] - at;
        return safe_normalize(e - n * glm::dot(n, e), glm::vec3(0.0f));
    };
    return std::acos(std::clamp(glm::dot(edge(1), edge(2)), -1.0f, 1.0f));
}

/// For every corner a number that is the same where position, normal and uv are equal as numbers (-0 is 0).
std::vector<std::uint32_t> weld(const Primitive& p, const std::vector<glm::vec2>& uv) {
    std::unordered_map<WeldKey, std::uint32_t, WeldHash> welds;
    std::vector<std::uint32_t> welded;
    for (const std::uint32_t v : p.indices) {
        const glm::vec3& x = p.positions[v];
        const glm::vec3& n = p.normals[v];
        WeldKey key{{x.x, x.y, x.z, n.x, n.y, n.z, uv[v].x, uv[v].y}};
        for (float& value : key.values) value += 0.0f;
        welded.push_back(welds.try_emplace(key, static_cast<std::uint32_t>(welds.size())).first->second);
    }
    return welded;
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
    const Grouping grouping = group_corners(weld(p, uv), faces);

    std::vector<glm::vec3> sums(grouping.preserves_orientation.size(), glm::vec3(0.0f));
    for (std::size_t c = 0; c < corners; ++c) {
        const Face& face = faces[c / 3];
        if (face.flexible || face.collapsed) continue;
        const glm::vec3& n = p.normals[p.indices[c]];
        const glm::vec3 t = safe_normalize(face.tangent - n * glm::dot(n, face.tangent), glm::vec3(0.0f));
        sums[grouping.group[c]] += t * corner_angle(p, c, n);
    }

    Primitive out;
    out.material = p.material;
    out.bounds = p.bounds;
    std::map<std::pair<std::uint32_t, std::size_t>, std::uint32_t> vertices;
    for (std::size_t c = 0; c < corners; ++c) {
        const std::size_t group = grouping.group[c];
        const auto [entry, fresh] =
            vertices.try_emplace({p.indices[c], group}, static_cast<std::uint32_t>(out.positions.size()));
        if (fresh) {
            append_vertex(out, p, p.indices[c]);
            const glm::vec3& n = p.normals[p.indices[c]];
            const glm::vec3 sum = group == no_corner ? glm::vec3(0.0f) : sums[group];
            const glm::vec3 t = safe_normalize(sum - n * glm::dot(n, sum), any_perpendicular(n));
            // glTF's v runs down the picture while the green of a normal map points up: the sign is
            // MikkTSpace's turned over.
            const bool preserves = group != no_corner && grouping.preserves_orientation[group];
            out.tangents.emplace_back(t, preserves ? -1.0f : 1.0f);
        }
        out.indices.push_back(entry->second);
    }
    p = std::move(out);
}

}  // namespace candela::io
