#include <array>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "candela/bake/environment.hpp"
#include "candela/scene/error.hpp"
#include "candela/scene/printable.hpp"
#include "candela/scene/strokes.hpp"
#include "candela/version.hpp"
#include "command.hpp"
#include "emission_units.hpp"
#include "job.hpp"
#include "light_info.hpp"
#include "option_rules.hpp"
#include "probe_info.hpp"

namespace candela::app {
namespace {

using nlohmann::json;

const char* kind_name(gpu::DeviceKind kind) {
    switch (kind) {
        case gpu::DeviceKind::discrete:
            return "discrete GPU";
        case gpu::DeviceKind::integrated:
            return "integrated GPU";
        case gpu::DeviceKind::virtual_gpu:
            return "virtual GPU";
        case gpu::DeviceKind::cpu:
            return "CPU";
        default:
            return "other";
    }
}

json devices_json() {
    json list = json::array();
    for (const gpu::DeviceInfo& d : gpu::list_devices()) {
        list.push_back({{"index", d.index},
                        {"name", d.name},
                        {"driver", d.driver},
                        {"kind", kind_name(d.kind)},
                        {"usable", d.usable}});
        if (!d.usable) list.back()["why_not"] = d.why_unusable;
    }
    return list;
}

json scene_json(const JobOptions& options) {
    Job job;
    StagedScene staged = load_staged_scene(options, job.diagnostics);
    refuse_warnings(options, job.diagnostics);
    job.scene = std::move(staged.scene);
    // What a picture would have in its place, the studio, is not in the scene.
    if (!options.environment.empty() || staged.stage.environment)
        set_environment(options, staged.stage, job);
    else {
        refuse_options_of_no_environment(options, "the scene");
        set_emission_units(options, staged.stage, !job.scene.environment && job.scene.lights.empty(), job);
    }
    const scene::Scene& scene = job.scene;
    json out{{"file", options.scene_file},
             {"triangles", scene::triangle_count(scene)},
             {"points", scene::count_strokes(scene).points},
             {"line_segments", scene::count_strokes(scene).segments},
             {"meshes", scene.meshes.size()},
             {"instances", scene.instances.size()}};
    for (const char* list :
         {"materials", "lights", "emissive_surfaces", "reflection_probes", "irradiance_volumes", "cameras"})
        out[list] = json::array();
    const scene::Aabb bounds = scene::world_bounds(scene);
    if (!bounds.empty()) {
        const glm::dvec3 low = scene.frame.to_world(bounds.min), high = scene.frame.to_world(bounds.max);
        out["bounds_m"] = {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
    }
    for (const scene::Material& m : scene.materials) out["materials"].push_back(m.name);
    for (const scene::Light& light : scene.lights) out["lights"].push_back(light_json(light, scene));
    for (const auto& surface : realtime::emissive_surfaces(scene))
        out["emissive_surfaces"].push_back(emissive_json(surface, scene));
    for (const auto& probe : scene.reflection_probes)
        out["reflection_probes"].push_back(probe_json(probe, scene.frame));
    for (const auto& volume : scene.irradiance_volumes)
        out["irradiance_volumes"].push_back(volume_json(volume, scene.frame));
    for (const scene::Camera& camera : scene.cameras) out["cameras"].push_back(camera.name);
    if (scene.environment) {
        const scene::Environment& e = *scene.environment;
        out["environment"] = {{"name", e.name},
                              {"width", e.width},
                              {"height", e.height},
                              {"upward_illuminance_lx", bake::upward_illuminance_lx(e)}};
    }
    std::size_t texture_texels = 0;
    for (const scene::Image& image : scene.images) texture_texels += std::size_t{image.width} * image.height;
    out["units"] = emission_units_json(job.emission);
    out["images"] = scene.images.size();
    out["image_texels"] = texture_texels;
    out["warnings"] = warnings_json(job.diagnostics);
    return out;
}

void print_scene(const json& s) {
    std::printf("%s: %zu triangles, %zu meshes, %zu instances, %zu materials, %zu images\n",
                printable(s["file"].get<std::string>()).c_str(), s["triangles"].get<std::size_t>(),
                s["meshes"].get<std::size_t>(), s["instances"].get<std::size_t>(), s["materials"].size(),
                s["images"].get<std::size_t>());
    if (s["points"] != 0 || s["line_segments"] != 0)
        std::printf("  strokes  %zu points, %zu line segments\n", s["points"].get<std::size_t>(),
                    s["line_segments"].get<std::size_t>());
    if (s.contains("bounds_m")) {
        const auto b = s["bounds_m"].get<std::array<std::array<double, 3>, 2>>();
        std::printf("  bounds   %.7g, %.7g, %.7g to %.7g, %.7g, %.7g m\n", b[0][0], b[0][1], b[0][2], b[1][0],
                    b[1][1], b[1][2]);
    }
    for (const json& camera : s["cameras"])
        std::printf("  camera   %s\n", printable(camera.get<std::string>()).c_str());
    for (const json& light : s["lights"]) {
        for (const std::string& line : light_lines(light)) std::printf("%s\n", printable(line).c_str());
    }
    for (const json& surface : s["emissive_surfaces"]) {
        for (const std::string& line : emissive_lines(surface)) std::printf("%s\n", printable(line).c_str());
    }
    for (const json& probe : s["reflection_probes"])
        std::printf("%s\n", printable(probe_line(probe)).c_str());
    for (const json& volume : s["irradiance_volumes"])
        std::printf("%s\n", printable(volume_line(volume)).c_str());
    if (s.contains("environment")) {
        const json& e = s["environment"];
        std::printf("  environment %s, %ux%u, %.6g lx on an up-facing plane\n",
                    printable(e["name"].get<std::string>()).c_str(), e["width"].get<unsigned>(),
                    e["height"].get<unsigned>(), e["upward_illuminance_lx"].get<double>());
    }
    for (const json& w : s["warnings"]) {
        std::printf("  warning  %s (%zu)\n", printable(w["text"].get<std::string>()).c_str(),
                    w["count"].get<std::size_t>());
    }
}

int info(const JobOptions& options) {
    json out{{"version", version()}};
    if (options.scene_file.empty()) {
        out["devices"] = devices_json();
    } else {
        out["scene"] = scene_json(options);
    }
    if (options.json) {
        std::printf("%s\n", out.dump(2, ' ', false, json::error_handler_t::replace).c_str());
        return 0;
    }
    std::printf("candela %s\n", version());
    if (out.contains("scene")) print_scene(out["scene"]);
    for (const json& d : out.value("devices", json::array())) {
        std::printf("  device %u  %s, %s, %s%s\n", d["index"].get<unsigned>(),
                    d["name"].get<std::string>().c_str(), d["driver"].get<std::string>().c_str(),
                    d["kind"].get<std::string>().c_str(),
                    d["usable"].get<bool>() ? "" : (": " + d["why_not"].get<std::string>()).c_str());
    }
    return 0;
}

}  // namespace

void add_info(CLI::App& app, Action& action) {
    auto options = std::make_shared<JobOptions>();
    CLI::App* command = app.add_subcommand("info", "What is in a scene; without one, the devices");
    command->add_option("SCENE", options->scene_file, "A .gltf or .glb file");
    add_environment_options(*command, *options);
    add_scene_file_options(*command, *options);
    command->add_flag("--json", options->json, "Print one JSON object on standard output");
    command->callback([options, command, &action] {
        check_environment_options(*command, *options);
        if (options->scene_file.empty())
            refuse_without_effect(*command,
                                  {"--env", "--env-scale", "--env-lux", "--env-rotate", "--env-visible",
                                   "--env-hidden", "--env-keep-sun", "--stage", "--light-scale",
                                   "--light-units", "--time", "--animation", "--strict", "--memory"},
                                  "without a scene", "candela info SCENE.glb");
        action = [options] { return info(*options); };
    });
}

}  // namespace candela::app
