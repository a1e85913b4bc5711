#pragma once

#include <numbers>

#include "patches.hpp"

namespace candela::test {

/// Patches under one light each, so far apart that each has the light of its own only.
struct Places {
    scene::Scene scene;
    std::vector<std::string> names;
    std::vector<glm::vec3> middles;
};

inline constexpr float kTowards_rad = 0.5f;
inline constexpr float kDistance_m = 1.5f;

/// From a row's middle, unit: beside its mirror direction.
inline glm::vec3 towards_light(std::uint32_t row) {
    const glm::vec3 n = patch_normal(row, kTowards_rad);
    const glm::vec3 aside = glm::normalize(glm::cross(n, glm::vec3(0.1f, -0.2f, 1.0f)));
    return glm::normalize(2.0f * n.z * n - glm::vec3(0, 0, 1) + 0.1f * aside + 0.08f * n);
}

inline scene::Light local_light(scene::LightType type, const glm::vec3& row, const glm::vec3& towards,
                                float size) {
    scene::Light light;
    light.type = type;
    light.position = row + kDistance_m * towards;
    light.direction = -towards;
    light.right = glm::normalize(glm::cross(light.direction, glm::vec3(0.3f, 1.0f, 0.2f)));
    light.color = {1.0f, 0.8f, 0.6f};
    light.range_m = 6.0f;
    light.inner_cone_rad = 0.3f;
    light.outer_cone_rad = 0.9f;
    light.horizontal_angle_rad = 1.2f;
    light.vertical_angle_rad = 1.0f;
    light.radius_m = (type == scene::LightType::tube ? 0.05f : 0.15f) * size;
    light.half_width_m = 0.25f * size;
    light.half_height_m = 0.12f * size;
    light.visible = false;
    light.casts_shadow = false;
    const bool has_luminance = type == scene::LightType::sphere || type == scene::LightType::disk ||
                               type == scene::LightType::rectangle || type == scene::LightType::tube;
    light.intensity = has_luminance ? 1.0e4f / (size * size) : 1000.0f;
    return light;
}

/// cd along 37 polar angles, more to one side.
inline scene::PhotometricProfile web() {
    scene::PhotometricProfile p;
    p.name = "web";
    p.lamp_sets.emplace_back();
    for (int v = 0; v <= 36; ++v) p.vertical_deg.push_back(5.0 * v);
    for (int h = 0; h <= 12; ++h) p.horizontal_deg.push_back(30.0 * h);
    for (int h = 0; h <= 12; ++h) {
        for (int v = 0; v <= 36; ++v) {
            const double polar = 5.0 * v * std::numbers::pi / 180.0;
            const double azimuth = 30.0 * h * std::numbers::pi / 180.0;
            p.candela.push_back(
                float(800.0 + 500.0 * std::cos(polar) + 200.0 * std::sin(polar) * std::cos(azimuth)));
        }
    }
    return p;
}

/// The point light of a shape's intensity perpendicular to it, in cd.
inline scene::Light as_point(scene::Light light) {
    using scene::LightType;
    const float disc_m2 = std::numbers::pi_v<float> * light.radius_m * light.radius_m;
    switch (light.type) {
        case LightType::sphere:
        case LightType::disk:
            light.intensity *= disc_m2;
            break;
        case LightType::rectangle:
            light.intensity *= 4.0f * light.half_width_m * light.half_height_m;
            break;
        case LightType::tube:
            light.intensity *= disc_m2 + 4.0f * light.half_width_m * light.radius_m;
            break;
        case LightType::line:
            break;
        default:
            return light;
    }
    light.type = LightType::point;
    return light;
}

/// Every type of light that has a place, an IES profile and an emissive square. size: factor on that of each.
/// points: shapes are points of the same intensity.
inline Places local_lights(float size = 1.0f, bool points = false) {
    using scene::LightType;
    Places out;
    out.scene.profiles.push_back(web());
    const auto each_row = [&](std::string name, auto&& add) {
        const glm::vec3 middle(12.0f * (static_cast<float>(out.names.size()) - 5.0f), 0.0f, 0.0f);
        add_patches(out.scene, middle, kTowards_rad, 2457.0f / 4095.0f);
        for (std::uint32_t row = 0; row < kPatchesSide; ++row)
            add(middle + row_middle(row), towards_light(row));
        out.middles.push_back(middle);
        out.names.push_back(std::move(name));
    };
    for (const LightType type : {LightType::point, LightType::spot, LightType::frustum, LightType::sphere,
                                 LightType::disk, LightType::rectangle, LightType::tube, LightType::line}) {
        each_row(scene::name_of(type), [&](const glm::vec3& row, const glm::vec3& towards) {
            const scene::Light light = local_light(type, row, towards, size);
            out.scene.lights.push_back(points ? as_point(light) : light);
        });
    }
    each_row("IES", [&](const glm::vec3& row, const glm::vec3& towards) {
        scene::Light light = local_light(LightType::point, row, towards, size);
        light.intensity = 1.0f;
        light.profile = 0;
        out.scene.lights.push_back(light);
    });
    each_row("emissive", [&](const glm::vec3& row, const glm::vec3& towards) {
        scene::Light frame = local_light(LightType::rectangle, row, towards, size);
        if (points) {
            frame.half_width_m = frame.half_height_m = 0.15f * size;
            out.scene.lights.push_back(as_point(frame));
            return;
        }
        glm::mat4 world(glm::vec4(frame.right, 0.0f), glm::vec4(-frame.up(), 0.0f),
                        glm::vec4(frame.direction, 0.0f), glm::vec4(frame.position, 1.0f));
        scene::Material lamp = grey(0.0f);
        lamp.emissive_nit = glm::vec3(1.0e4f, 0.8e4f, 0.6e4f) / (size * size);
        out.scene.meshes.push_back(
            {"panel", {square(0.15f * size, static_cast<std::uint32_t>(out.scene.materials.size()))}});
        out.scene.materials.push_back(lamp);
        out.scene.instances.push_back(
            {"panel", static_cast<std::uint32_t>(out.scene.meshes.size() - 1), world});
    });
    return out;
}

}  // namespace candela::test
