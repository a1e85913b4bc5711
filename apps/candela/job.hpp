#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "candela/gpu/device.hpp"
#include "candela/realtime/renderer.hpp"
#include "candela/scene/diagnostics.hpp"
#include "candela/scene/scene.hpp"
#include "environment_option.hpp"
#include "scene_files.hpp"
#include "shadow_option.hpp"

namespace candela::app {

/// What `render`, `bench` and `info` have in common: a scene on a stage, before any device is touched.
struct JobOptions : SceneFileOptions {
    std::string environment;  ///< file, "studio", "none", or empty: what stage and scene say
    std::optional<float> env_scale;
    std::optional<float> env_rotate_deg;
    std::optional<float> env_lux;
    std::optional<bool> env_visible;
    EnvironmentFileOptions env_file;
    bool env_keep_sun = false;
    std::optional<std::string> units;  ///< of the scene file's emission: auto, absolute or relative
    std::optional<float> emissive_scale;
    std::string size = "1280x720";
    float line_width_px = 1.0f;
    std::optional<std::uint32_t> width;
    std::optional<std::uint32_t> height;
    std::string camera;
    std::vector<double> look_from;
    std::vector<double> look_at;
    std::optional<float> focal_mm;
    std::optional<float> aperture_f;
    std::optional<std::string> shutter_s;  ///< "0.008" or "1/125"
    std::optional<float> iso;
    std::optional<float> ev100;
    bool auto_exposure = false;
    std::optional<float> exposure_compensation;
    std::string profile = "best";
    std::string tonemap = "neutral";
    ShadowRequestOptions shadows;
    std::string device = "auto";
    bool validation = false;
    std::uint32_t seed = 0;
    bool json = false;
};

/// --env and what goes with it.
void add_environment_options(CLI::App& command, JobOptions& options);
/// Those and the scene's files.
void add_scene_options(CLI::App& command, JobOptions& options);
void add_picture_options(CLI::App& command, JobOptions& options);
void add_device_options(CLI::App& command, JobOptions& options);

/// What contradicts or could have no effect, refused while parsing, before a file is opened. Throws Error
/// (Fault::usage), as all of these.
void check_environment_options(const CLI::App& command, const JobOptions& options);
/// How a file is read says nothing about an environment that is none.
void check_environment_reading(const CLI::App& command, const std::string& environment);
void check_picture_options(const CLI::App& command);
void check_shadow_options(const CLI::App& command, const ShadowRequestOptions& options,
                          const std::string& mode);
/// `where` is what turned out to have no environment.
void refuse_options_of_no_environment(const JobOptions& options, const std::string& where);

/// What an emission of 1 in the scene file is.
struct EmissionUnits {
    bool relative = false;  ///< to a white surface under the scene's light
    float nit_per_unit = 1.0f;
};

struct Job {
    scene::Scene scene;
    scene::Camera camera;
    scene::Exposure exposure;
    realtime::Profile profile;
    EmissionUnits emission;  ///< already applied to the scene's materials
    std::uint32_t tone_curve = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    Diagnostics diagnostics;
};

/// Puts the environment that the command line asks for into the job's scene, else the stage's, else the
/// studio where nothing else gives light; a sky with its sun; then decides what the scene's emission is in
/// (emission_units.hpp). Throws Error.
void set_environment(const JobOptions& options, const io::Stage& stage, Job& job);

/// Loads and stages the scene; one that brings neither lights nor an environment gets the built-in studio, in
/// every mode, so that their pictures can be compared. Throws Error.
[[nodiscard]] Job prepare(const JobOptions& options);

[[nodiscard]] gpu::DeviceOptions device_options(const JobOptions& options);

/// Prints each warning once, with its count, to standard error.
void print_warnings(const Diagnostics& diagnostics);
[[nodiscard]] nlohmann::json warnings_json(const Diagnostics& diagnostics);
[[nodiscard]] nlohmann::json pass_times_json(const std::vector<gpu::PassTime>& times);
[[nodiscard]] std::string device_line(const gpu::DeviceInfo& info);

}  // namespace candela::app
