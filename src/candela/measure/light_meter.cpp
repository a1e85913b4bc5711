#include "candela/measure/light_meter.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "candela/scene/camera.hpp"

namespace candela::measure {
namespace {

/// Nothing before a spot meter is too near for it.
constexpr float kSpotMeterNear_m = 1e-4f;

/// Large enough for single precision at the card's place, small enough to be no part of the scene.
float hair_m(const glm::vec3& at) {
    const float farthest = std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)});
    return std::max(2e-4f, 2e-5f * farthest);
}

scene::Material matt_white() {
    scene::Material m;
    m.name = "light meter";
    m.metallic = 0.0f;
    m.specular = 0.0f;  // f0 and f90: nothing but the matt reflection is left
    return m;
}

scene::Primitive card(const glm::vec3& center, const glm::mat3& frame, float half_m, std::uint32_t material) {
    scene::Primitive p;
    for (const auto& [x, y] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
        p.positions.push_back(center + half_m * (x * frame[0] + y * frame[1]));
        p.normals.push_back(frame[2]);
        p.bounds.extend(p.positions.back());
    }
    p.indices = {0, 1, 2, 0, 2, 3};
    p.material = material;
    return p;
}

}  // namespace

scene::Camera hold_card(scene::Scene& scene, const glm::vec3& at, const glm::vec3& normal) {
    const float hair = hair_m(at);
    const glm::vec3 center = at + hair * normal;
    scene::Camera camera = scene::look_at(center + normal, center, 1.0f);
    const glm::mat3 frame(camera.world);
    camera.name = "incident meter";
    camera.world[3] = glm::vec4(center + hair * normal, 1.0f);
    camera.projection = scene::Projection::orthographic;
    camera.ymag_m = camera.xmag_m = 0.5f * hair;
    camera.znear_m = 0.0f;
    camera.zfar_m = 2.0f * hair;

    const auto material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(matt_white());
    const auto mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back({"light meter", {card(center, frame, hair, material)}});
    scene.instances.push_back({"light meter", mesh, glm::mat4(1.0f)});
    return camera;
}

scene::Camera point_spot_meter(const glm::vec3& from, const glm::vec3& towards, float field_rad) {
    scene::Camera camera = scene::look_at(from, towards, field_rad);
    camera.name = "spot meter";
    camera.znear_m = kSpotMeterNear_m;
    return camera;
}

scene::Camera through_pixel(const scene::Camera& any_camera, const glm::uvec2& pixel,
                            const glm::uvec2& size) {
    const scene::Camera camera =
        scene::fitted(any_camera, static_cast<float>(size.x) / static_cast<float>(size.y));
    const glm::vec2 half{camera.projection == scene::Projection::perspective
                             ? std::tan(0.5f * camera.yfov_rad)
                             : camera.ymag_m};
    const float step = 2.0f * half.y / static_cast<float>(size.y);
    const glm::vec2 middle = 0.5f * glm::vec2(size);
    const glm::vec2 at = (glm::vec2(pixel) + 0.5f - middle) * step;
    scene::Camera narrow = camera;
    const glm::vec3 right(camera.world[0]);
    const glm::vec3 up(camera.world[1]);
    const glm::vec3 eye(camera.world[3]);
    if (camera.projection == scene::Projection::orthographic) {
        narrow.world[3] = glm::vec4(eye + at.x * right - at.y * up, 1.0f);
        narrow.ymag_m = narrow.xmag_m = 0.5f * step;
        return narrow;
    }
    const glm::vec3 ray = at.x * right - at.y * up - glm::vec3(camera.world[2]);
    narrow = scene::look_at(eye, eye + ray, 2.0f * std::atan(0.5f * step / glm::length(ray)));
    // The planes are as far along this ray as they are along it in the picture.
    narrow.znear_m = camera.znear_m * glm::length(ray);
    narrow.zfar_m = camera.zfar_m * glm::length(ray);
    narrow.name = camera.name;
    return narrow;
}

}  // namespace candela::measure
