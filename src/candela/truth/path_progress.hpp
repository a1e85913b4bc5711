#pragma once

#include <cstdint>
#include <optional>
#include <span>

/// How far a path-traced picture is and how long it still takes. The error of a tile falls as 1/sqrt(n) with
/// its samples (independent samples of finite variance), so the samples that it needs for a target follow
/// from those that it has; a block of samples of a tile takes as long as its blocks took before.
namespace candela::truth {

struct TileProgress {
    std::uint32_t blocks = 0;    ///< committed, those of a checkpoint included
    bool active = true;          ///< wants more
    double error = 0.0;          ///< estimated relative error; infinite while unknown
    double block_seconds = 0.0;  ///< of one thread for one block; 0 while unknown
};

/// When a picture is finished.
struct PathGoal {
    std::uint32_t blocks = 0;            ///< of each tile, at most
    std::uint32_t round_blocks = 1;      ///< tiles are tested for convergence every so many blocks
    std::optional<double> target_error;  ///< > 0
    std::optional<double> time_limit_s;  ///< of the whole, once each tile has a block
};

/// What this process and its team did since it started.
struct PathPace {
    double elapsed_s = 0.0;
    double busy_s =
        0.0;  ///< sum of block_seconds over the blocks committed in that time: elapsed_s * parallelism
};

struct PathEstimate {
    double fraction = 0.0;               ///< of the work, in [0,1]
    std::optional<double> seconds_left;  ///< nothing while no tile has an error to go by, or no pace is known
};

/// Blocks that a tile will have had in the end; nothing for an active tile whose error is not known yet.
[[nodiscard]] std::optional<std::uint32_t> blocks_at_end(const TileProgress& tile, const PathGoal& goal);

[[nodiscard]] PathEstimate estimate_path(std::span<const TileProgress> tiles, const PathGoal& goal,
                                         const PathPace& pace);

}  // namespace candela::truth
