#include "candela/truth/camera_rays.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "candela/scene/camera.hpp"
#include "shading/language.glsl"

namespace candela::truth {
namespace {

/// Uniform on the unit disk without tearing neighbours apart: Shirley & Chiu 1997.
glm::vec2 concentric_disk(const glm::vec2& u) {
    const glm::vec2 p = 2.0f * u - 1.0f;
    if (p.x == 0.0f && p.y == 0.0f) return p;
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const float radius = wide ? p.x : p.y;
    const float angle =
        wide ? 0.25f * shading::PI * (p.y / p.x) : 0.5f * shading::PI - 0.25f * shading::PI * (p.x / p.y);
    return radius * glm::vec2(std::cos(angle), std::sin(angle));
}

}  // namespace

float lens_radius_m(float yfov_rad, float aperture_f) {
    const float focal_m = 0.5f * 0.024f / std::tan(0.5f * yfov_rad);
    return 0.5f * focal_m / aperture_f;
}

CameraRays::CameraRays(const scene::Camera& camera, std::uint32_t width, std::uint32_t height,
                       const Lens& lens)
    : camera_(scene::fitted(camera, static_cast<float>(width) / static_cast<float>(height))), lens_(lens) {
    const float half = camera_.projection == scene::Projection::perspective
                           ? std::tan(0.5f * camera_.yfov_rad)
                           : camera_.ymag_m;
    half_size_ = {half * static_cast<float>(width) / static_cast<float>(height), half};
    pixel_scale_ = 2.0f / glm::vec2(static_cast<float>(width), static_cast<float>(height));
}

Ray CameraRays::through(const glm::vec2& pixel, const glm::vec2& lens_u) const {
    const glm::vec2 at = (pixel * pixel_scale_ - 1.0f) * half_size_ * glm::vec2(1.0f, -1.0f);
    const glm::mat3 turn(camera_.world);
    Ray ray;
    ray.origin = glm::vec3(camera_.world[3]);
    if (camera_.projection == scene::Projection::orthographic) {
        ray.origin += turn * glm::vec3(at, 0.0f);
        ray.direction = glm::normalize(-turn[2]);
        return clipped(ray);
    }
    glm::vec3 direction(at, -1.0f);
    if (lens_.radius_m > 0.0f) {
        const glm::vec3 on_lens(concentric_disk(lens_u) * lens_.radius_m, 0.0f);
        direction = direction * lens_.focus_m - on_lens;
        ray.origin += turn * on_lens;
    }
    ray.direction = glm::normalize(turn * direction);
    return clipped(ray);
}

Ray CameraRays::clipped(Ray ray) const {
    const float cosine = -glm::dot(ray.direction, glm::normalize(glm::vec3(camera_.world[2])));
    ray.origin += ray.direction * (camera_.znear_m / cosine);
    ray.t_max = (camera_.zfar_m - camera_.znear_m) / cosine;
    return ray;
}

float CameraRays::depth_m(const Ray& ray, float distance_m) const {
    if (!std::isfinite(distance_m)) return distance_m;
    const glm::vec3 backward = glm::normalize(glm::vec3(camera_.world[2]));
    return glm::dot(glm::vec3(camera_.world[3]) - (ray.origin + ray.direction * distance_m), backward);
}

}  // namespace candela::truth
