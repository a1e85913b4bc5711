#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "candela/io/gltf.hpp"
#include "candela/io/stage.hpp"

namespace candela::app {

/// What every command that reads a scene has: the file, how its lights are meant, and the stage.
struct SceneFileOptions {
    std::string scene_file;
    std::string stage_file;
    std::vector<std::string> search_folders;  ///< where the stage may find files beside its own folder
    float light_scale = 1.0f;
    io::GltfLightUnits light_units = io::GltfLightUnits::spec;
    float time_s = 0.0f;
    std::string animation;
    bool strict = false;
    std::optional<scene::MemoryBudget> memory;  ///< absent: what the machine has left
};

void add_scene_file_options(CLI::App& command, SceneFileOptions& options);

struct StagedScene {
    scene::Scene scene;  ///< with the stage's lights; its environment, camera and exposure are in `stage`
    io::Stage stage;
};

/// Throws Error for numbers that no scene means, and for what is wrong with the files.
[[nodiscard]] StagedScene load_staged_scene(const SceneFileOptions& options, Diagnostics& diagnostics);

/// With --strict what the files needed warnings for is an error. Throws Error (Fault::input).
void refuse_warnings(const SceneFileOptions& options, const Diagnostics& diagnostics);

}  // namespace candela::app
