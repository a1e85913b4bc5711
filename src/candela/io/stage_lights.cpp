#include "candela/io/stage_lights.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "candela/io/inside_folder.hpp"
#include "candela/io/stage_object.hpp"
#include "candela/scene/error.hpp"
#include "shading/color_temperature.glsl"

namespace candela::io {
namespace {

using nlohmann::json;
using scene::Light;
using scene::LightType;
using scene::LightUnit;

constexpr float kRadPerDeg = static_cast<float>(M_PI / 180.0);

const std::vector<std::string>& type_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> out;
        for (auto t = LightType::point; t <= LightType::rectangle;
             t = static_cast<LightType>(static_cast<int>(t) + 1))
            out.emplace_back(scene::name_of(t));
        return out;
    }();
    return names;
}

struct UnitKey {
    const char* key;
    LightUnit unit;
};
constexpr UnitKey kUnitKeys[] = {{"power_lm", LightUnit::lumen},     {"intensity_cd", LightUnit::candela},
                                 {"illuminance_lx", LightUnit::lux}, {"luminance_nit", LightUnit::nit},
                                 {"ev100", LightUnit::ev100},        {"power_w", LightUnit::watt}};

bool has(const StageLight& light, const std::string& key) {
    return std::find(light.keys.begin(), light.keys.end(), key) != light.keys.end();
}

/// The keys that only some types have.
bool belongs(const std::string& key, LightType type) {
    const auto is = [&](std::initializer_list<LightType> types) {
        return std::find(types.begin(), types.end(), type) != types.end();
    };
    if (key == "position" || key == "look_at" || key == "range_m") return !scene::is_distant(type);
    if (key == "radius_m") return is({LightType::sphere, LightType::disk, LightType::tube});
    if (key == "width_m" || key == "height_m") return type == LightType::rectangle;
    if (key == "length_m") return is({LightType::line, LightType::tube});
    if (key == "inner_cone_deg" || key == "outer_cone_deg") return is({LightType::spot, LightType::disk});
    if (key == "spot_power") return type == LightType::spot;
    if (key == "horizontal_angle_deg" || key == "vertical_angle_deg") return type == LightType::frustum;
    if (key == "angular_diameter_deg" || key == "limb_darkening") return type == LightType::sun;
    if (key == "two_sided") return is({LightType::disk, LightType::rectangle});
    if (key == "visible") return scene::has_extent(type);
    if (key == "image") return type == LightType::rectangle;
    if (key.starts_with("profile")) return is({LightType::point, LightType::spot});
    for (const UnitKey& u : kUnitKeys) {
        if (key == u.key) return scene::accepts(type, u.unit);
    }
    return true;
}

/// The sizes without which a type has no shape.
void check_sizes(const StageLight& light, LightType type) {
    const auto need = [&](const char* key) {
        if (!has(light, key))
            throw input_error(std::string("a ") + scene::name_of(type) + " light needs " + key, light.where);
    };
    if (type == LightType::sphere || type == LightType::disk || type == LightType::tube) need("radius_m");
    if (type == LightType::rectangle) need("width_m"), need("height_m");
    if (type == LightType::line || type == LightType::tube) need("length_m");
}

/// Which keys state how strong a profile is.
void check_profile(const StageLight& light, bool has_unit) {
    const auto fail = [&](const std::string& what, const std::string& hint) {
        throw input_error(what, light.where, hint);
    };
    const bool absolute = light.profile_scale == scene::ProfileScale::absolute;
    if (has_unit && (absolute || has(light, "profile_multiplier")))
        fail("a profile with its own cd has no other strength", "keep profile_multiplier or the unit");
    if (!has_unit && light.profile_scale && !absolute)
        fail("does not state the strength of its profile", "\"power_lm\": 800");
    if (light.profile_scale == scene::ProfileScale::power && has(light, "intensity_cd"))
        fail("states the power of its profile in cd", "power_lm, or \"profile_scale\": \"mask\"");
}

