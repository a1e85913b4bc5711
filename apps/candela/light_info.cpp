#include "light_info.hpp"

#include <cmath>
#include <cstdio>

#include "candela/scene/light_units.hpp"
#include "shading/exposure.glsl"
#include "shading/sampling.glsl"

namespace candela::app {
namespace {

using nlohmann::json;
using scene::Light;
using scene::LightType;

constexpr float kDegPerRad = 57.2957795f;

json vector_json(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

void add_size(const Light& light, json& out) {
    switch (light.type) {
        case LightType::disk:
            if (light.cone) {
                out["inner_cone_deg"] = light.inner_cone_rad * kDegPerRad;
                out["outer_cone_deg"] = light.outer_cone_rad * kDegPerRad;
            }
            [[fallthrough]];
        case LightType::sphere:
            out["radius_m"] = light.radius_m;
            break;
        case LightType::tube:
            out["radius_m"] = light.radius_m;
            out["length_m"] = 2.0f * light.half_width_m;
            break;
        case LightType::line:
            out["length_m"] = 2.0f * light.half_width_m;
            break;
        case LightType::rectangle:
            out["width_m"] = 2.0f * light.half_width_m;
            out["height_m"] = 2.0f * light.half_height_m;
            break;
        case LightType::spot:
            out["inner_cone_deg"] = light.inner_cone_rad * kDegPerRad;
            out["outer_cone_deg"] = light.outer_cone_rad * kDegPerRad;
            out["spot_power"] = light.spot_power == scene::SpotPower::exact ? "exact" : "frostbite";
            break;
        case LightType::frustum:
            out["horizontal_angle_deg"] = light.horizontal_angle_rad * kDegPerRad;
            out["vertical_angle_deg"] = light.vertical_angle_rad * kDegPerRad;
            break;
        case LightType::sun:
            out["angular_diameter_deg"] = light.angular_diameter_rad * kDegPerRad;
            out["limb_darkening"] = light.limb_darkening;
            break;
        case LightType::point:
        case LightType::directional:
            break;
    }
}

void add_quantities(const scene::LightQuantities& q, json& out) {
    const auto add = [&](const char* key, const std::optional<float>& value) {
        if (value) out[key] = *value;
    };
    add("power_lm", q.power_lm);
    add("emitted_lm", q.emitted_lm);
    add("power_w", q.power_w);
    add("intensity_cd", q.intensity_cd);
    add("peak_cd", q.peak_cd);
    add("illuminance_lx", q.illuminance_lx);
    add("illuminance_at_1m_lx", q.illuminance_at_1m_lx);
    add("luminance_nit", q.luminance_nit);
    add("ev100", q.ev100);
}

std::string format(const char* pattern, double value) {
    char text[96];
    std::snprintf(text, sizeof(text), pattern, value);
    return text;
}

}  // namespace

json light_json(const Light& light, const scene::Scene& scene) {
    json out{{"name", light.name},
             {"type", scene::name_of(light.type)},
             {"carrier", light.carrier},
             {"stated_in", scene::name_of(light.unit)},
             {"color", vector_json(light.color)},
             {"direction", vector_json(light.direction)},
             {"casts_shadow", light.casts_shadow}};
    if (!scene::is_distant(light.type)) out["position"] = vector_json(scene.frame.to_world(light.position));
    if (light.color_temperature_k > 0.0f) out["temperature_k"] = light.color_temperature_k;
    if (light.efficacy_lm_per_w > 0.0f) out["efficacy_lm_per_w"] = light.efficacy_lm_per_w;
    if (!scene::is_distant(light.type) && !std::isinf(light.range_m)) out["range_m"] = light.range_m;
    if (scene::has_extent(light.type)) out["visible"] = light.visible;
    if (light.type == LightType::disk || light.type == LightType::rectangle)
        out["two_sided"] = light.two_sided;
    add_size(light, out);
    const scene::PhotometricProfile* profile =
        light.profile == scene::no_index ? nullptr : &scene.profiles[light.profile];
    if (profile) out["profile"] = profile->name;
    if (light.image != scene::no_index) out["image"] = scene.images[light.image].name;
    add_quantities(scene::quantities(light, profile), out);
    return out;
}

std::vector<std::string> light_lines(const json& light) {
    struct Row {
        const char* key;
        const char* pattern;
    };
    static constexpr Row head[] = {{"radius_m", "radius %g m"},
                                   {"width_m", "%g"},
                                   {"height_m", "x %g m"},
                                   {"length_m", "length %g m"},
                                   {"inner_cone_deg", "cones of %.4g"},
                                   {"outer_cone_deg", "and %.4g degrees"},
                                   {"horizontal_angle_deg", "%.4g"},
                                   {"vertical_angle_deg", "x %.4g degrees"},
                                   {"angular_diameter_deg", "%.4g degrees"},
                                   {"range_m", "range %g m"},
                                   {"temperature_k", "%g K"}};
    static constexpr Row body[] = {
        {"power_lm", "%.6g lm"},         {"power_w", "%.6g W"},
        {"intensity_cd", "%.6g cd"},     {"peak_cd", "peak %.6g cd"},
        {"illuminance_lx", "%.6g lx"},   {"illuminance_at_1m_lx", "%.6g lx at 1 m"},
        {"luminance_nit", "%.6g cd/m2"}, {"ev100", "EV100 %.4g"}};
    std::string first =
        "  light    " + light["name"].get<std::string>() + ": " + light["type"].get<std::string>();
    for (const Row& r : head) {
        if (light.contains(r.key)) first += " " + format(r.pattern, light[r.key].get<double>());
    }
    if (light.contains("profile")) first += ", profile " + light["profile"].get<std::string>();
    if (light.value("two_sided", false)) first += ", two-sided";
    if (!light["casts_shadow"].get<bool>()) first += ", without shadow";
    first += " (" + light["carrier"].get<std::string>() + ")";
    std::string second;
    for (const Row& r : body) {
        if (!light.contains(r.key)) continue;
        second += (second.empty() ? "           " : ", ") + format(r.pattern, light[r.key].get<double>());
    }
    if (light.contains("emitted_lm") && light["emitted_lm"] != light["power_lm"])
        second += ", emits " + format("%.6g lm", light["emitted_lm"].get<double>());
    return {first, second};
}

json emissive_json(const realtime::EmissiveSurface& surface, const scene::Scene& scene) {
    const scene::Material& material = scene.materials[surface.material];
    const double nit = double(shading::luminance(glm::vec3(surface.mean_nit)));
    const double sides = material.double_sided ? 2.0 : 1.0;
    return {{"name", scene.instances[surface.instance].name},
            {"material", material.name},
            {"triangles", surface.triangles},
            {"area_m2", surface.area_m2},
            {"two_sided", material.double_sided},
            {"luminance_nit", nit},
            {"power_lm", double(shading::PI) * nit * surface.area_m2 * sides}};
}

std::vector<std::string> emissive_lines(const json& s) {
    return {"  emissive " + s["name"].get<std::string>() + ": " +
                format("%.0f triangles", s["triangles"].get<double>()) +
                format(", %.4g m2", s["area_m2"].get<double>()) +
                (s["two_sided"].get<bool>() ? ", two-sided" : "") + " (material " +
                s["material"].get<std::string>() + ")",
            "           " + format("%.6g lm", s["power_lm"].get<double>()) +
                format(", %.6g cd/m2", s["luminance_nit"].get<double>())};
}

}  // namespace candela::app
