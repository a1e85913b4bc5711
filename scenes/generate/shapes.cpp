#include "shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

namespace candela::scenes {
namespace {

constexpr float tau = 2.0f * std::numbers::pi_v<float>;

/// Angle-free, area-weighted normals, shared by vertices that lie on exactly the same place (seams and
/// poles).
void smooth_normals(Shape& shape) {
    std::map<std::array<float, 3>, glm::vec3> sums;
    const auto key = [](const glm::vec3& p) {
        return std::array{p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};  // + 0: minus zero and zero are one place
    };
    for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
        const glm::vec3& a = shape.positions[shape.indices[i]];
        const glm::vec3& b = shape.positions[shape.indices[i + 1]];
        const glm::vec3& c = shape.positions[shape.indices[i + 2]];
        const glm::vec3 n = glm::cross(b - a, c - a);
        for (const glm::vec3& p : {a, b, c}) sums[key(p)] += n;
    }
    shape.normals.clear();
    for (const glm::vec3& p : shape.positions) {
        const glm::vec3& n = sums[key(p)];
        const float length = glm::length(n);
        shape.normals.push_back(length > 0.0f ? n / length : glm::vec3(0, 1, 0));
    }
}

bool has_area(const Shape& shape, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::vec3 n =
        glm::cross(shape.positions[b] - shape.positions[a], shape.positions[c] - shape.positions[a]);
    return glm::dot(n, n) > 0.0f;
}

/// Interpolates with tangents scaled by chord length (Catmull-Rom with chordal knots), so that short steps
/// between long ones do not overshoot. Every step takes the same share of the parameter: small features get
/// more rings.
class Curve {
  public:
    explicit Curve(const std::vector<glm::vec2>& points) : points_(points), knots_{0.0f} {
        for (std::size_t i = 1; i < points_.size(); ++i)
            knots_.push_back(knots_.back() + glm::length(points_[i] - points_[i - 1]));
    }

    [[nodiscard]] glm::vec2 at(float t) const {
        const float x = t * static_cast<float>(points_.size() - 1);
        const std::size_t i = std::min(static_cast<std::size_t>(x), points_.size() - 2);
        const float h = knots_[i + 1] - knots_[i];
        const float f = x - static_cast<float>(i), f2 = f * f, f3 = f2 * f;
        return (2.0f * f3 - 3.0f * f2 + 1.0f) * points_[i] + (f3 - 2.0f * f2 + f) * h * tangent(i) +
               (3.0f * f2 - 2.0f * f3) * points_[i + 1] + (f3 - f2) * h * tangent(i + 1);
    }

  private:
    [[nodiscard]] glm::vec2 tangent(std::size_t i) const {
        const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, points_.size() - 1);
        return (points_[after] - points_[before]) / (knots_[after] - knots_[before]);
    }

    const std::vector<glm::vec2>& points_;
    std::vector<float> knots_;
};

float signed_power(float x, float e) {
    return std::copysign(std::pow(std::abs(x), e), x);
}

}  // namespace

void Shape::append(const Shape& other) {
    const auto base = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), other.positions.begin(), other.positions.end());
    normals.insert(normals.end(), other.normals.begin(), other.normals.end());
    uv.insert(uv.end(), other.uv.begin(), other.uv.end());
    colors.insert(colors.end(), other.colors.begin(), other.colors.end());
    for (const std::uint32_t i : other.indices) indices.push_back(base + i);
}

void Shape::color_by(const std::function<glm::vec3(const glm::vec3&, const glm::vec2&)>& color) {
    colors.clear();
    for (std::size_t i = 0; i < positions.size(); ++i) colors.emplace_back(color(positions[i], uv[i]), 1.0f);
}

Shape surface_mesh(const Grid& grid, const Surface& surface) {
    Shape shape;
    for (std::uint32_t row = 0; row <= grid.rows; ++row) {
        const float v = static_cast<float>(row) / static_cast<float>(grid.rows);
        for (std::uint32_t column = 0; column <= grid.columns; ++column) {
            const float u = static_cast<float>(column) / static_cast<float>(grid.columns);
            shape.positions.push_back(surface(grid.closed_u && column == grid.columns ? 0.0f : u,
                                              grid.closed_v && row == grid.rows ? 0.0f : v));
            shape.uv.emplace_back(u, 1.0f - v);
        }
    }
    const std::uint32_t stride = grid.columns + 1;
    for (std::uint32_t row = 0; row < grid.rows; ++row) {
        for (std::uint32_t column = 0; column < grid.columns; ++column) {
            const std::uint32_t a = row * stride + column;
            const std::uint32_t b = a + 1, c = b + stride, d = a + stride;
            if (has_area(shape, a, b, c)) shape.indices.insert(shape.indices.end(), {a, b, c});
            if (has_area(shape, a, c, d)) shape.indices.insert(shape.indices.end(), {a, c, d});
        }
    }
    smooth_normals(shape);
    return shape;
}

Shape sphere(float radius_m, std::uint32_t segments, std::uint32_t rings) {
    Shape shape = superellipsoid(glm::vec3(radius_m), 1.0f, 1.0f, segments, rings);
    for (std::size_t i = 0; i < shape.positions.size(); ++i)
        shape.normals[i] = glm::normalize(shape.positions[i]);
    return shape;
}

