#pragma once

#include <optional>
#include <string>

#include "candela/realtime/renderer.hpp"
#include "job.hpp"
#include "picture_files.hpp"

namespace candela::app {

/// Options of `--mode path` alone.
struct PathModeOptions {
    std::optional<std::uint32_t> samples;
    std::optional<double> time_limit_s;
    std::optional<double> target_error;
    std::optional<int> max_bounces;
    bool direct_only = false;
    bool shadows = true;
    bool furnace = false;
    bool depth_of_field = false;
    std::optional<float> focus_m;
    std::string checkpoint;
    double checkpoint_every_s = 30.0;
    bool light_paths = false;                 ///< the picture's AOVs even if no file takes them
    std::string label = "rendering by path";  ///< of what is shown while it lasts
};

void add_path_options(CLI::App& command, PathModeOptions& options);

/// Refuses what contradicts or could have no effect in the mode, what only the path tracer knows in others.
/// Throws Error (Fault::usage).
void check_path_options(const CLI::App& command, const ShadowRequestOptions& shadows,
                        const std::string& mode);

struct PathModePicture {
    realtime::Still still;
    /// With light paths, in cd/m^2: what comes straight from the environment to the surface that is seen.
    std::vector<glm::vec4> environment_nit;
    PictureInfo info;
    std::string note;    ///< how it ended, for people
    bool writes = true;  ///< false in processes that only help another one
    bool finished = true;
    double error = 0.0;      ///< estimated relative error of the picture
    std::string checkpoint;  ///< to be removed once the picture is on disk
};

/// Renders the job by path tracing. Throws Error.
[[nodiscard]] PathModePicture render_by_path(Job& job, const JobOptions& options, const PathModeOptions& path,
                                             const PictureFileOptions& files);

}  // namespace candela::app
