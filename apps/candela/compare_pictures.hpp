#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "candela/measure/comparison.hpp"
#include "candela/measure/light_paths.hpp"
#include "job.hpp"

namespace candela::app {

using Settings = std::vector<std::pair<std::string, std::string>>;

/// A picture that `compare` was given or rendered, with what is known about it.
struct NamedPicture {
    std::string name;
    measure::Picture picture;
    measure::PixelMeaning meaning = measure::PixelMeaning::luminance;
    std::optional<float> exposure;             ///< 1 / (cd/m^2), where the file says so
    std::optional<float> ev100;                ///< of that exposure, where the file says so
    Settings settings;                         ///< for people
    std::string mode;                          ///< of a scene's picture
    std::optional<measure::LightPaths> paths;  ///< of a scene's picture
    /// Of a reference: another estimate of it that differs from it as it does from what it converges to.
    std::optional<measure::Picture> noise_sample;
};

[[nodiscard]] std::string text_of(float value);

/// "slot=technique slot=technique" becomes one line a slot, so that two pictures can be told apart at a
/// glance.
void add_setting(Settings& settings, const std::string& key, const std::string& value);

/// EXR and HDR as luminance, PNG (and JPEG, WebP) as display values. Throws Error.
[[nodiscard]] NamedPicture load_picture(const std::string& file, Diagnostics& diagnostics);

/// What a scene is rendered with: by path tracing, by the integrator, and in real time once for each profile.
struct SceneOptions {
    JobOptions job;
    std::vector<std::string> profiles;
    std::uint32_t samples = 4;
    std::vector<std::string> modes{"realtime", "path", "integrate"};
    bool direct_only = false;
    std::uint32_t path_samples = 64;
    std::uint32_t integrate_samples = 16;

    [[nodiscard]] bool has_mode(const std::string& mode) const;
    [[nodiscard]] std::size_t picture_count() const;
};

void add_compared_scene_options(CLI::App& command, SceneOptions& options);

/// Refuses what contradicts or could have no effect on a scene, or on pictures what is a scene's. Throws
/// Error (Fault::usage).
void check_compare_options(const CLI::App& command, const SceneOptions& options, bool scene);

/// The pictures of a scene, the reference first. Throws Error.
[[nodiscard]] std::vector<NamedPicture> render_pictures(const SceneOptions& options,
                                                        Diagnostics& diagnostics);

}  // namespace candela::app
