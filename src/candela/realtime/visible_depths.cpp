#include "candela/realtime/visible_depths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <limits>
#include <vector>

#include "candela/scene/camera.hpp"

namespace candela::realtime {
namespace {

/// Points with dot(plane, (p, 1)) >= 0 are within.
using Plane = glm::vec4;

/// A camera's frustum in its own space, where z is the depth along the view.
struct Frustum {
    std::array<Plane, 4> sides;
    float near_m = 0.0f;
    float far_m = std::numeric_limits<float>::infinity();
    bool perspective = true;
    glm::vec2 slope{0.0f};   ///< half the width and height at depth 1; perspective
    glm::vec2 half_m{0.0f};  ///< half the width and height; orthographic

    /// The edge through the corner with these signs, at a depth.
    [[nodiscard]] glm::vec3 edge(const glm::vec2& signs, float depth_m) const {
        return {signs * (perspective ? slope * depth_m : half_m), depth_m};
    }
};

Frustum frustum_of(const scene::Camera& any_camera, float aspect) {
    const scene::Camera camera = scene::fitted(any_camera, aspect);
    Frustum f;
    f.near_m = camera.znear_m;
    f.far_m = camera.zfar_m;
    f.perspective = camera.projection == scene::Projection::perspective;
    if (f.perspective) {
        f.slope.y = std::tan(0.5f * camera.yfov_rad);
        f.slope.x = f.slope.y * aspect;
        f.sides = {Plane{1, 0, f.slope.x, 0}, Plane{-1, 0, f.slope.x, 0}, Plane{0, 1, f.slope.y, 0},
                   Plane{0, -1, f.slope.y, 0}};
    } else {
        f.half_m = {camera.ymag_m * aspect, camera.ymag_m};
        f.sides = {Plane{1, 0, 0, f.half_m.x}, Plane{-1, 0, 0, f.half_m.x}, Plane{0, 1, 0, f.half_m.y},
                   Plane{0, -1, 0, f.half_m.y}};
    }
    return f;
}

using Polygon = std::vector<glm::vec3>;

/// Sutherland and Hodgman 1974.
void clip(Polygon& polygon, const Plane& plane, Polygon& scratch) {
    scratch.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::vec3& a = polygon[i];
        const glm::vec3& b = polygon[(i + 1) % polygon.size()];
        const float da = glm::dot(plane, glm::vec4(a, 1.0f));
        const float db = glm::dot(plane, glm::vec4(b, 1.0f));
        if (da >= 0.0f) scratch.push_back(a);
        if ((da >= 0.0f) != (db >= 0.0f)) scratch.push_back(a + da / (da - db) * (b - a));
    }
    polygon.swap(scratch);
}

class Depths {
  public:
    explicit Depths(const Frustum& frustum) : frustum_(frustum) {}

    void add(const glm::mat4& world_to_camera, const scene::Aabb& box) {
        std::array<glm::vec3, 8> corners;
        glm::vec2 range(std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity());
        for (unsigned i = 0; i < 8; ++i) {
            corners.at(i) =
                glm::vec3(world_to_camera * glm::vec4((i & 1u) != 0 ? box.max.x : box.min.x,
                                                      (i & 2u) != 0 ? box.max.y : box.min.y,
                                                      (i & 4u) != 0 ? box.max.z : box.min.z, 1.0f));
            range = {std::min(range.x, corners.at(i).z), std::max(range.y, corners.at(i).z)};
        }
        range = glm::clamp(range, glm::vec2(frustum_.near_m), glm::vec2(frustum_.far_m));
        // Most boxes of a large scene end here: what they could say is known, or they are out of view.
        if (!(range.x < range.y) || (range.x >= least_m && range.y <= most_m)) return;
        bool inside = range.x > frustum_.near_m && range.y < frustum_.far_m;
        for (const Plane& side : frustum_.sides) {
            const auto within = [&](const glm::vec3& p) {
                return glm::dot(side, glm::vec4(p, 1.0f)) >= 0.0f;
            };
            if (std::none_of(corners.begin(), corners.end(), within)) return;
            inside = inside && std::all_of(corners.begin(), corners.end(), within);
        }
        if (inside) {
            extend(range.x);
            extend(range.y);
            return;
        }
        add_faces(corners);
        add_edges(world_to_camera, box, range.y);
    }