void check_entry(const json& value, const StageLight& light) {
    const auto one_of = [&](const char* a, const char* b) {
        if (has(light, a) && has(light, b))
            throw input_error(std::string("has both ") + a + " and " + b, light.where, "keep one of them");
    };
    one_of("direction", "look_at");
    one_of("color", "temperature_k");
    if (has(light, "power_w") != has(light, "efficacy_lm_per_w"))
        throw input_error("needs power_w and efficacy_lm_per_w together", light.where,
                          "a lamp's lm per W: incandescent 15, LED 100; 683 for W of 555 nm light");
    const auto units = std::count_if(std::begin(kUnitKeys), std::end(kUnitKeys),
                                     [&](const UnitKey& u) { return has(light, u.key); });
    if (units > 1) throw input_error("states its strength in more than one unit", light.where, "keep one");
    check_profile(light, units > 0);
    if (light.off && value.size() != 2)
        throw input_error("has keys that a light that is off cannot use", light.where,
                          "{\"override\": NAME, \"off\": true}");
    if (light.overrides) return;
    if (has(light, "off")) throw input_error("needs override, the name of a light", light.where);
    if (!light.type) throw input_error("needs a type, or override", light.where, "\"type\": \"sphere\"");
    if (units == 0 && light.profile.empty())
        throw input_error(
            "does not state its strength", light.where,
            scene::accepts(*light.type, LightUnit::lux) ? "\"illuminance_lx\": 100000" : "\"power_lm\": 800");
    check_sizes(light, *light.type);
}

using Handlers = std::map<std::string, StageObject::Handler>;

/// A key that sets something of the light to what `read` makes of its value.
template <class Read, class Set>
StageObject::Handler editing(StageLight& out, Read read, Set set) {
    return [&out, read, set](const json& v, const std::string& at) {
        const auto value = read(v, at);
        out.edits.emplace_back([value, set](Light& light) { set(light, value); });
    };
}

void add_identity(Handlers& h, StageLight& out) {
    h["name"] = editing(out, stage_text, [](Light& l, const std::string& x) { l.name = x; });
    h["override"] = [&](const json& v, const std::string& at) { out.overrides = stage_text(v, at); };
    h["off"] = [&](const json& v, const std::string& at) { out.off = stage_boolean(v, at); };
    h["type"] = [&](const json& v, const std::string& at) {
        out.type = static_cast<LightType>(stage_choice(v, at, type_names()));
    };
}

void add_placement(Handlers& h, StageLight& out) {
    const auto unit_vector = [](const json& v, const std::string& at) {
        const glm::vec3 x = stage_vector(v, at);
        if (!(glm::length(x) > 1e-6f)) throw input_error("has no length", at);
        return glm::normalize(x);
    };
    h["node"] = [&](const json& v, const std::string& at) { out.node = stage_text(v, at); };
    h["position"] = [&](const json& v, const std::string& at) { out.position = stage_point(v, at); };
    h["look_at"] = [&](const json& v, const std::string& at) { out.look_at = stage_point(v, at); };
    h["direction"] = [&, unit_vector](const json& v, const std::string& at) {
        out.direction = unit_vector(v, at);
    };
    h["right"] = [&, unit_vector](const json& v, const std::string& at) { out.right = unit_vector(v, at); };
    h["roll_deg"] = [&](const json& v, const std::string& at) {
        out.roll_rad = stage_number(v, at, -36000.0, 36000.0, "degrees") * kRadPerDeg;
    };
}

void add_strength(Handlers& h, StageLight& out) {
    const auto strength = [&out]() -> scene::LightStrength& {
        if (!out.strength) out.strength.emplace();
        return *out.strength;
    };
    for (const UnitKey& u : kUnitKeys) {
        h[u.key] = [strength, u](const json& v, const std::string& at) {
            const bool exponent = u.unit == LightUnit::ev100;
            strength().value = exponent ? stage_number(v, at, -30.0, 40.0, "-30 to 40")
                                        : stage_number(v, at, 0.0, 1e12, "0 to 1e12");
            strength().unit = u.unit;
        };
    }
    h["efficacy_lm_per_w"] = [strength](const json& v, const std::string& at) {
        strength().efficacy_lm_per_w = stage_number(v, at, 0.001, 683.0, "0.001 to 683");
    };
    h["color"] = editing(
        out, [](const json& v, const std::string& at) { return stage_vector(v, at, 0.0, 1e6, "0 to 1e6"); },
        [](Light& l, const glm::vec3& x) { l.color = x, l.color_temperature_k = 0.0f; });
    h["temperature_k"] = editing(
        out,
        [](const json& v, const std::string& at) {
            return stage_number(v, at, 800.0, 25000.0, "800 to 25,000 K");
        },
        [](Light& l, float kelvin) {
            l.color = shading::rec709_from_temperature(kelvin);
            l.color_temperature_k = kelvin;
        });
}

