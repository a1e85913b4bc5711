#include <algorithm>
#include <cmath>

#include "candela/io/gltf_write_parts.hpp"
#include "candela/io/ies_write.hpp"
#include "candela/scene/light_units.hpp"

namespace candela::io {
namespace {

using nlohmann::json;
using scene::Light;
using scene::LightType;

glm::mat4 world_of(const Light& light) {
    return {glm::vec4(light.right, 0.0f), glm::vec4(light.up(), 0.0f), glm::vec4(-light.direction, 0.0f),
            glm::vec4(light.position, 1.0f)};
}

class LightWriter {
  public:
    LightWriter(const scene::Scene& scene, GltfFile& file, Diagnostics& diagnostics)
        : scene_(scene), file_(file), diagnostics_(diagnostics) {}

    void write(const Light& light) {
        warn_of_the_rest(light);
        if (light.profile != scene::no_index) {
            write_profile(light);
        } else if (light.type == LightType::rectangle || light.type == LightType::disk) {
            write_area(light);
            if (light.two_sided) write_area(back_of(light));
        } else {
            write_punctual(punctual(light));
        }
    }

  private:
    void cannot(const Light& light, const std::string& what) {
        diagnostics_.warn("glTF cannot carry " + what + ": light " + light.name);
    }

    void warn_of_the_rest(const Light& light) {
        if (!light.casts_shadow) cannot(light, "a light without shadow");
        if (scene::has_extent(light.type) && light.type != LightType::sun && !light.visible)
            cannot(light, "an invisible light of a size");
        if (light.image != scene::no_index) cannot(light, "an image on a light");
        if (light.type == LightType::disk && light.cone) cannot(light, "the cones of a disk");
        const bool area = light.type == LightType::rectangle || light.type == LightType::disk;
        const bool alone = light.profile != scene::no_index && light.type == LightType::point;
        if ((area || alone) && std::isfinite(light.range_m)) cannot(light, "the range of such a light");
    }

    /// What KHR_lights_punctual has that comes nearest.
    Light punctual(const Light& light) {
        Light out = light;
        switch (light.type) {
            case LightType::sun:
                cannot(light, "the sun's size (written as a directional light)");
                out.type = LightType::directional;
                break;
            case LightType::sphere:
            case LightType::tube:
            case LightType::line:
                cannot(light, std::string("a ") + scene::name_of(light.type) +
                                  " light (written as a point light of the same power)");
                out.type = LightType::point;
                out.intensity = scene::intensity_from(
                    out, {scene::power_lm(light).value_or(0.0f), scene::LightUnit::lumen}, light.name);
                break;
            case LightType::frustum:
                cannot(light, "a frustum light (written as a spot around it)");
                out.type = LightType::spot;
                out.outer_cone_rad = cone_around(light);
                out.inner_cone_rad = out.outer_cone_rad;
                break;
            default:
                break;
        }
        return out;
    }

    /// Half angle of the cone through the corners of the pyramid.
    static float cone_around(const Light& light) {
        return std::atan(std::hypot(std::tan(0.5f * light.horizontal_angle_rad),
                                    std::tan(0.5f * light.vertical_angle_rad)));
    }

    static Light back_of(const Light& light) {
        Light back = light;
        back.name += " (back)";
        back.direction = -light.direction;
        back.right = -light.right;
        return back;
    }

    json& list(const char* extension) {
        file_.declare(extension);
        return file_.document["extensions"][extension]["lights"];
    }

    /// Colour within 1 and the rest of it as a factor on the strength.
    static float color_and_factor(const Light& light, json& out) {
        const float factor = covering_power_of_two(std::max({light.color.x, light.color.y, light.color.z}));
        if (light.color != glm::vec3(1.0f)) out["color"] = to_json(light.color / factor);
        return factor;
    }

    json node_of(const Light& light) { return node_json(light.name, scene_.frame.to_world(world_of(light))); }

    std::size_t add_punctual(const Light& light) {
        json out{{"type", scene::name_of(light.type)}};
        if (!light.name.empty()) out["name"] = light.name;
        out["intensity"] = light.intensity * color_and_factor(light, out);
        if (std::isfinite(light.range_m) && !scene::is_distant(light.type)) out["range"] = light.range_m;
        // The specification wants the inner cone narrower, be it by one digit.
        if (light.type == LightType::spot)
            out["spot"] = {{"innerConeAngle",
                            std::min(light.inner_cone_rad, std::nextafter(light.outer_cone_rad, 0.0f))},
                           {"outerConeAngle", light.outer_cone_rad}};
        json& lights = list("KHR_lights_punctual");
        lights.push_back(std::move(out));
        return lights.size() - 1;
    }

    void write_punctual(const Light& light) {
        json node = node_of(light);
        node["extensions"]["KHR_lights_punctual"]["light"] = add_punctual(light);
        file_.add_root(std::move(node));
    }

    void write_area(const Light& light) {
        const bool rect = light.type == LightType::rectangle;
        json out{{"type", rect ? "rect" : "disk"}};
        if (!light.name.empty()) out["name"] = light.name;
        out["intensity"] = light.intensity * color_and_factor(light, out);
        out["size"] = 2.0f * (rect ? light.half_height_m : light.radius_m);
        if (rect)
            out["rect"]["aspect"] =
                static_cast<double>(light.half_width_m) / static_cast<double>(light.half_height_m);
        json& lights = list("EXT_lights_area");
        lights.push_back(std::move(out));
        json node = node_of(light);
        node["extensions"]["EXT_lights_area"]["light"] = lights.size() - 1;
        file_.add_root(std::move(node));
    }

    std::size_t profile(std::uint32_t index) {
        const auto [entry, fresh] = profiles_.try_emplace(index, 0u);
        if (fresh) {
            const scene::PhotometricProfile& source = scene_.profiles[index];
            const std::string text = ies_text(source);
            json out{{"bufferView", file_.add_view(std::as_bytes(std::span(text.data(), text.size())))},
                     {"mimeType", "application/x-ies-lm-63"}};
            if (!source.name.empty()) out["name"] = source.name;
            json& lights = list("EXT_lights_ies");
            lights.push_back(std::move(out));
            entry->second = lights.size() - 1;
        }
        return entry->second;
    }

    /// A spot's cones around a profile go beside it: the reader makes one light of the two.
    void write_profile(const Light& light) {
        json use{{"light", profile(light.profile)}};
        const float factor = color_and_factor(light, use);
        if (light.intensity * factor != 1.0f) use["multiplier"] = light.intensity * factor;
        json node = node_of(light);
        node["extensions"]["EXT_lights_ies"] = use;
        if (light.type == LightType::spot) {
            Light bare = light;
            bare.intensity *= static_cast<float>(scene::peak(scene_.profiles[light.profile]).candela);
            node["extensions"]["KHR_lights_punctual"]["light"] = add_punctual(bare);
        }
        file_.add_root(std::move(node));
    }

    const scene::Scene& scene_;
    GltfFile& file_;
    Diagnostics& diagnostics_;
    std::map<std::uint32_t, std::size_t> profiles_;
};

}  // namespace

void write_lights(const scene::Scene& scene, GltfFile& file, Diagnostics& diagnostics) {
    LightWriter writer(scene, file, diagnostics);
    for (const Light& light : scene.lights) writer.write(light);
}

}  // namespace candela::io
