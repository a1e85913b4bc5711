#include "candela/truth/distant_lights.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shading/lights/sampling.glsl"

namespace candela::truth {
namespace {

/// A disc thinner than this has no digits in a direction of single precision; it is a directional light.
constexpr float kLeastAngularRadius_rad = 1e-5f;

float angular_radius_rad(const scene::Light& light) {
    return light.type == scene::LightType::sun ? 0.5f * light.angular_diameter_rad : 0.0f;
}

bool has_disc(const scene::Light& light) {
    return angular_radius_rad(light) > kLeastAngularRadius_rad;
}

/// In proportion to the illuminance; more than 0 wherever a part of the disc is above the horizon.
float strength(const scene::Light& light, const glm::vec3& normal) {
    const float above = std::sin(angular_radius_rad(light)) - glm::dot(normal, light.direction);
    return light.intensity * shading::luminance(light.color) * std::max(above, 0.0f);
}

}  // namespace

DistantLights::DistantLights(const scene::Scene& scene) {
    for (const scene::Light& light : scene.lights) {
        if (!scene::is_distant(light.type) || !(light.intensity > 0.0f)) continue;
        lights_.push_back(&light);
        any_suns_ = any_suns_ || has_disc(light);
    }
}

LightSample DistantLights::sample(const glm::vec3& normal, float choice, const glm::vec2& u) const {
    float total = 0.0f;
    for (const scene::Light* light : lights_) total += strength(*light, normal);
    LightSample out;
    out.delta = true;
    if (!(total > 0.0f)) return out;
    const scene::Light* chosen = nullptr;
    float left = choice * total;
    for (const scene::Light* light : lights_) {
        const float own = strength(*light, normal);
        if (own > 0.0f) chosen = light;
        left -= own;
        if (own > 0.0f && left <= 0.0f) break;
    }
    out.casts_shadow = chosen->casts_shadow;
    out.pdf = strength(*chosen, normal) / total;
    out.direction = -chosen->direction;
    out.light = chosen->color * chosen->intensity;
    if (has_disc(*chosen)) {
        const float radius = angular_radius_rad(*chosen);
        out.delta = false;
        out.direction = shading::sample_sun(u, -chosen->direction, radius);
        out.light = luminance_nit(*chosen, out.direction);
        out.pdf *= shading::pdf_sun(radius);
    }
    return out;
}

bool DistantLights::meets(const scene::Light& light, const glm::vec3& direction) {
    return has_disc(light) && shading::meets_sun(direction, -light.direction, angular_radius_rad(light));
}

glm::vec3 DistantLights::luminance_nit(const scene::Light& light, const glm::vec3& direction) {
    return light.color *
           (light.intensity * shading::sun_nit_from_lx(direction, -light.direction, angular_radius_rad(light),
                                                       light.limb_darkening));
}

float DistantLights::pdf(const scene::Light& light, const glm::vec3& normal) const {
    float total = 0.0f;
    for (const scene::Light* other : lights_) total += strength(*other, normal);
    if (!(total > 0.0f)) return 0.0f;
    return strength(light, normal) / total * shading::pdf_sun(angular_radius_rad(light));
}

}  // namespace candela::truth