Shape turned(const std::vector<glm::vec2>& profile_m, std::uint32_t segments, std::uint32_t rings) {
    const Curve profile(profile_m);
    const glm::vec2 first = profile_m.front(), last = profile_m.back();
    return surface_mesh({segments, rings, true, false}, [&](float u, float v) {
        // The ends are taken as given: a pole must be one place for its normals to be shared.
        const glm::vec2 p = v <= 0.0f ? first : v >= 1.0f ? last : profile.at(v);
        const float r = std::max(p.x, 0.0f);
        return glm::vec3(r * std::cos(tau * u), p.y, -r * std::sin(tau * u));
    });
}

Shape tube(const Grid& grid, const std::function<glm::vec3(float)>& path,
           const std::function<glm::vec3(float)>& reference, const std::function<float(float)>& radius_m) {
    return surface_mesh(grid, [&](float u, float v) {
        const float step = 1e-3f;
        const glm::vec3 along = glm::normalize(path(v + step) - path(v - step));
        const glm::vec3 out = reference(v);
        const glm::vec3 n = glm::normalize(out - along * glm::dot(out, along));
        return path(v) + radius_m(v) * (std::cos(tau * u) * n + std::sin(tau * u) * glm::cross(along, n));
    });
}

Shape torus_knot(int p, int q, float ring_m, float winding_m, float tube_m, std::uint32_t segments,
                 std::uint32_t sides) {
    const auto fp = static_cast<float>(p), fq = static_cast<float>(q);
    const auto outward = [=](float v) {
        const float turn = tau * fp * v, wind = tau * fq * v;
        return glm::vec3(std::cos(wind) * std::cos(turn), std::cos(wind) * std::sin(turn), std::sin(wind));
    };
    const auto path = [=](float v) {
        const float turn = tau * fp * v;
        return ring_m * glm::vec3(std::cos(turn), std::sin(turn), 0.0f) + winding_m * outward(v);
    };
    return tube({sides, segments, true, true}, path, outward, [=](float) { return tube_m; });
}

Shape superellipsoid(const glm::vec3& half_size_m, float e1, float e2, std::uint32_t segments,
                     std::uint32_t rings) {
    return surface_mesh({segments, rings, true, false}, [=](float u, float v) {
        // The poles are exactly on the axis, so that all their vertices are one place.
        const float up = v <= 0.0f ? -1.0f : v >= 1.0f ? 1.0f : -std::cos(0.5f * tau * v);
        const float across = v <= 0.0f || v >= 1.0f ? 0.0f : std::sin(0.5f * tau * v);
        const float r = signed_power(across, e1);
        return half_size_m * glm::vec3(r * signed_power(std::cos(tau * u), e2), signed_power(up, e1),
                                       -r * signed_power(std::sin(tau * u), e2));
    });
}

Shape box(const glm::vec3& size_m) {
    Shape shape;
    const glm::vec3 half = 0.5f * size_m;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 n(0.0f), right(0.0f);
            n[axis] = side;
            right[(axis + 1) % 3] = 1.0f;
            const glm::vec3 up = glm::cross(n, right);
            const auto base = static_cast<std::uint32_t>(shape.positions.size());
            for (const glm::vec2 corner :
                 {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
                shape.positions.push_back(half * (n + corner.x * right + corner.y * up));
                shape.normals.push_back(n);
                shape.uv.emplace_back(0.5f + 0.5f * corner.x, 0.5f - 0.5f * corner.y);
            }
            for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) shape.indices.push_back(base + i);
        }
    }
    return shape;
}

Shape ground(float width_m, float depth_m, float uv_repeat) {
    Shape shape = surface_mesh({1, 1, false, false}, [=](float u, float v) {
        return glm::vec3((u - 0.5f) * width_m, 0.0f, (0.5f - v) * depth_m);
    });
    for (glm::vec2& uv : shape.uv) uv *= uv_repeat;
    return shape;
}

Shape card(float width_m, float height_m) {
    return surface_mesh({1, 1, false, false}, [=](float u, float v) {
        return glm::vec3((u - 0.5f) * width_m, (v - 0.5f) * height_m, 0.0f);
    });
}

Shape paper_sweep(float width_m, float front_m, float back_m, float height_m, float curve_m) {
    const float floor_m = front_m - back_m - curve_m;
    const float arc_m = 0.25f * tau * curve_m;
    const float total_m = floor_m + arc_m + height_m - curve_m;
    return surface_mesh({1, 96, false, false}, [=](float u, float v) {
        const float s = v * total_m;
        const float x = (u - 0.5f) * width_m;
        if (s <= floor_m) return glm::vec3(x, 0.0f, front_m - s);
        if (s >= floor_m + arc_m) return glm::vec3(x, curve_m + s - floor_m - arc_m, back_m);
        const float a = (s - floor_m) / curve_m;
        return glm::vec3(x, curve_m * (1.0f - std::cos(a)), back_m + curve_m * (1.0f - std::sin(a)));
    });
}

}  // namespace candela::scenes
