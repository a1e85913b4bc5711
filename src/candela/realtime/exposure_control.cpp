#include "candela/realtime/exposure_control.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "candela/scene/environment_sources.hpp"
#include "shading/exposure.glsl"
#include "shading/language.glsl"
#include "shading/lights/sampling.glsl"
#include "shading/lights/units.glsl"

namespace candela::realtime {

float manual_ev100(const scene::Exposure& exposure) {
    if (exposure.ev100) return *exposure.ev100;
    return shading::ev100_from_camera(*exposure.aperture_f, *exposure.shutter_s, *exposure.iso);
}

float exposure_at(float ev100, ExposureTechnique technique) {
    return technique == ExposureTechnique::saturation ? shading::exposure_from_ev100(ev100)
                                                      : shading::standard_output_exposure(ev100);
}

float ev100_at(float exposure, ExposureTechnique technique) {
    return technique == ExposureTechnique::saturation ? shading::ev100_from_exposure(exposure)
                                                      : shading::ev100_from_standard_output(exposure);
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

float illuminance_lx_of(const scene::Light& light, const glm::vec3& center, float reach_m) {
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

float typical_illuminance_lx(const scene::Scene& scene, const scene::Aabb& bounds) {
    float illuminance_lx = 0.0f;
    const glm::vec3 center = bounds.empty() ? glm::vec3(0.0f) : 0.5f * (bounds.min + bounds.max);
    const float reach_m =
        bounds.empty() ? 1.0f : std::max(0.25f * glm::length(bounds.max - bounds.min), 1e-3f);
    for (const scene::Light& light : scene.lights)
        illuminance_lx += illuminance_lx_of(light, center, reach_m);
    if (!scene.environment || scene.environment->luminance_nit.empty()) return illuminance_lx;
    const double mean_nit = shading::luminance(scene::mean_nit(*scene.environment));
    return illuminance_lx + shading::PI * static_cast<float>(std::max(mean_nit, 0.0));
}

LightEstimate estimate_light(const scene::Scene& scene) {
    LightEstimate estimate;
    for (const scene::Light& light : scene.lights)
        estimate.peak_nit = std::max(estimate.peak_nit, visible_nit(light));
    if (scene.environment) {
        for (const glm::vec3& texel : scene.environment->luminance_nit)
            estimate.peak_nit =
                std::max(estimate.peak_nit, shading::max_component(texel) * scene.environment->scale);
    }
    for (const scene::Material& material : scene.materials)
        estimate.peak_nit = std::max(estimate.peak_nit, shading::max_component(material.emissive_nit));
    estimate.typical_nit =
        0.18f * typical_illuminance_lx(scene, scene::world_bounds(scene)) * shading::INV_PI;
    if (estimate.typical_nit <= 0.0f)
        estimate.typical_nit = estimate.peak_nit > 0.0f ? 0.1f * estimate.peak_nit : 100.0f;
    return estimate;
}

}  // namespace candela::realtime
