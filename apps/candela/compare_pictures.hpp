#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "candela/measure/comparison.hpp"
#include "job.hpp"

namespace candela::app {

/// A picture that `compare` was given or rendered, with what is known about it.
struct NamedPicture {
    std::string name;
    measure::Picture picture;
    measure::PixelMeaning meaning = measure::PixelMeaning::luminance;
    std::optional<float> exposure;                              ///< 1 / (cd/m^2), where the file says so
    std::optional<float> ev100;                                 ///< of that exposure, where the file says so
    std::vector<std::pair<std::string, std::string>> settings;  ///< for people
};

/// EXR and HDR as luminance, PNG (and JPEG, WebP) as display values. Throws Error.
[[nodiscard]] NamedPicture load_picture(const std::string& file, Diagnostics& diagnostics);

/// What a scene is rendered with: by path tracing and by the integrator unless `truth` is off, and once for
/// each profile.
struct SceneOptions {
    JobOptions job;
    std::vector<std::string> profiles;
    std::uint32_t samples = 4;
    bool truth = true;
    bool direct_only = false;
    std::uint32_t path_samples = 64;
    std::uint32_t integrate_samples = 16;
};

void add_compared_scene_options(CLI::App& command, SceneOptions& options);

/// Refuses what contradicts or could have no effect on a scene, or on pictures what is a scene's. Throws
/// Error (Fault::usage).
void check_compare_options(const CLI::App& command, const SceneOptions& options, bool scene);

/// The pictures of a scene, the reference first. Throws Error.
[[nodiscard]] std::vector<NamedPicture> render_pictures(const SceneOptions& options,
                                                        Diagnostics& diagnostics);

}  // namespace candela::app
