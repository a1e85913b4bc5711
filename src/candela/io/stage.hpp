#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "candela/io/environment_read.hpp"
#include "candela/io/stage_lights.hpp"
#include "candela/io/stage_probes.hpp"
#include "candela/scene/diagnostics.hpp"
#include "candela/scene/scene.hpp"
#include "candela/scene/sky.hpp"

namespace candela::io {

/// What a stage file (docs/stage.schema.json) may say about the environment. `file` is resolved by
/// inside_folders().
struct StageEnvironment {
    std::string where;           ///< file and JSON pointer of `file`, for what shows when it is read
    std::filesystem::path file;  ///< as read_environment takes it; empty: sky, the built-in studio, or none
    EnvironmentOptions options;
    std::optional<scene::SkySettings> sky;
    bool keep_sun = false;  ///< a sun stays in the picture
    bool none = false;      ///< no environment at all
    float scale = 1.0f;
    float rotation_rad = 0.0f;
    std::optional<float> illuminance_lx;  ///< scale so that the up-facing illuminance is this
    bool visible = true;
};

struct StageCamera {
    std::optional<std::string> name;      ///< one of the scene's cameras
    std::optional<glm::dvec3> look_from;  ///< in the world
    std::optional<glm::dvec3> look_at;
    std::optional<float> focal_mm;
};

/// What emission in the scene's file is in: cd/m^2, a fraction of a white surface under the scene's light, or
/// whichever of the two the file seems to mean.
enum class StageUnits : std::uint8_t { automatic, absolute, relative };

struct Stage {
    std::optional<StageEnvironment> environment;
    StageCamera camera;
    std::vector<StageLight> lights;  ///< placed by place_stage_lights
    StageProbes probes;              ///< placed by place_stage_probes
    scene::Exposure exposure;
    /// What the scene file's emission is in and what multiplies it (docs/exposure.md).
    std::optional<StageUnits> units;
    std::optional<float> emissive_scale;
};

/// Reads and validates a stage file (JSON with comments). Throws Error (Fault::input) naming file,
/// line, column and pointer; unknown keys are errors with the nearest known key as hint. Files that it names
/// are read from its folder or below, and from the folders of `search` or below (inside_folders()).
[[nodiscard]] Stage load_stage(const std::filesystem::path& file,
                               const std::vector<std::filesystem::path>& search = {});

/// The picture of `file`. Throws Error (Fault::input) that names the stage's key too.
[[nodiscard]] ReadEnvironment read_stage_environment(const StageEnvironment& environment,
                                                     Diagnostics& diagnostics);

}  // namespace candela::io
