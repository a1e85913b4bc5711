#include "candela/realtime/exposure_control.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "shading/exposure.glsl"
#include "shading/language.glsl"
#include "shading/lights/sampling.glsl"
#include "shading/lights/units.glsl"

namespace candela::realtime {

float manual_ev100(const scene::Exposure& exposure) {
    if (exposure.ev100) return *exposure.ev100;
    return shading::ev100_from_camera(*exposure.aperture_f, *exposure.shutter_s, *exposure.iso);
}

namespace {

/// Intensity in cd of a light far away, seen from where it is largest.
float intensity_cd(const scene::Light& light) {
    const float strength = light.intensity * shading::luminance(light.color);
    switch (light.type) {
        case scene::LightType::sphere:
            return strength * shading::PI * shading::square(light.radius_m);
        case scene::LightType::disk:
            return strength * shading::disk_area(light.radius_m);
        case scene::LightType::rectangle:
            return strength * 4.0f * light.half_width_m * light.half_height_m;
        case scene::LightType::tube:
            return strength * (shading::PI * shading::square(light.radius_m) +
                               4.0f * light.radius_m * light.half_width_m);
        default:
            return strength;
    }
}

float typical_illuminance_lx(const scene::Light& light, const glm::vec3& center, float reach_m) {
    const float strength = intensity_cd(light);
    if (scene::is_distant(light.type)) return strength;
    const float distance_m = std::max(glm::length(light.position - center), reach_m);
    return strength / (distance_m * distance_m);
}

/// The brightest channel of what the camera sees of a light, in cd/m^2; 0 when it sees nothing of it.
float visible_nit(const scene::Light& light) {
    if (!light.visible || !scene::has_extent(light.type)) return 0.0f;
    const float strength = light.intensity * shading::max_component(light.color);
    if (light.type != scene::LightType::sun) return strength;
    const glm::vec3 to_sun = -light.direction;
    return strength *
           shading::sun_nit_from_lx(to_sun, to_sun, 0.5f * light.angular_diameter_rad, light.limb_darkening);
}

}  // namespace

LightEstimate estimate_light(const scene::Scene& scene) {
    LightEstimate estimate;
    float illuminance_lx = 0.0f;
    const scene::Aabb bounds = scene::world_bounds(scene);
    const glm::vec3 center = bounds.empty() ? glm::vec3(0.0f) : 0.5f * (bounds.min + bounds.max);
    const float reach_m =
        bounds.empty() ? 1.0f : std::max(0.25f * glm::length(bounds.max - bounds.min), 1e-3f);
    for (const scene::Light& light : scene.lights) {
        illuminance_lx += typical_illuminance_lx(light, center, reach_m);
        estimate.peak_nit = std::max(estimate.peak_nit, visible_nit(light));
    }
    if (scene.environment && !scene.environment->luminance_nit.empty()) {
        const scene::Environment& e = *scene.environment;
        double sum = 0.0;
        for (const glm::vec3& texel : e.luminance_nit) {
            sum += shading::luminance(texel);
            estimate.peak_nit =
                std::max(estimate.peak_nit, std::max(texel.x, std::max(texel.y, texel.z)) * e.scale);
        }
        illuminance_lx +=
            shading::PI * e.scale * static_cast<float>(sum / static_cast<double>(e.luminance_nit.size()));
    }
    for (const scene::Material& material : scene.materials) {
        const glm::vec3& e = material.emissive_nit;
        estimate.peak_nit = std::max(estimate.peak_nit, std::max(e.x, std::max(e.y, e.z)));
    }
    estimate.typical_nit = 0.18f * illuminance_lx * shading::INV_PI;
    if (estimate.typical_nit <= 0.0f)
        estimate.typical_nit = estimate.peak_nit > 0.0f ? 0.1f * estimate.peak_nit : 100.0f;
    return estimate;
}

}  // namespace candela::realtime
