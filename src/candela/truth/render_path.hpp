#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "candela/truth/camera_rays.hpp"
#include "candela/truth/film.hpp"
#include "candela/truth/team.hpp"

namespace candela::truth {

struct PathProgress {
    double fraction = 0.0;               ///< of the work that the options ask for, in [0,1]
    std::uint32_t samples = 0;           ///< of the tile that has fewest
    double error = 0.0;                  ///< Film::picture_error; 0 while unknown
    std::optional<double> seconds_left;  ///< estimate_path()
};

struct PathRenderOptions {
    PathOptions path;
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::uint32_t samples = 256;         ///< of each pixel, at most
    std::optional<double> time_limit_s;  ///< stop at the next tile, once each has samples
    std::optional<double>
        target_error;  ///< tiles whose estimated relative error is below get no more samples
    std::uint32_t seed = 0;
    Lens lens;
    bool aovs = false;
    std::filesystem::path checkpoint;  ///< where the work so far is kept; empty: nowhere
    double checkpoint_every_s = 30.0;
    std::uint64_t fingerprint = 0;            ///< of all that the picture depends on, samples and target
                                              ///< included; a checkpoint of another is not used
    const std::atomic<bool>* stop = nullptr;  ///< set by a signal: finish the tiles under way and return
    std::function<void(const PathProgress&)> progress;
    double progress_every_s = 0.25;
};

enum class PathOutcome : std::uint8_t { finished, out_of_time, stopped };

struct PathRender {
    Film film;
    PathOutcome outcome = PathOutcome::finished;
    std::uint32_t resumed_samples = 0;  ///< that a checkpoint already had, of the tile with fewest
    bool replaced_checkpoint = false;   ///< there was one of another job, or a damaged one
};

/// Floor of the relative error, as a part of the picture's mean luminance: errors in what is darker than this
/// do not show.
inline constexpr double kErrorFloor = 0.5;

/// Renders on every core, and on every process of the team. At rank 0 returns the film; at the others an
/// empty one. The sums are the same bytes for any number of threads and processes, unless time or a signal
/// stops them.
[[nodiscard]] PathRender render_path(const scene::Scene& scene, const scene::Camera& camera,
                                     const PathRenderOptions& options, Team& team);

}  // namespace candela::truth
