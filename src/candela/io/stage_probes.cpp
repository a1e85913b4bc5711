#include "candela/io/stage_probes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "candela/io/stage_object.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

using nlohmann::json;

constexpr double kLargest_m = 1e10;
constexpr double kSmallest_m = 1e-9;
constexpr float kDefaultFade_m = 0.25f;
/// Cells a side: what a grid of all three still holds in memory.
constexpr double kMostCells = 32;

/// What both kinds have.
struct Frame {
    float rotation_rad = 0.0f;
    [[nodiscard]] glm::mat4 world() const {
        return glm::rotate(glm::mat4(1.0f), rotation_rad, glm::vec3(0, 1, 0));
    }
};

using Handlers = std::map<std::string, StageObject::Handler>;

float distance_m(const json& v, const std::string& at) {
    return stage_number(v, at, 0.0, kLargest_m, "0 to 1e10 m");
}

glm::vec3 half_size_m(const json& v, const std::string& at) {
    return 0.5f * stage_vector(v, at, kSmallest_m, kLargest_m, "1e-9 to 1e10 m");
}

template <class Probe>
Handlers frame_handlers(Frame& frame, StageProbe<Probe>& out) {
    return {{"name", [&](const json& v, const std::string& at) { out.probe.name = stage_text(v, at); }},
            {"node", [&](const json& v, const std::string& at) { out.node = stage_text(v, at); }},
            {"center", [&](const json& v, const std::string& at) { out.center = stage_point(v, at); }},
            {"rotation_deg", [&](const json& v, const std::string& at) {
                 frame.rotation_rad =
                     stage_number(v, at, -36000.0, 36000.0, "degrees") * static_cast<float>(M_PI / 180.0);
             }}};
}

const json& array_of(const json& value, const std::string& where) {
    if (!value.is_array()) throw input_error("must be an array", where);
    return value;
}

StageProbe<scene::ReflectionProbe> read_reflection_probe(const json& value, const std::string& where) {
    StageProbe<scene::ReflectionProbe> out;
    out.where = where;
    Frame frame;
    bool box = false;
    bool sphere = false;
    std::optional<float> margin_m;
    out.probe.fade_m = kDefaultFade_m;
    Handlers h = frame_handlers(frame, out);
    h["size_m"] = [&](const json& v, const std::string& at) {
        box = true;
        out.probe.half_size_m = half_size_m(v, at);
    };
    h["radius_m"] = [&](const json& v, const std::string& at) {
        sphere = true;
        out.probe.shape = scene::ProbeShape::sphere;
        out.probe.half_size_m = glm::vec3(stage_number(v, at, kSmallest_m, kLargest_m, "1e-9 to 1e10 m"));
    };
    h["capture_offset"] = [&](const json& v, const std::string& at) {
        out.probe.capture_offset_m = stage_vector(v, at);
    };
    h["fade_m"] = [&](const json& v, const std::string& at) { out.probe.fade_m = distance_m(v, at); };
    h["margin_m"] = [&](const json& v, const std::string& at) { margin_m = distance_m(v, at); };
    const StageObject object(value, where, h);
    if (box == sphere)
        throw input_error("needs either size_m, of a box, or radius_m, of a sphere", where,
                          "\"size_m\": [4, 3, 5]");
    // Walls and floor lie on the proxy: without a word about it they reflect in full.
    out.probe.margin_m = margin_m.value_or(out.probe.fade_m);
    out.probe.world = frame.world();
    return out;
}

StageProbe<scene::IrradianceVolume> read_irradiance_volume(const json& value, const std::string& where) {
    StageProbe<scene::IrradianceVolume> out;
    out.where = where;
    Frame frame;
    bool sized = false;
    out.probe.fade_m = kDefaultFade_m;
    Handlers h = frame_handlers(frame, out);
    h["size_m"] = [&](const json& v, const std::string& at) {
        sized = true;
        out.probe.half_size_m = half_size_m(v, at);
    };
    h["cells"] = [&](const json& v, const std::string& at) {
        out.probe.cells = glm::ivec3(stage_vector(v, at, 1.0, kMostCells, "1 to 32"));
        for (const json& number : v) {
            if (!number.is_number_integer()) throw input_error("must be whole numbers", at, "[8, 6, 8]");
        }
    };
    h["fade_m"] = [&](const json& v, const std::string& at) { out.probe.fade_m = distance_m(v, at); };
    const StageObject object(value, where, h);
    if (!sized) throw input_error("needs size_m", where, "\"size_m\": [4, 3, 5]");
    out.probe.world = frame.world();
    return out;
}

template <class Probe>
Probe placed(const StageProbe<Probe>& entry, const scene::Scene& scene) {
    Probe out = entry.probe;
    const glm::vec3 center = entry.node ? glm::vec3(entry.center) : scene.frame.to_own(entry.center);
    out.world[3] = glm::vec4(center, 1.0f);
    if (!entry.node) return out;
    const auto node = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                   [&](const scene::Node& n) { return n.name == *entry.node; });
    if (node == scene.nodes.end())
        throw input_error("the scene has no node of this name: " + *entry.node, entry.where + "/node");
    out.world = scene::rigid_part(node->world) * out.world;
    // The node's scale moves what stands in its frame and does not change its size, as with lights.
    out.world[3] = node->world * glm::vec4(center, 1.0f);
    return out;
}

}  // namespace

void read_reflection_probes(const json& value, const std::string& where, StageProbes& out) {
    std::size_t i = 0;
    for (const json& entry : array_of(value, where))
        out.reflection.push_back(read_reflection_probe(entry, where + "/" + std::to_string(i++)));
}

void read_irradiance_volumes(const json& value, const std::string& where, StageProbes& out) {
    std::size_t i = 0;
    for (const json& entry : array_of(value, where))
        out.irradiance.push_back(read_irradiance_volume(entry, where + "/" + std::to_string(i++)));
}

void place_stage_probes(const StageProbes& probes, scene::Scene& scene) {
    for (const auto& entry : probes.reflection) scene.reflection_probes.push_back(placed(entry, scene));
    for (const auto& entry : probes.irradiance) scene.irradiance_volumes.push_back(placed(entry, scene));
    std::stable_sort(scene.reflection_probes.begin(), scene.reflection_probes.end(),
                     [](const auto& a, const auto& b) { return a.volume_m3() < b.volume_m3(); });
    const auto volume = [](const scene::IrradianceVolume& v) {
        return v.half_size_m.x * v.half_size_m.y * v.half_size_m.z;
    };
    std::stable_sort(scene.irradiance_volumes.begin(), scene.irradiance_volumes.end(),
                     [&](const auto& a, const auto& b) { return volume(a) < volume(b); });
}

}  // namespace candela::io
