#include "candela/truth/light_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "candela/truth/shape_light.hpp"

namespace candela::truth {
namespace {

void bound_everywhere(LightBounds& b) {
    b.cos_normals = -1.0f;
}

void bound_cone(const scene::Light& light, float cosine, LightBounds& b) {
    b.axis = light.direction;
    b.cos_emission = cosine;
}

/// The half angle about the aim outside of which a profile is dark.
float profile_cone_rad(const scene::PhotometricProfile& profile) {
    const std::size_t rows = profile.vertical_deg.size();
    std::size_t last = 0;
    for (std::size_t i = 0; i < profile.candela.size(); ++i) {
        if (profile.candela[i] > 0.0f) last = std::max(last, i % rows);
    }
    // Between the last row with light and the next one it fades.
    const double degrees = rows > 0 ? profile.vertical_deg[std::min(last + 1, rows - 1)] : 180.0;
    return static_cast<float>(degrees) * shading::PI / 180.0f;
}

/// Of point, spot and frustum.
void bound_directions(const scene::Light& light, const scene::Scene& scene, LightBounds& b) {
    float cosine = -1.0f;
    if (light.type == scene::LightType::spot) {
        cosine = std::cos(light.outer_cone_rad);
    } else if (light.type == scene::LightType::frustum) {
        const float h = std::tan(0.5f * light.horizontal_angle_rad);
        const float v = std::tan(0.5f * light.vertical_angle_rad);
        cosine = 1.0f / std::sqrt(1.0f + h * h + v * v);
    }
    if (light.profile < scene.profiles.size()) {
        const scene::PhotometricProfile& profile = scene.profiles[light.profile];
        float most = 0.0f;
        for (const float cd : profile.candela) most = std::max(most, cd);
        b.power *= most;
        cosine = std::max(cosine, std::cos(profile_cone_rad(profile)));
    }
    if (cosine > -1.0f) {
        bound_cone(light, cosine, b);
    } else {
        bound_everywhere(b);
    }
}

float largest_projected_area_m2(const scene::Light& light) {
    const float disk = shading::PI * light.radius_m * light.radius_m;
    switch (light.type) {
        case scene::LightType::rectangle:
            return 4.0f * light.half_width_m * light.half_height_m;
        case scene::LightType::tube:
            return disk + 4.0f * light.half_width_m * light.radius_m;
        default:
            return disk;
    }
}

}  // namespace

LightBounds light_bounds(const scene::Light& light, const scene::Scene& scene, const Textures& textures) {
    LightBounds b;
    b.power = light.intensity * shading::luminance(light.color);
    b.box.extend(light.position);
    if (std::isfinite(light.range_m))
        b.reach = {light.position - light.range_m, light.position + light.range_m};
    switch (light.type) {
        case scene::LightType::line: {
            const glm::vec3 half = light.right * light.half_width_m;
            b.box.extend(light.position - half);
            b.box.extend(light.position + half);
            bound_everywhere(b);
            break;
        }
        case scene::LightType::sphere:
        case scene::LightType::tube:
            b.box = shape_box(light);
            b.power *= largest_projected_area_m2(light);
            bound_everywhere(b);
            break;
        case scene::LightType::disk:
        case scene::LightType::rectangle:
            b.box = shape_box(light);
            if (light.image != scene::no_index && light.type == scene::LightType::rectangle)
                b.power = light.intensity *
                          shading::luminance(light.color * textures.mean_of_srgb_image(light.image));
            b.power *= largest_projected_area_m2(light);
            b.axis = light.direction;
            b.two_sided = light.two_sided;
            break;
        default:
            bound_directions(light, scene, b);
    }
    return b;
}

}  // namespace candela::truth
