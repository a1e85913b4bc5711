#pragma once

#include <glm/vec3.hpp>

/// Illuminance per luminance of area lights by quadrature in double precision: the truth that the formulas of
/// shading/lights/ are held against. None of them integrates along the outline, as the formulas do: the
/// lights are cut into strips whose own integral is elementary, and the sum over the strips is
/// Gauss-Legendre's. Arguments as in shading/lights/: positions relative to the receiver in m, n its normal;
/// the result is in sr and counts what is above the horizon of n. panels: 8 points each, in every smooth
/// part.
namespace candela::measure {

struct RectangleLight {
    glm::dvec3 center;
    glm::dvec3 right;
    glm::dvec3 up;
    double half_width = 0.0;
    double half_height = 0.0;
};

struct DiskLight {
    glm::dvec3 center;
    glm::dvec3 direction;
    double radius = 0.0;
};

struct SphereLight {
    glm::dvec3 center;
    double radius = 0.0;
};

struct TubeLight {
    glm::dvec3 center;
    glm::dvec3 axis;
    double half_length = 0.0;
    double radius = 0.0;
};

/// The receiver is outside of the light.
[[nodiscard]] double illuminance_truth(const glm::dvec3& n, const SphereLight& light, int panels = 8);
[[nodiscard]] double illuminance_truth(const glm::dvec3& n, const DiskLight& light, int panels = 8);
[[nodiscard]] double illuminance_truth(const glm::dvec3& n, const RectangleLight& light, int panels = 8);
[[nodiscard]] double illuminance_truth(const glm::dvec3& n, const TubeLight& light, int panels = 48);

/// lx per cd of a line light (shading/lights/line.glsl): a sum over its points.
[[nodiscard]] double line_illuminance_truth(const glm::dvec3& n, const glm::dvec3& center,
                                            const glm::dvec3& axis, double half_length, int panels = 64);

}  // namespace candela::measure
