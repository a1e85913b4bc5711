#include "probe_info.hpp"

#include <cmath>
#include <cstdio>

namespace candela::app {
namespace {

using nlohmann::json;

constexpr double kDegPerRad = 180.0 / M_PI;

json vector_json(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// Of the frame's Z axis about +Y, as a stage says it; a node may tilt the frame besides.
double turn_deg(const glm::mat4& world) {
    return kDegPerRad * std::atan2(double{world[2].x}, double{world[2].z});
}

std::string text_of(const json& numbers, const char* between) {
    std::string out;
    for (const json& number : numbers) {
        char text[32];
        std::snprintf(text, sizeof(text), "%.4g", number.get<double>());
        out += (out.empty() ? "" : between) + std::string(text);
    }
    return out;
}

std::string number_text(const json& number) {
    return text_of(json::array({number}), "");
}

std::string place_text(const json& p) {
    std::string out = " at " + text_of(p["center"], ", ") + " m";
    if (std::abs(p["rotation_deg"].get<double>()) > 1e-3)
        out += ", turned " + number_text(p["rotation_deg"]) + " deg";
    return out;
}

std::string name_text(const json& p) {
    const auto name = p["name"].get<std::string>();
    return name.empty() ? "(without a name)" : name;
}

}  // namespace

json probe_json(const scene::ReflectionProbe& probe, const scene::WorldFrame& frame) {
    json out{{"name", probe.name},
             {"center", vector_json(frame.to_world(glm::vec3(probe.world[3])))},
             {"rotation_deg", turn_deg(probe.world)},
             {"capture_position", vector_json(frame.to_world(probe.capture_position()))},
             {"margin_m", probe.margin_m},
             {"fade_m", probe.fade_m}};
    if (probe.shape == scene::ProbeShape::sphere)
        out["radius_m"] = probe.half_size_m.x;
    else
        out["size_m"] = vector_json(2.0f * probe.half_size_m);
    return out;
}

json volume_json(const scene::IrradianceVolume& volume, const scene::WorldFrame& frame) {
    return {{"name", volume.name},
            {"center", vector_json(frame.to_world(glm::vec3(volume.world[3])))},
            {"rotation_deg", turn_deg(volume.world)},
            {"size_m", vector_json(2.0f * volume.half_size_m)},
            {"cells", {volume.cells.x, volume.cells.y, volume.cells.z}},
            {"spacing_m", vector_json(volume.spacing_m())},
            {"fade_m", volume.fade_m}};
}

std::string probe_line(const json& p) {
    const std::string shape = p.contains("radius_m") ? "sphere of " + number_text(p["radius_m"]) + " m"
                                                     : "box of " + text_of(p["size_m"], " x ") + " m";
    return "  reflection probe " + name_text(p) + ": " + shape + place_text(p) + ", picture from " +
           text_of(p["capture_position"], ", ") + " m";
}

std::string volume_line(const json& v) {
    return "  irradiance volume " + name_text(v) + ": " + text_of(v["size_m"], " x ") + " m" + place_text(v) +
           ", " + text_of(v["cells"], " x ") + " probes, " + text_of(v["spacing_m"], " x ") + " m apart";
}

}  // namespace candela::app
