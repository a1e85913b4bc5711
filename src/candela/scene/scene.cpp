#include "candela/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "candela/scene/camera.hpp"

namespace candela::scene {

void Aabb::extend(const glm::vec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
}

void Aabb::extend(const Aabb& other) {
    if (other.empty()) return;
    extend(other.min);
    extend(other.max);
}

Aabb transformed(const Aabb& bounds, const glm::mat4& matrix) {
    Aabb out;
    if (bounds.empty()) return out;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p{(corner & 1) ? bounds.max.x : bounds.min.x,
                          (corner & 2) ? bounds.max.y : bounds.min.y,
                          (corner & 4) ? bounds.max.z : bounds.min.z};
        out.extend(glm::vec3(matrix * glm::vec4(p, 1.0f)));
    }
    return out;
}

Aabb world_bounds(const Scene& scene) {
    Aabb bounds;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (const Primitive& primitive : mesh.primitives)
            bounds.extend(transformed(primitive.bounds, instance.world));
        for (const Stroke& stroke : mesh.strokes)
            bounds.extend(transformed(stroke.geometry.bounds, instance.world));
    }
    return bounds;
}

std::size_t triangle_count(const Scene& scene) {
    std::size_t count = 0;
    for (const Instance& instance : scene.instances) {
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            count += primitive.indices.size() / 3;
        }
    }
    return count;
}

float yfov_from_focal_mm(float focal_mm) {
    constexpr float sensor_height_mm = 24.0f;
    return 2.0f * std::atan(0.5f * sensor_height_mm / focal_mm);
}

glm::mat4 rigid_part(const glm::mat4& world) {
    const auto unit = [](const glm::vec3& v, const glm::vec3& fallback) {
        const float length = glm::length(v);
        return length > 1e-20f && std::isfinite(length) ? v / length : fallback;
    };
    const glm::vec3 z = unit(glm::vec3(world[2]), {0, 0, 1});
    const glm::vec3 y0 = glm::vec3(world[1]) - z * glm::dot(z, glm::vec3(world[1]));
    const glm::vec3 y = unit(y0, std::abs(z.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0));
    return {glm::vec4(glm::cross(y, z), 0.0f), glm::vec4(y, 0.0f), glm::vec4(z, 0.0f),
            glm::vec4(glm::vec3(world[3]), 1.0f)};
}

Camera look_at(const glm::vec3& from, const glm::vec3& at, float yfov_rad) {
    const glm::vec3 back = glm::normalize(from - at);
    const glm::vec3 up = std::abs(back.y) > 0.9999f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    const glm::vec3 right = glm::normalize(glm::cross(up, back));
    Camera camera;
    camera.name = "look-at";
    camera.yfov_rad = yfov_rad;
    // What is looked at closely must not be cut off.
    camera.znear_m = std::min(camera.znear_m, 0.01f * glm::length(from - at));
    camera.world = glm::mat4(glm::vec4(right, 0.0f), glm::vec4(glm::cross(back, right), 0.0f),
                             glm::vec4(back, 0.0f), glm::vec4(from, 1.0f));
    return camera;
}

Camera frame_bounds(const Aabb& bounds, float aspect) {
    const glm::vec3 center = bounds.empty() ? glm::vec3(0.0f) : 0.5f * (bounds.min + bounds.max);
    const float half_diagonal = bounds.empty() ? 1.0f : 0.5f * glm::length(bounds.max - bounds.min);
    const float radius = half_diagonal > 0.0f ? half_diagonal : 1e-4f;
    const float yfov = yfov_from_focal_mm(50.0f);
    const float half = 0.5f * std::min(yfov, 2.0f * std::atan(std::tan(0.5f * yfov) * aspect));
    const float distance = 1.05f * radius / std::sin(half);
    Camera camera = look_at(center + distance * glm::normalize(glm::vec3(0.45f, 0.3f, 1.0f)), center, yfov);
    camera.name = "framed";
    camera.znear_m = std::max(distance - 2.0f * radius, 1e-3f * radius);
    return camera;
}

glm::mat4 view_projection(const Camera& any_camera, float aspect) {
    const Camera camera = fitted(any_camera, aspect);
    glm::mat4 clip(0.0f);
    const float near = camera.znear_m;
    if (camera.projection == Projection::perspective) {
        const float f = 1.0f / std::tan(0.5f * camera.yfov_rad);
        clip[0][0] = f / aspect;
        clip[1][1] = -f;
        clip[2][3] = -1.0f;
        const float far = camera.zfar_m;
        clip[2][2] = std::isinf(far) ? 0.0f : near / (far - near);
        clip[3][2] = std::isinf(far) ? near : near * far / (far - near);
    } else {
        const float far = std::isinf(camera.zfar_m) ? near + 1e5f : camera.zfar_m;
        clip[0][0] = 1.0f / (camera.ymag_m * aspect);
        clip[1][1] = -1.0f / camera.ymag_m;
        clip[2][2] = 1.0f / (far - near);
        clip[3][2] = far / (far - near);
        clip[3][3] = 1.0f;
    }
    return clip * glm::inverse(camera.world);
}

}  // namespace candela::scene
