#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

/// What the tests know of directions by themselves, written from the specifications and not with shading/.
namespace candela::test {

using Sky = std::function<glm::vec3(const glm::vec3&)>;

/// A different color in every direction, never dark.
inline glm::vec3 colorful(const glm::vec3& d) {
    return {1.5f + d.x, 1.5f + d.y, 1.5f + d.z};
}

inline const std::vector<glm::vec3>& probes() {
    static const std::vector<glm::vec3> directions = [] {
        std::vector<glm::vec3> out;
        for (const glm::vec3& d :
             {glm::vec3(1, 0.1f, 0.05f), glm::vec3(-1, 0.1f, 0.05f), glm::vec3(0.1f, 1, 0.05f),
              glm::vec3(0.1f, -1, 0.05f), glm::vec3(0.1f, 0.05f, 1), glm::vec3(0.1f, 0.05f, -1),
              glm::vec3(1, 0.7f, 0.4f), glm::vec3(-1, 0.6f, -0.5f), glm::vec3(0.4f, 1, -0.6f),
              glm::vec3(0.5f, -1, 0.6f), glm::vec3(-0.3f, 0.6f, 1), glm::vec3(0.6f, -0.3f, -1)})
            out.push_back(glm::normalize(d));
        return out;
    }();
    return directions;
}

/// OpenGL 4.6, Table 8.19 (and Vulkan 1.3, "Cube Map Face Selection"): face, and s and t in [0,1].
struct FacePoint {
    std::uint32_t face;
    glm::vec2 st;
};
inline FacePoint gl_face(const glm::vec3& r) {
    const glm::vec3 a = glm::abs(r);
    struct Row {
        float sc, tc, ma;
    };
    std::uint32_t face = 0;
    Row row{};
    if (a.x >= a.y && a.x >= a.z) {
        face = r.x > 0 ? 0 : 1;
        row = {r.x > 0 ? -r.z : r.z, -r.y, a.x};
    } else if (a.y >= a.z) {
        face = r.y > 0 ? 2 : 3;
        row = {r.x, r.y > 0 ? r.z : -r.z, a.y};
    } else {
        face = r.z > 0 ? 4 : 5;
        row = {r.z > 0 ? r.x : -r.x, -r.y, a.z};
    }
    return {face, glm::vec2(0.5f * (row.sc / row.ma + 1.0f), 0.5f * (row.tc / row.ma + 1.0f))};
}

/// The direction of the middle of a texel: the one of the face's plane that gl_face maps there.
inline glm::vec3 gl_direction(std::uint32_t face, std::uint32_t x, std::uint32_t y, std::uint32_t size) {
    const float s = 2.0f * (float(x) + 0.5f) / float(size) - 1.0f,
                t = 2.0f * (float(y) + 0.5f) / float(size) - 1.0f;
    static const std::array<std::array<glm::vec3, 3>, 6> axes{{{{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}},
                                                               {{{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}}},
                                                               {{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}},
                                                               {{{0, -1, 0}, {1, 0, 0}, {0, 0, -1}}},
                                                               {{{0, 0, 1}, {1, 0, 0}, {0, -1, 0}}},
                                                               {{{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}}}};
    return glm::normalize(axes[face][0] + s * axes[face][1] + t * axes[face][2]);
}

/// Faces as the APIs want them, row by row; `sky` sees the API's own directions.
inline std::vector<glm::vec3> faces_of(const Sky& sky, std::uint32_t size) {
    std::vector<glm::vec3> out;
    for (std::uint32_t face = 0; face < 6; ++face) {
        for (std::uint32_t y = 0; y < size; ++y) {
            for (std::uint32_t x = 0; x < size; ++x) out.push_back(sky(gl_direction(face, x, y, size)));
        }
    }
    return out;
}

/// Exact: the area of a spherical triangle pair by Van Oosterom and Strackee, in double.
inline double solid_angle_of_cube_texel(std::uint32_t x, std::uint32_t y, std::uint32_t size) {
    const auto corner = [&](std::uint32_t u, std::uint32_t v) {
        return glm::dvec3(2.0 * u / size - 1.0, 2.0 * v / size - 1.0, 1.0);
    };
    const auto triangle = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        return 2.0 *
               std::atan2(std::abs(glm::dot(a, glm::cross(b, c))),
                          la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la);
    };
    return triangle(corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)) +
           triangle(corner(x, y), corner(x + 1, y + 1), corner(x, y + 1));
}

/// Sum of luminance times solid angle of an equirectangular picture, by the cosines of its rows.
template <class Environment>
glm::dvec3 light_of(const Environment& e) {
    glm::dvec3 sum(0.0);
    for (std::uint32_t y = 0; y < e.height; ++y) {
        const double row =
            std::cos(std::numbers::pi * y / e.height) - std::cos(std::numbers::pi * (y + 1.0) / e.height);
        for (std::uint32_t x = 0; x < e.width; ++x)
            sum += glm::dvec3(e.luminance_nit[std::size_t{y} * e.width + x]) *
                   (row * 2.0 * std::numbers::pi / e.width);
    }
    return sum * double{e.scale};
}

/// Texel of an equirectangular picture of Candela's whose middle looks down -Z with +X to the right.
template <class Environment>
glm::vec3 seen(const Environment& e, const glm::vec3& d) {
    const double u = 0.5 + std::atan2(double{d.x}, -double{d.z}) / (2.0 * std::numbers::pi);
    const double v = std::acos(double{d.y}) / std::numbers::pi;
    const auto x = std::min(static_cast<std::uint32_t>(u * e.width), e.width - 1);
    const auto y = std::min(static_cast<std::uint32_t>(v * e.height), e.height - 1);
    return e.luminance_nit[std::size_t{y} * e.width + x];
}

}  // namespace candela::test
