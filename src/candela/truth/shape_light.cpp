#include "candela/truth/shape_light.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shading/lights/disk_sampling.glsl"
#include "shading/lights/punctual.glsl"
#include "shading/lights/rectangle_sampling.glsl"
#include "shading/lights/tube_sampling.glsl"

namespace candela::truth {
namespace {

/// A flat light's frame with its bright side towards the point.
struct FlatFrame {
    glm::vec3 shines;
    glm::vec3 right;
    glm::vec3 up;

    FlatFrame(const scene::Light& light, const glm::vec3& to_center)
        : shines(light.direction), right(light.right), up(light.up()) {
        if (!light.two_sided || glm::dot(to_center, shines) <= 0.0f) return;
        shines = -shines;
        right = -right;
    }
};

}  // namespace

shading::LightDirection sample_shape(const scene::Light& light, const glm::vec3& point, const glm::vec2& u) {
    const glm::vec3 to_center = light.position - point;
    switch (light.type) {
        case scene::LightType::sphere:
            return shading::sample_sphere(u, to_center, light.radius_m);
        case scene::LightType::disk:
            return shading::sample_disk(u, to_center, FlatFrame(light, to_center).shines, light.radius_m);
        case scene::LightType::rectangle: {
            const FlatFrame f(light, to_center);
            return shading::sample_rectangle(u, to_center, f.right, f.up, light.half_width_m,
                                             light.half_height_m);
        }
        case scene::LightType::tube:
            return shading::sample_tube(u, to_center, light.right, light.half_width_m, light.radius_m);
        default:
            return shading::no_light_direction();
    }
}

float pdf_shape(const scene::Light& light, const glm::vec3& point, const glm::vec3& direction) {
    const glm::vec3 to_center = light.position - point;
    switch (light.type) {
        case scene::LightType::sphere:
            return shading::pdf_sphere(to_center, light.radius_m);
        case scene::LightType::disk:
            return shading::pdf_disk(direction, to_center, FlatFrame(light, to_center).shines,
                                     light.radius_m);
        case scene::LightType::rectangle: {
            const FlatFrame f(light, to_center);
            return shading::pdf_rectangle(direction, to_center, f.right, f.up, light.half_width_m,
                                          light.half_height_m);
        }
        case scene::LightType::tube:
            return shading::pdf_tube(direction, to_center, light.right, light.half_width_m, light.radius_m);
        default:
            return 0.0f;
    }
}

float enter_shape(const scene::Light& light, const Ray& ray) {
    const glm::vec3 to_center = light.position - ray.origin;
    switch (light.type) {
        case scene::LightType::sphere:
            return shading::enter_sphere(ray.direction, to_center, light.radius_m);
        case scene::LightType::disk:
            return shading::enter_disk(ray.direction, to_center, FlatFrame(light, to_center).shines,
                                       light.radius_m);
        case scene::LightType::rectangle: {
            const FlatFrame f(light, to_center);
            return shading::enter_rectangle(ray.direction, to_center, f.right, f.up, light.half_width_m,
                                            light.half_height_m);
        }
        case scene::LightType::tube:
            return shading::enter_tube(ray.direction, to_center, light.right, light.half_width_m,
                                       light.radius_m);
        default:
            return shading::kNoEntry;
    }
}

glm::vec3 shape_normal(const scene::Light& light, const Ray& ray, float distance_m) {
    const glm::vec3 to_center = light.position - ray.origin;
    glm::vec3 outward = ray.direction * distance_m - to_center;
    if (light.type == scene::LightType::disk || light.type == scene::LightType::rectangle)
        return FlatFrame(light, to_center).shines;
    if (light.type == scene::LightType::tube)
        outward = -shading::nearest_of_segment(-outward, light.right, light.half_width_m);
    return outward / std::max(glm::length(outward), 1e-20f);
}

float shape_attenuation(const scene::Light& light, const glm::vec3& point) {
    const glm::vec3 to_center = light.position - point;
    const float window = shading::window_attenuation(glm::length(to_center), light.range_m);
    if (light.type != scene::LightType::disk || !light.cone) return window;
    return window * shading::disk_cone_attenuation(to_center, FlatFrame(light, to_center).shines,
                                                   light.radius_m,
                                                   std::max(std::cos(light.inner_cone_rad), 0.0f),
                                                   std::max(std::cos(light.outer_cone_rad), 0.0f));
}

scene::Aabb shape_box(const scene::Light& light) {
    glm::vec3 half(light.radius_m);
    const glm::vec3 along_right = glm::abs(light.right) * light.half_width_m;
    if (light.type == scene::LightType::disk) {
        for (int c = 0; c < 3; ++c)
            half[c] *= std::sqrt(std::max(1.0f - light.direction[c] * light.direction[c], 0.0f));
    } else if (light.type == scene::LightType::rectangle) {
        half = along_right + glm::abs(light.up()) * light.half_height_m;
    } else if (light.type == scene::LightType::tube) {
        half += along_right;
    }
    return {light.position - half, light.position + half};
}

}  // namespace candela::truth
