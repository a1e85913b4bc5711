#pragma once

#include <array>
#include <limits>
#include <numbers>

#include "patches.hpp"

namespace candela::test {

/// Patches under one light each, out of the reach of all others.
struct Places {
    scene::Scene scene;
    std::vector<std::string> names;
    std::vector<glm::vec3> middles;
};

inline constexpr float kTowards_rad = 0.5f;
inline constexpr float kDistance_m = 0.75f;
/// Between neighbouring places, out of the reach of each other's lights.
inline constexpr float kPlace_m = 3.0f;

/// From a row's middle, unit: beside its mirror direction.
inline glm::vec3 towards_light(std::uint32_t row, float off_mirror = 0.1f) {
    const glm::vec3 n = patch_normal(row, kTowards_rad);
    const glm::vec3 aside = glm::normalize(glm::cross(n, glm::vec3(0.1f, -0.2f, 1.0f)));
    return glm::normalize(2.0f * n.z * n - glm::vec3(0, 0, 1) + off_mirror * (aside + 0.8f * n));
}

inline void turn_aside(scene::Light& light) {
    light.direction = glm::normalize(light.direction + 0.4f * light.right + 0.2f * light.up());
    light.right = glm::normalize(light.right - glm::dot(light.right, light.direction) * light.direction);
}

inline scene::Light local_light(scene::LightType type, const glm::vec3& row, const glm::vec3& towards,
                                float size) {
    scene::Light light;
    light.type = type;
    light.position = row + kDistance_m * towards;
    light.direction = -towards;
    light.right = glm::normalize(glm::cross(light.direction, glm::vec3(0.3f, 1.0f, 0.2f)));
    // What gives less aside of its axis is turned, so that the patch sees that it does.
    if (type == scene::LightType::spot || type == scene::LightType::frustum) turn_aside(light);
    light.color = {1.0f, 0.8f, 0.6f};
    light.range_m = 1.5f;
    light.inner_cone_rad = 0.3f;
    light.outer_cone_rad = 0.9f;
    light.horizontal_angle_rad = 1.2f;
    light.vertical_angle_rad = 1.0f;
    light.radius_m = (type == scene::LightType::tube ? 0.01f : 0.03f) * size;
    light.half_width_m = 0.05f * size;
    light.half_height_m = 0.024f * size;
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

struct LocalLightOptions {
    float size = 1.0f;        ///< factor on that of each
    bool points = false;      ///< shapes are points of the same intensity
    float off_mirror = 0.1f;  ///< of the lights, about rad
    float row_depth_m = kRowDepth_m;
    float place_m = kPlace_m;
    std::vector<scene::Material> materials = patch_materials(2457.0f / 4095.0f);
};

/// In place_m, near the origin: in single precision rays leave surfaces the further above them the further
/// away it is, and vertices have the fewer digits. The first is for small emissive surfaces.
inline constexpr std::array<std::array<float, 2>, 10> kPlaces{
    {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {1, 1}, {-1, 1}, {0, -1}, {1, -1}, {-1, -1}, {2, 0}}};

/// A place's patches, and what `add` puts over each row.
template <class Add>
void add_place(Places& out, const LocalLightOptions& o, std::string name, Add&& add) {
    const auto& at = kPlaces.at(out.names.size());
    const glm::vec3 middle = o.place_m * glm::vec3(at[0], at[1], 0.0f);
    add_patches(out.scene, middle, kTowards_rad, o.materials, o.row_depth_m);
    for (std::uint32_t row = 0; row < kPatchesSide; ++row)
        add(middle + row_middle(row, o.row_depth_m), towards_light(row, o.off_mirror));
    out.middles.push_back(middle);
    out.names.push_back(std::move(name));
}

/// Types of light that have a place, beside what is in `out`.
inline Places local_lights(const std::vector<scene::LightType>& types, const LocalLightOptions& o = {},
                           Places out = {}) {
    for (const scene::LightType type : types) {
        add_place(out, o, scene::name_of(type), [&](const glm::vec3& row, const glm::vec3& towards) {
            const scene::Light light = local_light(type, row, towards, o.size);
            out.scene.lights.push_back(o.points ? as_point(light) : light);
        });
    }
    return out;
}

/// Lights with an IES profile.
inline Places photometric_lights(const LocalLightOptions& o = {}, Places out = {}) {
    out.scene.profiles.push_back(web());
    add_place(out, o, "IES", [&](const glm::vec3& row, const glm::vec3& towards) {
        scene::Light light = local_light(scene::LightType::point, row, towards, o.size);
        turn_aside(light);
        light.intensity = 1.0f;
        light.profile = 0;
        out.scene.lights.push_back(light);
    });
    return out;
}

inline const std::vector<scene::LightType> kPunctual{scene::LightType::point, scene::LightType::spot,
                                                     scene::LightType::frustum, scene::LightType::line};
inline const std::vector<scene::LightType> kShapes{scene::LightType::sphere, scene::LightType::disk,
                                                   scene::LightType::rectangle, scene::LightType::tube};

/// Emissive squares. In a scene of their own, for they have no range: the lights of other places would be
/// among those that each sample chooses from.
inline Places emissive_squares(const LocalLightOptions& o = {}) {
    Places out;
    add_place(out, o, "emissive", [&](const glm::vec3& row, const glm::vec3& towards) {
        scene::Light frame = local_light(scene::LightType::rectangle, row, towards, o.size);
        frame.half_width_m = frame.half_height_m = 0.03f * o.size;
        frame.range_m = std::numeric_limits<float>::infinity();
        if (o.points) {
            out.scene.lights.push_back(as_point(frame));
            return;
        }
        const glm::mat4 world(glm::vec4(frame.right, 0.0f), glm::vec4(-frame.up(), 0.0f),
                              glm::vec4(frame.direction, 0.0f), glm::vec4(frame.position, 1.0f));
        scene::Material lamp = grey(0.0f);
        lamp.emissive_nit = frame.intensity * frame.color;
        out.scene.meshes.push_back(
            {"panel", {square(frame.half_width_m, static_cast<std::uint32_t>(out.scene.materials.size()))}});
        out.scene.materials.push_back(lamp);
        out.scene.instances.push_back(
            {"panel", static_cast<std::uint32_t>(out.scene.meshes.size() - 1), world});
    });
    return out;
}

/// Every type of light that has a place. Shapes in a scene of their own each: a sample picks one of all
/// lights, which is most of the noise where there are others.
inline std::vector<Places> all_local_lights() {
    std::vector<Places> out{photometric_lights({}, local_lights(kPunctual))};
    for (const scene::LightType type : kShapes) out.push_back(local_lights({type}));
    out.push_back(emissive_squares());
    return out;
}

}  // namespace candela::test
