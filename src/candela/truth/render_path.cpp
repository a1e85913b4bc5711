#include "candela/truth/render_path.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>

#include "candela/truth/checkpoint.hpp"
#include "candela/truth/path_progress.hpp"

namespace candela::truth {
namespace {

using Clock = std::chrono::steady_clock;

/// Whether more is wanted of a tile is decided after this many blocks, for any number of processes.
constexpr std::uint32_t kRoundBlocks = 8;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// One picture under way. Blocks of samples are computed tile by tile on all cores; each process of a team
/// takes every size-th block, and rank 0 commits them in their order.
class PathJob {
  public:
    PathJob(const scene::Scene& scene, const scene::Camera& camera, const PathRenderOptions& options,
            Team& team)
        : options_(options),
          team_(team),
          integrator_(scene, options.path),
          rays_(camera, options.width, options.height, options.lens),
          film_(options.width, options.height, FilmLayout{options.aovs}),
          tile_times_(film_.tile_count()) {}

    PathRender run();

  private:
    [[nodiscard]] std::uint32_t total_blocks() const {
        return (options_.samples + Film::block_samples - 1) / Film::block_samples;
    }
    [[nodiscard]] std::uint32_t samples_of(std::uint32_t block) const {
        return std::min(Film::block_samples, options_.samples - block * Film::block_samples);
    }
    [[nodiscard]] std::uint32_t first_block() const;
    [[nodiscard]] std::vector<std::uint32_t> tiles_wanting(std::uint32_t block) const;
    [[nodiscard]] bool interrupted();
    void share_tiles();
    /// Adds a block's paths to `sums`; of the first block also returns what each pixel's first path met.
    std::vector<glm::uvec2> compute(std::uint32_t tile, std::uint32_t block, std::span<float> sums) const;
    /// compute(), and how long it took. One thread a tile.
    std::vector<glm::uvec2> compute_timed(std::uint32_t tile, std::uint32_t block, std::span<float> sums);
    void keep_ids(std::uint32_t tile, const std::vector<glm::uvec2>& ids);
    void alone(std::uint32_t block);
    void together(std::uint32_t begin, std::uint32_t end);
    void after_commit();
    [[nodiscard]] PathProgress progress() const;
    [[nodiscard]] bool at_round_end() const;
    void judge_tiles();
    [[nodiscard]] double floor_nit() const { return kErrorFloor * film_.median_luminance_nit(); }

