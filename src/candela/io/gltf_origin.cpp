#include "candela/io/gltf_origin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace candela::io {
namespace {

/// A scene farther than so many of its diagonals is moved: rays leave surfaces by 256 units in the last place
/// (shading/ray_origin.glsl), here 5e-4 of the diagonal.
constexpr double kFarDiagonals = 16.0;
/// Where single precision has steps of a quarter of a millimetre, whatever the size of the scene.
constexpr double kFar_m = 4096.0;
/// Diagonals of meshes that are stored as they are.
constexpr double kSmallestMesh = 1e-3;
constexpr double kLargestMesh = 1e6;

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

double power_of_two_below(double x) {
    return std::exp2(std::floor(std::log2(x)));
}

glm::dvec3 rounded(const glm::dvec3& point, double size) {
    const double distance = glm::length(point);
    // A double holds 53 digits: the steps must not be finer than what it can tell apart there.
    const double step = power_of_two_below(std::max({size, distance * 1e-12, 1e-290}));
    return glm::round(point / step) * step;
}

/// Of the boxes' middles, coordinate by coordinate: a stray object far away does not move it.
glm::dvec3 median_of(const std::vector<WorldBox>& boxes) {
    glm::dvec3 out(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> values;
        values.reserve(boxes.size());
        for (const WorldBox& box : boxes) {
            if (!box.empty()) values.push_back(box.center()[axis]);
        }
        if (values.empty()) continue;
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        out[axis] = *middle;
    }
    return out;
}

}  // namespace

double WorldBox::diagonal() const {
    return empty() ? 0.0 : glm::length(max - min);
}

void WorldBox::extend(const WorldBox& other) {
    if (other.empty()) return;
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
}

WorldBox transformed(const scene::Aabb& bounds, const glm::dmat4& matrix) {
    WorldBox out;
    if (bounds.empty()) return out;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p((corner & 1) ? bounds.max.x : bounds.min.x,
                           (corner & 2) ? bounds.max.y : bounds.min.y,
                           (corner & 4) ? bounds.max.z : bounds.min.z);
        const glm::dvec3 at(matrix * glm::dvec4(p, 1.0));
        if (finite(at)) out.extend({at, at});
    }
    return out;
}

glm::dvec3 choose_origin(const std::vector<WorldBox>& instances, const std::optional<glm::dvec3>& camera) {
    WorldBox all;
    for (const WorldBox& box : instances) all.extend(box);
    if (all.empty()) return glm::dvec3(0.0);
    const double size = all.diagonal();
    const glm::dvec3 center = all.center();
    if (!finite(center) || !std::isfinite(size)) return glm::dvec3(0.0);
    if (glm::length(center) > kFarDiagonals * size) return rounded(center, size);
    const glm::dvec3 among = camera && finite(*camera) ? *camera : median_of(instances);
    return glm::length(among) > kFar_m ? rounded(among, 1.0) : glm::dvec3(0.0);
}

glm::dmat4 MeshFrame::matrix() const {
    return glm::scale(glm::translate(glm::dmat4(1.0), middle), glm::dvec3(unit));
}

MeshFrame choose_mesh_frame(const scene::Aabb& bounds) {
    MeshFrame out;
    if (bounds.empty()) return out;
    const WorldBox box{glm::dvec3(bounds.min), glm::dvec3(bounds.max)};
    const double size = box.diagonal();
    const double distance = glm::length(box.center());
    if (!(size > 0.0) || !std::isfinite(size)) return out;
    if (distance > kFarDiagonals * size) out.middle = rounded(box.center(), size);
    if (size < kSmallestMesh || size > kLargestMesh) out.unit = power_of_two_below(size);
    return out;
}

void apply(const MeshFrame& frame, scene::Primitive& p) {
    if (frame.identity()) return;
    for (glm::vec3& x : p.positions) x = glm::vec3((glm::dvec3(x) - frame.middle) / frame.unit);
}

}  // namespace candela::io
