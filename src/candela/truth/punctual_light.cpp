#include "candela/truth/punctual_light.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "shading/lights/punctual.glsl"
#include "shading/lights/sampling.glsl"

namespace candela::truth {
namespace {

/// Intensity towards the unit direction `travels`, as a factor on Light::intensity.
float angular(const scene::Light& light, const scene::Scene& scene, const glm::vec3& travels) {
    float factor = 1.0f;
    if (light.type == scene::LightType::spot) {
        factor = shading::angle_attenuation(glm::dot(travels, light.direction),
                                            std::cos(light.inner_cone_rad), std::cos(light.outer_cone_rad));
    } else if (light.type == scene::LightType::frustum) {
        factor = shading::frustum_attenuation(travels, light.direction, light.right, light.up(),
                                              std::tan(0.5f * light.horizontal_angle_rad),
                                              std::tan(0.5f * light.vertical_angle_rad));
    }
    if (factor > 0.0f && light.profile < scene.profiles.size()) {
        const glm::vec3 local(glm::dot(travels, light.right), glm::dot(travels, light.up()),
                              -glm::dot(travels, light.direction));
        factor *= static_cast<float>(scene::intensity_cd(scene.profiles[light.profile], local));
    }
    return factor;
}

LightSample sample_line(const scene::Light& light, const glm::vec3& point, float u) {
    const glm::vec3 to_center = light.position - point;
    const shading::LinePoint p = shading::sample_line(u, to_center, light.right, light.half_width_m);
    LightSample out;
    out.delta = true;
    out.casts_shadow = light.casts_shadow;
    out.distance_m = glm::length(p.to_point_m);
    if (!(out.distance_m > 0.0f) || !(p.per_m2 > 0.0f)) return out;
    out.direction = p.to_point_m / out.distance_m;
    out.light = light.color * (light.intensity * p.per_m2 *
                               shading::window_attenuation(glm::length(to_center), light.range_m));
    out.pdf = 1.0f;
    return out;
}

}  // namespace

LightSample sample_punctual(const scene::Light& light, const scene::Scene& scene,
                            const shading::Falloff& falloff, const glm::vec3& point, float u) {
    if (light.type == scene::LightType::line) return sample_line(light, point, u);
    LightSample out;
    out.delta = true;
    out.casts_shadow = light.casts_shadow;
    const glm::vec3 to_light = light.position - point;
    out.distance_m = glm::length(to_light);
    if (!(out.distance_m > 0.0f)) return out;
    out.direction = to_light / out.distance_m;
    out.light = light.color * (light.intensity * angular(light, scene, -out.direction) *
                               shading::distance_attenuation(falloff, to_light, light.range_m));
    out.pdf = 1.0f;
    return out;
}

}  // namespace candela::truth
