#pragma once

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "shading/color_temperature.glsl"

/// The colour spaces of FLIP (Andersson et al. 2020, section 4.1). White is Rec.709's (1,1,1).
namespace candela::measure::detail {

/// Linear Rec.709 to XYZ divided by white's: the inverse of shading's matrix, so that the numbers exist once.
inline glm::mat3 white_relative_xyz_from_rec709() {
    const glm::mat3 rec709_from_xyz(shading::rec709_from_xyz({1, 0, 0}), shading::rec709_from_xyz({0, 1, 0}),
                                    shading::rec709_from_xyz({0, 0, 1}));
    glm::mat3 m = glm::inverse(rec709_from_xyz);
    const glm::vec3 white = m * glm::vec3(1.0f);
    for (int c = 0; c < 3; ++c) m[c] = m[c] / white;
    return m;
}

/// YCxCz, the opponent space that is linear in light (section 4.1.1), from XYZ relative to white.
inline glm::vec3 ycxcz_from_xyz(const glm::vec3& xyz) {
    return {116.0f * xyz.y - 16.0f, 500.0f * (xyz.x - xyz.y), 200.0f * (xyz.y - xyz.z)};
}
inline glm::vec3 xyz_from_ycxcz(const glm::vec3& v) {
    const float y = (v.x + 16.0f) / 116.0f;
    return {y + v.y / 500.0f, y, y - v.z / 200.0f};
}

/// CIE 1976 L*a*b* (CIE 15, section 8.2.1) with the Hunt effect: chroma counts less where it is dark, a and b
/// are multiplied by L/100 (section 4.1.2).
inline glm::vec3 hunt_lab_from_xyz(const glm::vec3& xyz) {
    constexpr float delta = 6.0f / 29.0f;
    const auto f = [](float t) {
        return t > delta * delta * delta ? std::cbrt(t) : t / (3.0f * delta * delta) + 4.0f / 29.0f;
    };
    const float fx = f(xyz.x), fy = f(xyz.y), fz = f(xyz.z);
    const float lightness = 116.0f * fy - 16.0f;
    return {lightness, 0.01f * lightness * 500.0f * (fx - fy), 0.01f * lightness * 200.0f * (fy - fz)};
}

/// HyAB, the distance for large colour differences (Abasi, Tehran & Fairchild 2020): city block in lightness,
/// Euclidean in chroma.
inline float hyab(const glm::vec3& a, const glm::vec3& b) {
    const glm::vec3 d = a - b;
    return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

}  // namespace candela::measure::detail
