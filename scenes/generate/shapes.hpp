#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

/// The demo scenes of Candela, made from mathematics: no downloaded assets.
namespace candela::scenes {

/// Triangles in metres, counter-clockwise from outside; uv as glTF (v down).
struct Shape {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uv;
    std::vector<glm::vec4> colors;  ///< linear RGBA, empty or one a vertex
    std::vector<std::uint32_t> indices;

    [[nodiscard]] std::size_t triangles() const noexcept { return indices.size() / 3; }
    void append(const Shape& other);
    void color_by(const std::function<glm::vec3(const glm::vec3& position, const glm::vec2& uv)>& color);
};

/// Cells of a parametric surface. A closed direction meets itself without a crease; its uv still runs to 1.
struct Grid {
    std::uint32_t columns = 1;  ///< along u
    std::uint32_t rows = 1;     ///< along v
    bool closed_u = false;
    bool closed_v = false;
};

using Surface = std::function<glm::vec3(float u, float v)>;

/// Triangles of surface(u, v), u and v in [0,1], with smooth normals; outside is where d/du x d/dv points.
[[nodiscard]] Shape surface_mesh(const Grid& grid, const Surface& surface);

/// Latitude-longitude sphere with exact normals.
[[nodiscard]] Shape sphere(float radius_m, std::uint32_t segments, std::uint32_t rings);

/// Turns a profile of (radius, height), smoothly interpolated, about +Y. From the middle of the bottom up the
/// outside.
[[nodiscard]] Shape turned(const std::vector<glm::vec2>& profile_m, std::uint32_t segments,
                           std::uint32_t rings);

/// A tube of `radius_m(v)` along `path(v)`. `reference(v)` is any direction not along the path; it fixes the
/// twist.
[[nodiscard]] Shape tube(const Grid& grid, const std::function<glm::vec3(float)>& path,
                         const std::function<glm::vec3(float)>& reference,
                         const std::function<float(float)>& radius_m);

/// Winds p times along and q times round a ring of this radius that stands in the XY plane.
[[nodiscard]] Shape torus_knot(int p, int q, float ring_m, float winding_m, float tube_m,
                               std::uint32_t segments, std::uint32_t sides);

/// |x/a|^(2/e2) ... with e = 1 an ellipsoid, towards 0 a box (Barr 1981).
[[nodiscard]] Shape superellipsoid(const glm::vec3& half_size_m, float e1, float e2, std::uint32_t segments,
                                   std::uint32_t rings);

/// Box centred at the origin with flat faces; every face has the whole uv square.
[[nodiscard]] Shape box(const glm::vec3& size_m);

/// Rectangle in the XZ plane, facing +Y, centred at the origin; uv repeats `uv_repeat` times.
[[nodiscard]] Shape ground(float width_m, float depth_m, float uv_repeat = 1.0f);

/// Rectangle in the XY plane, facing +Z, centred at the origin.
[[nodiscard]] Shape card(float width_m, float height_m);

/// A photographer's paper sweep: floor, curve, wall. Front edge at z = front_m, wall at z = back_m.
[[nodiscard]] Shape paper_sweep(float width_m, float front_m, float back_m, float height_m, float curve_m);

}  // namespace candela::scenes
