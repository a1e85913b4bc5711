#include "candela/io/gltf_lights.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "candela/io/photometric.hpp"
#include "shading/photometry.glsl"

namespace candela::io {
namespace {

/// The sun's disc has 1.6e9 cd/m^2; what is far beyond overflows when it is squared.
constexpr float kBrightest = 1e15f;
constexpr const char* kIesMime = "application/x-ies-lm-63";

scene::Light standing(const Node& posed) {
    scene::Light light;
    const glm::mat4 place = scene::rigid_part(posed.world);
    light.position = glm::vec3(place[3]);
    light.direction = -glm::vec3(place[2]);
    light.right = glm::vec3(place[0]);
    return light;
}

glm::vec3 read_color(const JsonView& value) {
    std::array<float, 3> color{1.0f, 1.0f, 1.0f};
    value.leading_floats(color);
    return glm::max(glm::vec3(color[0], color[1], color[2]), glm::vec3(0.0f));
}

/// From what the exporter wrote to cd or lx. The factors undo the lighting modes of Blender's exporter
/// (glTF-Blender-IO, exp/lights.py): its unit is W of 555 nm light, of which 683 lm are one, and W/m^2 for
/// suns.
float unit_factor(GltfLightUnits units, scene::LightType type) {
    constexpr float lm_per_w = shading::kMaxLuminousEfficacy;
    switch (units) {
        case GltfLightUnits::spec:
            return 1.0f;
        case GltfLightUnits::unitless:
            return lm_per_w;
        case GltfLightUnits::raw:
            return type == scene::LightType::directional ? lm_per_w : lm_per_w / (4.0f * glm::pi<float>());
    }
    return 1.0f;
}

float positive(const JsonView& value, float fallback) {
    const float x = value.float_or(fallback);
    if (x > 0.0f) return x;
    value.repaired("must be greater than 0: read as absent");
    return fallback;
}

float intensity(const JsonView& source, float fallback) {
    const float x = source["intensity"].float_or(fallback);
    if (x < 0.0f) source["intensity"].repaired("is negative: read as 0");
    return x;
}

/// The largest component of the absolute value of the node's scale in the world.
float largest_scale(const glm::mat4& world) {
    const auto length = [&](int column) { return glm::length(glm::vec3(world[column])); };
    return std::max({length(0), length(1), length(2)});
}

}  // namespace

void GltfLights::add_punctual(const JsonView& source, const Node& posed, scene::Scene& scene) const {
    scene::Light light = standing(posed);
    light.name = source["name"].string_or(posed.name);
    const std::string type = source["type"].one_of({"point", "spot", "directional"}, false);
    if (type.empty()) return;
    if (type == "spot") light.type = scene::LightType::spot;
    if (type == "directional") {
        light.type = scene::LightType::directional;
        light.unit = scene::LightUnit::lux;
    }
    light.carrier = "KHR_lights_punctual";
    light.color = read_color(source["color"]);
    const float factor = options_.light_scale * unit_factor(options_.light_units, light.type);
    light.intensity = std::clamp(intensity(source, 1.0f) * factor, 0.0f, kBrightest);
    if (const float range_m = source["range"].float_or(0.0f); range_m > 0.0f) light.range_m = range_m;
    const JsonView spot = source["spot"];
    if (spot["innerConeAngle"].float_or(0.0f) > spot["outerConeAngle"].float_or(0.7853982f))
        spot.repaired("has an inner cone wider than the outer one: the outer one is widened");
    light.inner_cone_rad = std::clamp(spot["innerConeAngle"].float_or(0.0f), 0.0f, 1.5707963f);
    light.outer_cone_rad =
        std::clamp(spot["outerConeAngle"].float_or(0.7853982f), light.inner_cone_rad, 1.5707963f);
    scene.lights.push_back(light);
}

void GltfLights::add_area(const JsonView& source, const Node& posed, scene::Scene& scene) const {
    scene::Light light = standing(posed);
    light.name = source["name"].string_or(posed.name);
    const float size_m = positive(source["size"], 1.0f) * largest_scale(posed.world);
    const std::string type = source["type"].one_of({"rect", "disk"});
    if (type == "rect") {
        light.type = scene::LightType::rectangle;
        light.half_width_m = 0.5f * size_m * positive(source["rect"]["aspect"], 1.0f);
        light.half_height_m = 0.5f * size_m;
    } else {
        light.type = scene::LightType::disk;
        light.radius_m = 0.5f * size_m;
    }
    const float largest_m = std::max({light.radius_m, light.half_width_m, light.half_height_m});
    if (!std::isfinite(largest_m) || !(size_m > 0.0f)) {
        diagnostics_.warn("an area light without a size, or of one that is not finite: skipped");
        return;
    }
    light.carrier = "EXT_lights_area";
    light.unit = scene::LightUnit::nit;
    light.color = read_color(source["color"]);
    light.intensity = std::clamp(intensity(source, 1000.0f) * options_.light_scale, 0.0f, kBrightest);
    scene.lights.push_back(light);
}

scene::PhotometricProfile GltfLights::read_profile(const JsonView& source) const {
    const JsonView uri = source["uri"];
    const JsonView view = source["bufferView"];
    const JsonView mime = source["mimeType"];
    if (!uri.exists() && !view.exists()) source.fail("needs a uri or a bufferView");
    if (uri.exists() && view.exists()) source.repaired("has a uri and a bufferView: the uri is read");
    if (view.exists() && !mime.exists())
        source.repaired(std::string("needs a mimeType: read as ") + kIesMime);
    if (mime.string_or(kIesMime) != kIesMime)
        mime.repaired(std::string("is not the type of IES files: read as ") + kIesMime);
    const std::filesystem::path folder = document_.folder().value_or(std::filesystem::path());
    scene::PhotometricProfile profile;
    if (uri.exists()) {
        const std::vector<std::byte> bytes =
            document_.read_uri(uri.string_or(""), uri.where(), document_.warnings());
        profile = load_photometric_from_memory(bytes, uri.where(), folder, diagnostics_);
    } else {
        const std::uint32_t at = view.required_index_below(document_.count("bufferViews"));
        profile = load_photometric_from_memory(document_.buffer_view(at), view.where(), folder, diagnostics_);
    }
    if (const std::string name = source["name"].string_or(""); !name.empty()) profile.name = name;
    return profile;
}

std::optional<std::uint32_t> GltfLights::profile(const JsonView& use, scene::Scene& scene) {
    const JsonView list = document_.root()["extensions"]["EXT_lights_ies"]["lights"];
    const auto index = use["light"].index_below(list.size());
    if (!index) return std::nullopt;
    const auto known = profiles_.find(*index);
    if (known != profiles_.end()) return known->second;
    const JsonView source = list[*index];
    if (const JsonView uri = source["uri"]; uri.exists()) document_.check_uri(uri.string_or(""), uri.where());
    std::optional<std::uint32_t> out;
    document_.try_to_read(source, "the light is drawn without it", [&] {
        scene.profiles.push_back(read_profile(source));
        out = static_cast<std::uint32_t>(scene.profiles.size() - 1);
    });
    profiles_.emplace(*index, out);
    return out;
}

void GltfLights::add_profile(const JsonView& use, const Node& posed, scene::Light* punctual,
                             scene::Scene& scene) {
    const auto index = profile(use, scene);
    if (!index) return;
    scene::Light light = punctual ? *punctual : standing(posed);
    light.carrier += punctual ? ", EXT_lights_ies" : "EXT_lights_ies";
    light.profile = *index;
    light.intensity = std::clamp(use["multiplier"].float_or(1.0f) * options_.light_scale, 0.0f, kBrightest);
    if (use["color"].exists() || !punctual) light.color = glm::min(read_color(use["color"]), glm::vec3(1.0f));
    if (!punctual) light.name = posed.name.empty() ? scene.profiles[*index].name : posed.name;
    if (punctual) {
        *punctual = light;
    } else {
        scene.lights.push_back(light);
    }
}

void GltfLights::add(const JsonView& node, const Node& posed, scene::Scene& scene) {
    const JsonView uses = node["extensions"];
    if (!uses.exists()) return;
    const JsonView lists = document_.root()["extensions"];
    const JsonView punctual = lists["KHR_lights_punctual"]["lights"];
    const std::size_t before = scene.lights.size();
    if (const auto light = uses["KHR_lights_punctual"]["light"].index_below(punctual.size()))
        add_punctual(punctual[*light], posed, scene);
    if (const JsonView use = uses["EXT_lights_ies"]; use.exists()) {
        const bool shaped =
            scene.lights.size() > before && scene.lights.back().type != scene::LightType::directional;
        add_profile(use, posed, shaped ? &scene.lights.back() : nullptr, scene);
    }
    const JsonView area = lists["EXT_lights_area"]["lights"];
    if (const auto light = uses["EXT_lights_area"]["light"].index_below(area.size()))
        add_area(area[*light], posed, scene);
}

}  // namespace candela::io
