#include "candela/realtime/exposure_control.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "shading/exposure.glsl"
#include "shading/language.glsl"

namespace candela::realtime {

float manual_ev100(const scene::Exposure& exposure) {
    if (exposure.ev100) return *exposure.ev100;
    return shading::ev100_from_camera(*exposure.aperture_f, *exposure.shutter_s, *exposure.iso);
}

LightEstimate estimate_light(const scene::Scene& scene) {
    LightEstimate estimate;
    float illuminance_lx = 0.0f;
    const scene::Aabb bounds = scene::world_bounds(scene);
    const glm::vec3 center = bounds.empty() ? glm::vec3(0.0f) : 0.5f * (bounds.min + bounds.max);
    const float reach_m =
        bounds.empty() ? 1.0f : std::max(0.25f * glm::length(bounds.max - bounds.min), 1e-3f);
    for (const scene::Light& light : scene.lights) {
        const float strength = light.intensity * shading::luminance(light.color);
        if (light.type == scene::LightType::directional) {
            illuminance_lx += strength;
        } else {
            const float distance_m = std::max(glm::length(light.position - center), reach_m);
            illuminance_lx += strength / (distance_m * distance_m);
        }
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