void add_shape(Handlers& h, StageLight& out) {
    const auto degrees = [](double low, double high, const std::string& range) {
        return [=](const json& v, const std::string& at) {
            return stage_number(v, at, low, high, range) * kRadPerDeg;
        };
    };
    const auto half_angle = degrees(0.0, 90.0, "0 to 90 degrees, from the axis");
    const auto opening = degrees(0.1, 179.0, "0.1 to 179 degrees");
    const auto meters = [](const json& v, const std::string& at) {
        return stage_number(v, at, 1e-9, 1e10, "1e-9 to 1e10 m");
    };
    h["radius_m"] = editing(out, meters, [](Light& l, float x) { l.radius_m = x; });
    h["width_m"] = editing(out, meters, [](Light& l, float x) { l.half_width_m = 0.5f * x; });
    h["length_m"] = h["width_m"];
    h["height_m"] = editing(out, meters, [](Light& l, float x) { l.half_height_m = 0.5f * x; });
    h["range_m"] = editing(out, stage_positive, [](Light& l, float x) { l.range_m = x; });
    h["inner_cone_deg"] =
        editing(out, half_angle, [](Light& l, float x) { l.inner_cone_rad = x, l.cone = true; });
    h["outer_cone_deg"] = editing(out, degrees(0.05, 90.0, "0.05 to 90 degrees, from the axis"),
                                  [](Light& l, float x) { l.outer_cone_rad = x, l.cone = true; });
    h["horizontal_angle_deg"] = editing(out, opening, [](Light& l, float x) { l.horizontal_angle_rad = x; });
    h["vertical_angle_deg"] = editing(out, opening, [](Light& l, float x) { l.vertical_angle_rad = x; });
    h["angular_diameter_deg"] = editing(out, degrees(0.01, 90.0, "0.01 to 90 degrees"),
                                        [](Light& l, float x) { l.angular_diameter_rad = x; });
    h["spot_power"] = editing(
        out,
        [](const json& v, const std::string& at) {
            return stage_choice(v, at, {"frostbite", "exact"});
        },
        [](Light& l, std::size_t i) { l.spot_power = static_cast<scene::SpotPower>(i); });
    h["limb_darkening"] = editing(out, stage_boolean, [](Light& l, bool x) { l.limb_darkening = x; });
    h["two_sided"] = editing(out, stage_boolean, [](Light& l, bool x) { l.two_sided = x; });
    h["visible"] = editing(out, stage_boolean, [](Light& l, bool x) { l.visible = x; });
    h["casts_shadow"] = editing(out, stage_boolean, [](Light& l, bool x) { l.casts_shadow = x; });
}

void add_files(Handlers& h, StageLight& out, const SearchFolders& folders) {
    h["profile"] = [&](const json& v, const std::string& at) {
        out.profile = inside_folders(folders, stage_text(v, at), at);
    };
    h["profile_scale"] = [&](const json& v, const std::string& at) {
        out.profile_scale =
            static_cast<scene::ProfileScale>(stage_choice(v, at, {"absolute", "mask", "power"}));
    };
    h["profile_multiplier"] = [&](const json& v, const std::string& at) {
        out.profile_multiplier = stage_number(v, at, 0.0, 1e12, "0 to 1e12");
    };
    h["image"] = [&](const json& v, const std::string& at) {
        out.image = inside_folders(folders, stage_text(v, at), at);
    };
}

StageLight read_entry(const json& value, const std::string& where, const SearchFolders& folders) {
    StageLight out;
    out.where = where;
    Handlers handlers;
    add_identity(handlers, out);
    add_placement(handlers, out);
    add_strength(handlers, out);
    add_shape(handlers, out);
    add_files(handlers, out, folders);
    const StageObject object(value, where, handlers);
    for (const auto& [key, unused] : value.items()) out.keys.push_back(key);
    check_entry(value, out);
    if (out.type) check_stage_light_keys(out, *out.type);
    return out;
}

}  // namespace

void check_stage_light_keys(const StageLight& light, LightType type) {
    for (const std::string& key : light.keys) {
        if (belongs(key, type)) continue;
        const bool unit = std::any_of(std::begin(kUnitKeys), std::end(kUnitKeys),
                                      [&](const UnitKey& u) { return key == u.key; });
        if (unit) {
            // With what to do instead.
            (void)scene::intensity_from({.type = type}, *light.strength, light.where + "/" + key);
        }
        throw input_error(std::string("a ") + scene::name_of(type) + " light has no " + key,
                          light.where + "/" + key);
    }
}

std::vector<StageLight> read_stage_lights(const json& value, const std::string& where,
                                          const SearchFolders& folders) {
    if (!value.is_array()) throw input_error("must be an array", where);
    std::vector<StageLight> out;
    for (std::size_t i = 0; i < value.size(); ++i)
        out.push_back(read_entry(value[i], where + "/" + std::to_string(i), folders));
    return out;
}

}  // namespace candela::io