    const PathRenderOptions& options_;
    Team& team_;
    PathIntegrator integrator_;
    CameraRays rays_;
    Film film_;
    PathOutcome outcome_ = PathOutcome::finished;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_checkpoint_ = start_;
    Clock::time_point last_progress_ = start_;
    /// Of the blocks that this process computed itself.
    struct TileTime {
        double seconds = 0.0;
        std::uint32_t blocks = 0;
        std::uint32_t resumed_blocks = 0;  ///< that a checkpoint already had
    };
    std::vector<TileTime> tile_times_;
    bool replaced_ = false;
    std::mutex mutex_;
    std::exception_ptr error_;
};

std::uint32_t PathJob::first_block() const {
    std::uint32_t first = total_blocks();
    for (const Film::Tile& tile : film_.tiles) {
        if (tile.active) first = std::min(first, tile.blocks);
    }
    return first;
}

std::vector<std::uint32_t> PathJob::tiles_wanting(std::uint32_t block) const {
    std::vector<std::uint32_t> out;
    for (std::uint32_t t = 0; t < film_.tile_count(); ++t) {
        if (film_.tiles[t].active && film_.tiles[t].blocks <= block) out.push_back(t);
    }
    return out;
}

bool PathJob::interrupted() {
    if (options_.stop && options_.stop->load()) outcome_ = PathOutcome::stopped;
    // A picture with holes is none: time is up only when every tile has something.
    if (options_.time_limit_s && first_block() > 0 && seconds_since(start_) > *options_.time_limit_s)
        outcome_ = PathOutcome::out_of_time;
    return outcome_ != PathOutcome::finished;
}

void PathJob::share_tiles() {
    team_.broadcast(std::as_writable_bytes(std::span(film_.tiles)));
    std::int32_t outcome = static_cast<std::int32_t>(outcome_);
    team_.broadcast(std::as_writable_bytes(std::span(&outcome, 1)));
    outcome_ = static_cast<PathOutcome>(outcome);
}

std::vector<glm::uvec2> PathJob::compute(std::uint32_t tile, std::uint32_t block,
                                         std::span<float> sums) const {
    std::vector<glm::uvec2> ids;
    const Film::Rect r = film_.rect(tile);
    const std::size_t channels = film_.layout().channels();
    float* pixel = sums.data();
    for (std::uint32_t y = r.begin.y; y < r.end.y; ++y) {
        for (std::uint32_t x = r.begin.x; x < r.end.x; ++x, pixel += channels) {
            for (std::uint32_t i = 0; i < samples_of(block); ++i) {
                const std::uint32_t sample = block * Film::block_samples + i;
                const PathSampler sampler({x, y}, sample, options_.seed);
                const glm::vec2 lens = options_.lens.radius_m > 0.0f ? sampler.lens() : glm::vec2(0.5f);
                const Ray ray = rays_.through(glm::vec2(x, y) + sampler.pixel(), lens);
                PathResult path = integrator_.trace(ray, sampler);
                path.distance_m = rays_.depth_m(ray, path.distance_m);
                film_.layout().add(path, pixel);
                if (sample == 0) ids.emplace_back(path.object_id, path.material_id);
            }
        }
    }
    return ids;
}

std::vector<glm::uvec2> PathJob::compute_timed(std::uint32_t tile, std::uint32_t block,
                                               std::span<float> sums) {
    const Clock::time_point start = Clock::now();
    std::vector<glm::uvec2> ids = compute(tile, block, sums);
    tile_times_[tile].seconds += seconds_since(start);
    ++tile_times_[tile].blocks;
    return ids;
}

void PathJob::keep_ids(std::uint32_t tile, const std::vector<glm::uvec2>& ids) {
    if (ids.empty()) return;
    const Film::Rect r = film_.rect(tile);
    auto from = ids.begin();
    for (std::uint32_t y = r.begin.y; y < r.end.y; ++y) {
        for (std::uint32_t x = r.begin.x; x < r.end.x; ++x)
            film_.ids[std::size_t{y} * film_.width() + x] = *from++;
    }
}

void PathJob::after_commit() {
    if (!options_.checkpoint.empty() && seconds_since(last_checkpoint_) > options_.checkpoint_every_s) {
        save_checkpoint(options_.checkpoint, film_, options_.fingerprint);
        last_checkpoint_ = Clock::now();
    }
    if (!options_.progress || seconds_since(last_progress_) < options_.progress_every_s) return;
    last_progress_ = Clock::now();
    options_.progress(progress());
}

PathProgress PathJob::progress() const {
    const double floor = floor_nit();
    PathPace pace;
    pace.elapsed_s = seconds_since(start_);
    PathProgress out;
    out.samples = options_.samples;
    std::vector<TileProgress> tiles(film_.tile_count());
    for (std::uint32_t t = 0; t < film_.tile_count(); ++t) {
        const Film::Tile& tile = film_.tiles[t];
        const TileTime& time = tile_times_[t];
        const double block_s = time.blocks > 0 ? time.seconds / time.blocks : 0.0;
        tiles[t] = {tile.blocks, tile.active, options_.target_error ? film_.tile_error(t, floor) : 0.0,
                    block_s};
        pace.busy_s += block_s * (tile.blocks - time.resumed_blocks);
        out.samples = std::min(out.samples, tile.samples);
    }
    const PathEstimate estimate = estimate_path(
        tiles, {total_blocks(), kRoundBlocks, options_.target_error, options_.time_limit_s}, pace);
    out.fraction = estimate.fraction;
    out.seconds_left = estimate.seconds_left;
    if (out.samples >= 2) out.error = film_.picture_error(floor);
    return out;
}

void PathJob::alone(std::uint32_t block) {
    std::vector<std::uint32_t> wanting = tiles_wanting(block);
    std::atomic<bool> enough = false;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, wanting.size(), 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                if (enough) return;
                const std::uint32_t tile = wanting[i];
                std::vector<float> sums(film_.rect(tile).pixels() * film_.layout().channels());
                const std::vector<glm::uvec2> ids = compute_timed(tile, block, sums);
                const std::lock_guard lock(mutex_);
                try {
                    keep_ids(tile, ids);
                    film_.commit(tile, sums, samples_of(block));
                    after_commit();
                } catch (...) {
                    if (!error_) error_ = std::current_exception();
                    enough = true;
                }
                if (interrupted()) enough = true;
            }
        },
        tbb::simple_partitioner());
    if (error_) std::rethrow_exception(error_);
}

