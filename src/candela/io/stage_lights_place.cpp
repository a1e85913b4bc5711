#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "candela/io/image_read.hpp"
#include "candela/io/photometric.hpp"
#include "candela/io/stage_lights.hpp"
#include "candela/io/stage_object.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

using scene::Light;
using scene::LightType;

bool has(const StageLight& entry, const std::string& key) {
    return std::find(entry.keys.begin(), entry.keys.end(), key) != entry.keys.end();
}

const scene::Node& find_node(const StageLight& entry, const scene::Scene& scene) {
    for (const scene::Node& node : scene.nodes) {
        if (node.name == *entry.node) return node;
    }
    throw input_error("the scene has no node of this name: " + *entry.node, entry.where + "/node");
}

/// Which way is up for a light that shines along `direction`, where the file does not say.
glm::vec3 default_right(const glm::vec3& direction) {
    const float level = std::abs(direction.y);
    const glm::vec3 up = level > 0.999f ? glm::vec3(0.0f, 0.0f, direction.y) : glm::vec3(0.0f, 1.0f, 0.0f);
    return glm::normalize(glm::cross(direction, up));
}

/// `v` without its part along the unit vector `axis`.
glm::vec3 across(const glm::vec3& v, const glm::vec3& axis) {
    return v - axis * glm::dot(v, axis);
}

/// Sets position, direction and right, all in the frame of the node if there is one.
void stand(const StageLight& entry, const scene::Scene& scene, Light& light) {
    const bool aimed = entry.direction || entry.look_at;
    glm::mat4 world(1.0f);
    if (entry.node) {
        // Its own frame, which a light of the scene that moves to a node no longer has.
        world = find_node(entry, scene).world;
        light.position = glm::vec3(0.0f);
        light.direction = {0.0f, 0.0f, -1.0f};
        light.right = {1.0f, 0.0f, 0.0f};
    }
    const auto own = [&](const glm::dvec3& point) {
        return entry.node ? glm::vec3(point) : scene.frame.to_own(point);
    };
    if (entry.position)
        light.position = own(*entry.position);
    else if (!entry.node && !entry.overrides)
        light.position = own(glm::dvec3(0.0));
    if (entry.direction) light.direction = *entry.direction;
    if (entry.look_at) {
        const glm::vec3 to = own(*entry.look_at) - light.position;
        if (!(glm::length(to) > 1e-20f))
            throw input_error("the light stands where it looks", entry.where + "/look_at");
        light.direction = glm::normalize(to);
    }
    if (entry.right && !aimed) {
        // An axis alone, such as a tube's: it decides, and the light shines as nearly as before.
        light.right = *entry.right;
        const glm::vec3 rest = across(light.direction, light.right);
        light.direction = glm::length(rest) > 1e-3f ? glm::normalize(rest) : -default_right(light.right);
    } else if (entry.right) {
        const glm::vec3 rest = across(*entry.right, light.direction);
        if (!(glm::length(rest) > 1e-3f))
            throw input_error("is parallel to the direction", entry.where + "/right");
        light.right = glm::normalize(rest);
    } else if (aimed) {
        light.right = default_right(light.direction);
    }
    light.right =
        glm::normalize(light.right * std::cos(entry.roll_rad) + light.up() * std::sin(entry.roll_rad));
    if (!entry.node) return;
    const glm::mat4 turn = scene::rigid_part(world);
    light.position = glm::vec3(world * glm::vec4(light.position, 1.0f));
    light.direction = glm::normalize(glm::vec3(turn * glm::vec4(light.direction, 0.0f)));
    light.right = glm::normalize(glm::vec3(turn * glm::vec4(light.right, 0.0f)));
}

/// What a light becomes that is given a size without a word about its type.
LightType grown(const StageLight& entry, LightType type) {
    if (entry.type) return *entry.type;
    if (type == LightType::point && has(entry, "radius_m")) return LightType::sphere;
    if (type == LightType::spot && has(entry, "radius_m")) return LightType::disk;
    if (type == LightType::directional && has(entry, "angular_diameter_deg")) return LightType::sun;
    return type;
}

void check_shape(const StageLight& entry, const Light& light) {
    const bool cones = light.type == LightType::spot || (light.type == LightType::disk && light.cone);
    if (cones && light.inner_cone_rad > light.outer_cone_rad)
        throw input_error("the inner cone is wider than the outer one", entry.where);
    const bool round =
        light.type == LightType::sphere || light.type == LightType::disk || light.type == LightType::tube;
    const bool flat = light.type == LightType::rectangle;
    const bool long_one = light.type == LightType::line || light.type == LightType::tube;
    if ((round && !(light.radius_m > 0.0f)) || ((flat || long_one) && !(light.half_width_m > 0.0f)) ||
        (flat && !(light.half_height_m > 0.0f)))
        throw input_error(std::string("a ") + scene::name_of(light.type) + " light needs its size",
                          entry.where);
}

const scene::PhotometricProfile* profile_of(const Light& light, const scene::Scene& scene) {
    return light.profile == scene::no_index ? nullptr : &scene.profiles[light.profile];
}

