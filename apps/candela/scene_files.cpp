#include "scene_files.hpp"

#include <filesystem>
#include <map>

#include "candela/io/image_read.hpp"
#include "candela/io/json_position.hpp"
#include "candela/scene/error.hpp"
#include "progress_line.hpp"

namespace candela::app {
namespace {

void check(float value, float low, float high, const std::string& option, const std::string& range) {
    if (!(value >= low && value <= high)) throw Error(Fault::usage, "out of range", option, range);
}

/// Of a stage that was read a moment ago.
std::string text_of(const std::string& file) {
    const std::vector<std::byte> bytes = io::read_file(file, std::size_t{16} << 20);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

void add_scene_file_options(CLI::App& command, SceneFileOptions& o) {
    const std::map<std::string, io::GltfLightUnits> units{{"spec", io::GltfLightUnits::spec},
                                                          {"standard", io::GltfLightUnits::spec},
                                                          {"unitless", io::GltfLightUnits::unitless},
                                                          {"raw", io::GltfLightUnits::raw}};
    command.add_option("--stage", o.stage_file, "Stage file (docs/stage.md)");
    command.add_option(
        "--search", o.search_folders,
        "A folder in which the stage's files may lie, beside its own; may be given several times");
    command.add_option("--light-scale", o.light_scale, "Multiplies every light of the scene file");
    command
        .add_option_function<std::string>(
            "--light-units", [&o, units](const std::string& name) { o.light_units = units.at(name); },
            "What the scene file's punctual lights are in: spec (cd, lx; Blender's Standard), or Blender's "
            "unitless or raw")
        ->check(CLI::IsMember({"spec", "standard", "unitless", "raw"}));
    command.add_option("--time", o.time_s, "Time of the animation, skins and morph targets in s");
    command.add_option("--animation", o.animation,
                       "The animation that plays, by name or number (the first one unless told otherwise)");
    command.add_flag("--strict", o.strict,
                     "Refuse files that are drawn only with a warning, as a validator would");
    command.add_option_function<std::string>(
        "--memory", [&o](const std::string& text) { o.memory = scene::memory_from_text(text, "--memory"); },
        "Most memory that the scene may take, and its environment beside it, such as 6G (7/8 of what is "
        "free)");
}

StagedScene load_staged_scene(const SceneFileOptions& o, Diagnostics& diagnostics) {
    check(o.light_scale, 0.0f, 1e12f, "--light-scale", "0 to 1e+12");
    check(o.time_s, -1e9f, 1e9f, "--time", "-1e+09 to 1e+09");
    if (o.stage_file.empty() && !o.search_folders.empty())
        throw Error(Fault::usage, "has no effect without a stage", "--search", "--stage FILE");
    for (const std::string& folder : o.search_folders) {
        std::error_code ignored;
        if (!std::filesystem::is_directory(folder, ignored))
            throw input_error("no such folder", folder, "--search");
    }
    StagedScene out;
    ProgressLine line("loading " + std::filesystem::path(o.scene_file).filename().string());
    io::GltfOptions gltf;
    gltf.time_s = o.time_s;
    gltf.animation = o.animation;
    gltf.light_scale = o.light_scale;
    gltf.light_units = o.light_units;
    gltf.memory = o.memory;
    gltf.progress = line.steps();
    out.scene = io::load_gltf(o.scene_file, gltf, diagnostics);
    if (o.stage_file.empty()) return out;
    out.stage = io::load_stage(o.stage_file, {o.search_folders.begin(), o.search_folders.end()});
    try {
        io::place_stage_lights(out.stage.lights, out.scene, diagnostics);
        io::place_stage_probes(out.stage.probes, out.scene);
    } catch (const Error& error) {
        throw io::with_position(error, o.stage_file, text_of(o.stage_file));
    }
    return out;
}

void refuse_warnings(const SceneFileOptions& o, const Diagnostics& diagnostics) {
    const auto& warnings = diagnostics.warnings();
    if (!o.strict || warnings.empty()) return;
    const std::string more =
        warnings.size() > 1 ? " and of " + std::to_string(warnings.size() - 1) + " more warnings" : "";
    throw input_error(warnings.front().text, "", "an error because of --strict" + more);
}

}  // namespace candela::app