void PathJob::together(std::uint32_t begin, std::uint32_t end) {
    const auto offsets_of = [&](const std::vector<std::uint32_t>& wanting) {
        std::vector<std::size_t> offsets{0};
        for (const std::uint32_t t : wanting) {
            offsets.push_back(offsets.back() + film_.rect(t).pixels() * film_.layout().channels());
        }
        return offsets;
    };
    const std::uint32_t own = begin + static_cast<std::uint32_t>(team_.rank());
    std::vector<float> sums;
    if (own < end) {
        const std::vector<std::uint32_t> wanting = tiles_wanting(own);
        const std::vector<std::size_t> offsets = offsets_of(wanting);
        sums.assign(offsets.back(), 0.0f);
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, wanting.size(), 1),
            [&](const tbb::blocked_range<std::size_t>& range) {
                for (std::size_t i = range.begin(); i < range.end(); ++i) {
                    // Nobody reads the ids while this runs, and each tile has its own.
                    keep_ids(wanting[i],
                             compute_timed(wanting[i], own,
                                           std::span(sums).subspan(offsets[i], offsets[i + 1] - offsets[i])));
                }
            },
            tbb::simple_partitioner());
        if (team_.rank() != 0) team_.send(sums);
    }
    if (team_.rank() != 0) return;
    for (std::uint32_t block = begin; block < end; ++block) {
        const std::vector<std::uint32_t> wanting = tiles_wanting(block);
        const std::vector<std::size_t> offsets = offsets_of(wanting);
        if (block != own) {
            sums.resize(offsets.back());
            team_.receive(static_cast<int>(block - begin), sums);
        }
        for (std::size_t i = 0; i < wanting.size(); ++i) {
            film_.commit(wanting[i], std::span(sums).subspan(offsets[i], offsets[i + 1] - offsets[i]),
                         samples_of(block));
        }
        after_commit();
    }
    (void)interrupted();
}

bool PathJob::at_round_end() const {
    const std::uint32_t block = first_block();
    const auto there = [&](const Film::Tile& tile) { return !tile.active || tile.blocks == block; };
    return block > 0 && block % kRoundBlocks == 0 &&
           std::all_of(film_.tiles.begin(), film_.tiles.end(), there);
}

void PathJob::judge_tiles() {
    if (!options_.target_error) return;
    const double floor = floor_nit();
    for (std::uint32_t t = 0; t < film_.tile_count(); ++t) {
        if (film_.tile_error(t, floor) < *options_.target_error) film_.tiles[t].active = false;
    }
}

PathRender PathJob::run() {
    const bool keeps_film = team_.rank() == 0;
    std::uint32_t resumed = 0;
    if (keeps_film && !options_.checkpoint.empty()) {
        const CheckpointState state = load_checkpoint(options_.checkpoint, options_.fingerprint, film_);
        replaced_ = state == CheckpointState::other;
        if (state == CheckpointState::loaded) {
            resumed = std::min(first_block() * Film::block_samples, options_.samples);
            // It may have been interrupted between the end of a round and the judgement.
            if (at_round_end()) judge_tiles();
        }
    }
    share_tiles();
    for (std::uint32_t t = 0; t < film_.tile_count(); ++t)
        tile_times_[t].resumed_blocks = film_.tiles[t].blocks;
    const auto size = static_cast<std::uint32_t>(team_.size());
    for (std::uint32_t block = first_block(); block < total_blocks(); block = first_block()) {
        const std::uint32_t round_end = std::min((block / kRoundBlocks + 1) * kRoundBlocks, total_blocks());
        while (block < round_end && outcome_ == PathOutcome::finished) {
            if (size == 1) {
                alone(block);
                ++block;
            } else {
                const std::uint32_t end = std::min(block + size, round_end);
                together(block, end);
                block = end;
                share_tiles();
            }
        }
        if (outcome_ != PathOutcome::finished) break;
        if (keeps_film) judge_tiles();
        share_tiles();
    }
    if (keeps_film && outcome_ != PathOutcome::finished && !options_.checkpoint.empty()) {
        save_checkpoint(options_.checkpoint, film_, options_.fingerprint);
    }
    return {std::move(film_), outcome_, resumed, replaced_};
}

}  // namespace

PathRender render_path(const scene::Scene& scene, const scene::Camera& camera,
                       const PathRenderOptions& options, Team& team) {
    return PathJob(scene, camera, options, team).run();
}

}  // namespace candela::truth