/// A light whose type, and with it the unit, changes keeps what it gives: lm, or lx from infinitely far.
void keep_power(const StageLight& entry, const Light& before, const scene::Scene& scene, Light& light) {
    if (scene::is_distant(before.type) != scene::is_distant(light.type))
        throw input_error(std::string("a ") + scene::name_of(before.type) + " light that becomes a " +
                              scene::name_of(light.type) + " light needs a new strength",
                          entry.where, scene::accepted_units(light.type));
    if (scene::is_distant(light.type)) return;
    const scene::PhotometricProfile* profile = profile_of(before, scene);
    const float lm = profile ? before.intensity * static_cast<float>(scene::integrated_lm(*profile))
                             : scene::power_lm(before).value_or(0.0f);
    light.intensity = scene::intensity_from(light, {lm, scene::LightUnit::lumen}, entry.where);
}

void set_strength(const StageLight& entry, const Light& before, const scene::Scene& scene, Light& light) {
    const scene::PhotometricProfile* profile = profile_of(light, scene);
    if (entry.strength) {
        const scene::LightStrength& strength = *entry.strength;
        const bool cd = strength.unit == scene::LightUnit::candela;
        const auto scale =
            entry.profile_scale.value_or(cd ? scene::ProfileScale::mask : scene::ProfileScale::power);
        light.intensity = profile ? scene::profile_factor_from(light, *profile, scale, strength, entry.where)
                                  : scene::intensity_from(light, strength, entry.where);
        light.unit = strength.unit;
        light.efficacy_lm_per_w = strength.efficacy_lm_per_w;
    } else if (!entry.profile.empty() || has(entry, "profile_multiplier")) {
        light.intensity = entry.profile_multiplier;
        light.unit = scene::LightUnit::candela;
        light.efficacy_lm_per_w = 0.0f;
    } else if (light.type != before.type && !profile) {
        keep_power(entry, before, scene, light);
    }
}

/// Files that several lights name are read once.
class Files {
  public:
    Files(scene::Scene& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {}

    std::uint32_t profile(const std::filesystem::path& file) {
        const auto [entry, fresh] = profiles_.try_emplace(file, 0u);
        if (fresh) {
            scene_.profiles.push_back(load_photometric(file, diagnostics_));
            entry->second = static_cast<std::uint32_t>(scene_.profiles.size() - 1);
        }
        return entry->second;
    }

    std::uint32_t image(const std::filesystem::path& file) {
        const auto [entry, fresh] = images_.try_emplace(file, 0u);
        if (fresh) {
            scene_.images.push_back(decode_image(read_file(file, kMaxImageBytes), file.string()));
            scene_.images.back().name = file.filename().string();
            entry->second = static_cast<std::uint32_t>(scene_.images.size() - 1);
        }
        return entry->second;
    }

  private:
    static constexpr std::size_t kMaxImageBytes = std::size_t{1} << 30;
    scene::Scene& scene_;
    Diagnostics& diagnostics_;
    std::map<std::filesystem::path, std::uint32_t> profiles_;
    std::map<std::filesystem::path, std::uint32_t> images_;
};

void apply(const StageLight& entry, const scene::Scene& scene, Files& files, Light& light) {
    const Light before = light;
    light.type = grown(entry, light.type);
    // A disk takes over from a spot, cones and all, as in Frostbite.
    if (before.type == LightType::spot && light.type == LightType::disk && !entry.type) light.cone = true;
    for (const auto& edit : entry.edits) edit(light);
    check_stage_light_keys(entry, light.type);
    check_shape(entry, light);
    stand(entry, scene, light);
    light.carrier += light.carrier.empty() ? "stage" : ", stage";
    if (light.type != LightType::point && light.type != LightType::spot) light.profile = scene::no_index;
    if (light.type != LightType::rectangle) light.image = scene::no_index;
    if (!entry.profile.empty())
        light.profile =
            read_stage_file(entry.where + "/profile", [&] { return files.profile(entry.profile); });
    if (!entry.image.empty())
        light.image = read_stage_file(entry.where + "/image", [&] { return files.image(entry.image); });
    for (const char* key : {"profile_multiplier", "profile_scale"}) {
        if (has(entry, key) && light.profile == scene::no_index)
            throw input_error("the light has no profile", entry.where + "/" + key);
    }
    set_strength(entry, before, scene, light);
}

void override_lights(const StageLight& entry, scene::Scene& scene, Files& files) {
    const auto named = [&](const Light& light) { return light.name == *entry.overrides; };
    std::string known;
    std::size_t nameless = 0;
    for (const Light& light : scene.lights) {
        nameless += light.name.empty() ? 1 : 0;
        if (!light.name.empty()) known += (known.empty() ? "" : ", ") + light.name;
    }
    if (nameless > 0) known += (known.empty() ? "" : ", ") + std::to_string(nameless) + " without a name";
    if (std::none_of(scene.lights.begin(), scene.lights.end(), named))
        throw input_error("the scene has no light of this name: " + *entry.overrides,
                          entry.where + "/override", known.empty() ? "it has no lights" : "it has " + known);
    if (entry.off) {
        scene.lights.erase(std::remove_if(scene.lights.begin(), scene.lights.end(), named),
                           scene.lights.end());
        return;
    }
    for (Light& light : scene.lights) {
        if (named(light)) apply(entry, scene, files, light);
    }
}

}  // namespace

void place_stage_lights(const std::vector<StageLight>& lights, scene::Scene& scene,
                        Diagnostics& diagnostics) {
    Files files(scene, diagnostics);
    for (const StageLight& entry : lights) {
        if (entry.overrides) {
            override_lights(entry, scene, files);
            continue;
        }
        Light light;
        apply(entry, scene, files, light);
        scene.lights.push_back(light);
    }
}

}  // namespace candela::io