    float least_m = std::numeric_limits<float>::infinity();
    float most_m = -std::numeric_limits<float>::infinity();

  private:
    void extend(float depth_m) {
        least_m = std::min(least_m, depth_m);
        most_m = std::max(most_m, depth_m);
    }

    /// What lies within the frustum of the box's faces.
    void add_faces(const std::array<glm::vec3, 8>& corners) {
        static constexpr std::array<std::array<std::uint8_t, 4>, 6> faces{
            {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};
        for (const auto& face : faces) {
            polygon_.clear();
            for (const std::uint8_t corner : face) polygon_.push_back(corners.at(corner));
            for (const Plane& side : frustum_.sides) clip(polygon_, side, scratch_);
            for (const glm::vec3& p : polygon_) {
                if (p.z < frustum_.near_m) continue;
                extend(std::min(p.z, frustum_.far_m));
            }
            // A face that passes through the near plane is seen from there on.
            const auto nearer = [&](const glm::vec3& p) { return p.z < frustum_.near_m; };
            const auto crossing = std::count_if(polygon_.begin(), polygon_.end(), nearer);
            if (crossing > 0 && crossing < static_cast<std::ptrdiff_t>(polygon_.size()))
                extend(frustum_.near_m);
        }
    }

    /// What lies within the box of the frustum's edges.
    void add_edges(const glm::mat4& world_to_camera, const scene::Aabb& box, float far_m) {
        const glm::mat4 camera_to_world = glm::inverse(world_to_camera);
        for (const glm::vec2& signs :
             {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(-1, 1), glm::vec2(1, 1)}) {
            const auto world = [&](float depth_m) {
                return glm::vec3(camera_to_world * glm::vec4(frustum_.edge(signs, depth_m), 1.0f));
            };
            const glm::vec3 begin = world(frustum_.near_m);
            const glm::vec3 way = world(far_m) - begin;
            glm::vec2 t(0.0f, 1.0f);
            for (int axis = 0; axis < 3; ++axis) {
                if (way[axis] == 0.0f) {
                    if (begin[axis] < box.min[axis] || begin[axis] > box.max[axis]) t = {1.0f, 0.0f};
                    continue;
                }
                const float a = (box.min[axis] - begin[axis]) / way[axis];
                const float b = (box.max[axis] - begin[axis]) / way[axis];
                t = {std::max(t.x, std::min(a, b)), std::min(t.y, std::max(a, b))};
            }
            if (t.x > t.y) continue;
            extend(frustum_.near_m + t.x * (far_m - frustum_.near_m));
            extend(frustum_.near_m + t.y * (far_m - frustum_.near_m));
        }
    }

    const Frustum& frustum_;
    Polygon polygon_;
    Polygon scratch_;
};

}  // namespace

glm::vec2 visible_depths_m(const scene::Camera& camera, float aspect, std::span<const scene::Aabb> boxes) {
    const Frustum frustum = frustum_of(camera, aspect);
    const glm::vec3 eye(camera.world[3]);
    const glm::mat3 axes(glm::normalize(glm::vec3(camera.world[0])),
                         glm::normalize(glm::vec3(camera.world[1])),
                         -glm::normalize(glm::vec3(camera.world[2])));
    glm::mat4 world_to_camera(glm::transpose(axes));
    world_to_camera[3] = glm::vec4(-glm::transpose(axes) * eye, 1.0f);
    Depths depths(frustum);
    for (const scene::Aabb& box : boxes)
        if (!box.empty()) depths.add(world_to_camera, box);
    if (!(depths.least_m <= depths.most_m)) return glm::vec2(frustum.near_m);
    return {depths.least_m, depths.most_m};
}

}  // namespace candela::realtime
