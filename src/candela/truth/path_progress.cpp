#include "candela/truth/path_progress.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace candela::truth {
namespace {

/// What one tile still needs, and how long one of its blocks takes a thread.
struct Rest {
    double blocks = 0.0;
    double block_s = 0.0;
};

/// Every tile gets one block after the other; those that are done drop out. Fewer tiles than threads take as
/// long as the slowest of them.
double seconds_of(std::vector<Rest> rests, double parallelism) {
    std::sort(rests.begin(), rests.end(), [](const Rest& a, const Rest& b) { return a.blocks < b.blocks; });
    std::vector<double> slowest_s(rests.size() + 1, 0.0);
    double sum_s = 0.0;
    for (std::size_t i = rests.size(); i-- > 0;) {
        slowest_s[i] = std::max(slowest_s[i + 1], rests[i].block_s);
        sum_s += rests[i].block_s;
    }
    double seconds = 0.0;
    double done = 0.0;
    for (std::size_t i = 0; i < rests.size(); ++i) {
        seconds += (rests[i].blocks - done) * std::max(sum_s / parallelism, slowest_s[i]);
        done = rests[i].blocks;
        sum_s -= rests[i].block_s;
    }
    return seconds;
}

double mean_block_seconds(std::span<const TileProgress> tiles) {
    double sum_s = 0.0;
    double count = 0.0;
    for (const TileProgress& tile : tiles) {
        if (!(tile.block_seconds > 0.0)) continue;
        sum_s += tile.block_seconds;
        count += 1.0;
    }
    return count > 0.0 ? sum_s / count : 0.0;
}

/// Of the tiles whose end is known: what the others are taken to need.
std::optional<double> mean_blocks_at_end(std::span<const TileProgress> tiles, const PathGoal& goal) {
    double sum = 0.0;
    double count = 0.0;
    for (const TileProgress& tile : tiles) {
        const std::optional<std::uint32_t> end = blocks_at_end(tile, goal);
        if (!end || tile.blocks == 0) continue;
        sum += *end;
        count += 1.0;
    }
    if (count > 0.0) return sum / count;
    return goal.target_error ? std::nullopt : std::optional<double>(goal.blocks);
}

struct Work {
    double done_s = 0.0;  ///< of one thread
    std::vector<Rest> rests;
    std::vector<Rest> first_blocks;  ///< of tiles that have none
};

Work work_of(std::span<const TileProgress> tiles, const PathGoal& goal, double otherwise_blocks) {
    Work work;
    const double mean_s = mean_block_seconds(tiles);
    for (const TileProgress& tile : tiles) {
        const double block_s = tile.block_seconds > 0.0 ? tile.block_seconds : mean_s;
        const std::optional<std::uint32_t> end = blocks_at_end(tile, goal);
        const double blocks = end ? *end : std::max(otherwise_blocks, tile.blocks + 1.0);
        work.done_s += tile.blocks * block_s;
        if (blocks > tile.blocks) work.rests.push_back({blocks - tile.blocks, block_s});
        if (tile.blocks == 0) work.first_blocks.push_back({1.0, block_s});
    }
    return work;
}

double thread_seconds(const std::vector<Rest>& rests) {
    double sum_s = 0.0;
    for (const Rest& rest : rests) sum_s += rest.blocks * rest.block_s;
    return sum_s;
}

}  // namespace

std::optional<std::uint32_t> blocks_at_end(const TileProgress& tile, const PathGoal& goal) {
    if (!tile.active) return tile.blocks;
    if (!goal.target_error) return std::max(goal.blocks, tile.blocks);
    if (tile.blocks == 0 || !std::isfinite(tile.error)) return std::nullopt;
    const double ratio = tile.error / *goal.target_error;
    const double wanted = tile.blocks * std::max(ratio * ratio, 1.0);
    const double rounds = std::ceil(wanted / goal.round_blocks);
    return static_cast<std::uint32_t>(std::min(rounds * goal.round_blocks, static_cast<double>(goal.blocks)));
}

PathEstimate estimate_path(std::span<const TileProgress> tiles, const PathGoal& goal, const PathPace& pace) {
    PathEstimate out;
    const std::optional<double> otherwise = mean_blocks_at_end(tiles, goal);
    const Work work = work_of(tiles, goal, otherwise.value_or(1.0));
    const double parallelism = pace.elapsed_s > 0.0 ? pace.busy_s / pace.elapsed_s : 0.0;
    if (otherwise) {
        const double rest_s = thread_seconds(work.rests);
        if (work.done_s + rest_s > 0.0) out.fraction = work.done_s / (work.done_s + rest_s);
        if (parallelism > 0.0) out.seconds_left = seconds_of(work.rests, parallelism);
    }
    if (!goal.time_limit_s) return out;
    // Time is up only when every tile has something.
    double left_s = std::max(*goal.time_limit_s - pace.elapsed_s, 0.0);
    if (parallelism > 0.0) left_s = std::max(left_s, seconds_of(work.first_blocks, parallelism));
    if (out.seconds_left && *out.seconds_left < left_s) return out;
    out.seconds_left = left_s;
    out.fraction = pace.elapsed_s / (pace.elapsed_s + left_s);
    return out;
}

}  // namespace candela::truth
