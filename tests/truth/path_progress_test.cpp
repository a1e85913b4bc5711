// Time left, tried on pictures whose convergence is known: simulated threads take the blocks of tiles whose
// error falls as 1/sqrt(n), each at its own cost.
#include "candela/truth/path_progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace candela::truth {
namespace {

constexpr double kTarget = 0.02;

struct SimulatedTile {
    double error_of_one_block = 0.0;
    double block_s = 0.0;
};

/// Runs all tiles as render_path does, block after block, and asks for an estimate after each block.
class Simulation {
  public:
    Simulation(std::vector<SimulatedTile> tiles, unsigned threads, PathGoal goal)
        : simulated_(std::move(tiles)), threads_(threads), goal_(goal), tiles_(simulated_.size()) {}

    struct Moment {
        double elapsed_s;
        PathEstimate estimate;
    };

    std::vector<Moment> run() {
        for (std::uint32_t block = 0; block < goal_.blocks; ++block) {
            if (!compute_block(block)) break;
            moments_.push_back({now_s_, estimate_path(tiles_, goal_, {now_s_, busy_s_})});
            if (goal_.target_error && (block + 1) % goal_.round_blocks == 0) test_convergence();
        }
        return moments_;
    }
    [[nodiscard]] double total_s() const { return now_s_; }

  private:
    bool compute_block(std::uint32_t block) {
        std::vector<double> thread_s(threads_, 0.0);
        bool any = false;
        for (std::size_t t = 0; t < tiles_.size(); ++t) {
            if (!tiles_[t].active || tiles_[t].blocks > block) continue;
            any = true;
            *std::min_element(thread_s.begin(), thread_s.end()) += simulated_[t].block_s;
            busy_s_ += simulated_[t].block_s;
            ++tiles_[t].blocks;
            tiles_[t].block_seconds = simulated_[t].block_s;
            tiles_[t].error = simulated_[t].error_of_one_block / std::sqrt(double(tiles_[t].blocks));
        }
        now_s_ += *std::max_element(thread_s.begin(), thread_s.end());
        return any;
    }
    void test_convergence() {
        for (TileProgress& tile : tiles_) tile.active = tile.active && tile.error >= *goal_.target_error;
    }

    std::vector<SimulatedTile> simulated_;
    unsigned threads_;
    PathGoal goal_;
    std::vector<TileProgress> tiles_;
    std::vector<Moment> moments_;
    double now_s_ = 0.0;
    double busy_s_ = 0.0;
};

/// Sky that converges at once, walls, and a few tiles of caustics: errors over two decades, costs over one.
std::vector<SimulatedTile> uneven_picture(std::size_t count) {
    std::minstd_rand random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<SimulatedTile> out;
    for (std::size_t i = 0; i < count; ++i)
        out.push_back({0.01 * std::pow(100.0, unit(random)), 0.002 * std::pow(10.0, unit(random))});
    return out;
}

void expect_true(const std::vector<Simulation::Moment>& moments, double total_s, double tolerance) {
    for (const Simulation::Moment& m : moments) {
        if (m.elapsed_s < 0.05 * total_s) continue;
        ASSERT_TRUE(m.estimate.seconds_left) << "after " << m.elapsed_s << " s";
        EXPECT_NEAR(m.elapsed_s + *m.estimate.seconds_left, total_s, tolerance * total_s)
            << "after " << m.elapsed_s << " of " << total_s << " s";
        EXPECT_NEAR(m.estimate.fraction, m.elapsed_s / total_s, 2.0 * tolerance)
            << "after " << m.elapsed_s << " of " << total_s << " s";
    }
}

TEST(PathProgress, TimeLeftForATargetErrorFollowsFromTheErrorsDecay) {
    // The number of samples that --target-error may take is no measure of what it takes.
    Simulation simulation(uneven_picture(300), 2, {1u << 16, 8, kTarget, {}});
    const auto moments = simulation.run();
    ASSERT_GT(moments.size(), 100u);
    expect_true(moments, simulation.total_s(), 0.06);
}

TEST(PathProgress, FewUnconvergedTilesKeepFewThreadsBusy) {
    // Three tiles need nearly all the time, on sixteen threads.
    std::vector<SimulatedTile> tiles(200, {0.03, 0.004});
    for (std::size_t i = 0; i < 3; ++i) tiles[50 * i] = {0.8, 0.01};
    Simulation simulation(tiles, 16, {1u << 16, 8, kTarget, {}});
    const auto moments = simulation.run();
    expect_true(moments, simulation.total_s(), 0.1);
}

TEST(PathProgress, ANumberOfSamplesIsSharedOutByWhatTilesCost) {
    Simulation simulation(uneven_picture(100), 4, {64, 8, {}, {}});
    const auto moments = simulation.run();
    expect_true(moments, simulation.total_s(), 0.03);
}

TEST(PathProgress, ATimeLimitEndsItUnlessItIsDoneBefore) {
    const std::vector<TileProgress> tiles(10, {4, true, 0.5, 0.1});
    const PathGoal goal{1000, 8, {}, 20.0};
    const PathEstimate estimate = estimate_path(tiles, goal, {5.0, 5.0});
    EXPECT_NEAR(estimate.seconds_left.value_or(-1.0), 15.0, 1e-9);
    EXPECT_NEAR(estimate.fraction, 0.25, 1e-9);
    const PathEstimate before = estimate_path(tiles, {8, 8, {}, 20.0}, {5.0, 5.0});
    EXPECT_NEAR(before.seconds_left.value_or(-1.0), 4.0, 1e-9);
    // Past its limit only for the tiles that have nothing yet.
    std::vector<TileProgress> holes = tiles;
    for (std::size_t i = 0; i < 3; ++i) holes[i] = {0, true, INFINITY, 0.0};
    EXPECT_NEAR(estimate_path(holes, goal, {30.0, 30.0}).seconds_left.value_or(-1.0), 0.3, 1e-9);
}

TEST(PathProgress, NothingIsClaimedBeforeAnErrorIsKnown) {
    const std::vector<TileProgress> tiles(10, {0, true, INFINITY, 0.0});
    EXPECT_FALSE(estimate_path(tiles, {1u << 16, 8, kTarget, {}}, {1.0, 1.0}).seconds_left);
    // What a checkpoint brought is done.
    const std::vector<TileProgress> resumed(10, {30, true, 0.0, 0.1});
    EXPECT_NEAR(estimate_path(resumed, {40, 8, {}, {}}, {1.0, 1.0}).fraction, 0.75, 1e-9);
}

}  // namespace
}  // namespace candela::truth
