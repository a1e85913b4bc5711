#include "candela/truth/render_path.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <csignal>
#include <cstring>

#include "candela/scene/error.hpp"
#include "candela/truth/checkpoint.hpp"
#include "common/files.hpp"
#include "lights.hpp"

using namespace candela;
using namespace candela::test;

namespace {

scene::Scene small_room() {
    scene::Scene s;
    place(s, flat_square(3.0f, glm::vec3(0.0f), true), grey(0.7f));
    place(s, sphere(0.5f), grey(0.5f));
    place(s, flat_square(0.5f, {0, 2, 0}, false), lamp(100.0f));
    s.environment = constant(3.0f);
    return s;
}

scene::Scene small_room_with_lights() {
    scene::Scene s = small_room();
    s.lights = {light_of(scene::LightType::sphere, {-1, 1, 0.5f}),
                light_of(scene::LightType::tube, {1, 0.8f, 0}),
                light_of(scene::LightType::sun, {}, {0.3f, -1.0f, -0.2f})};
    for (scene::Light& l : s.lights) l.intensity = 5.0f;
    s.lights[0].visible = true;
    s.lights[0].radius_m = s.lights[1].radius_m = 0.1f;
    return s;
}

const scene::Camera kCamera = scene::look_at({0, 1.5f, 4}, {0, 0.3f, 0}, 0.6f);

truth::PathRenderOptions small_options() {
    truth::PathRenderOptions o;
    o.path.techniques = best();
    o.width = 100;
    o.height = 70;
    o.samples = 10;  // not a multiple of a block
    o.fingerprint = 42;
    return o;
}

truth::PathRender render(const truth::PathRenderOptions& options, const scene::Scene& scene = small_room()) {
    const auto team = truth::join_team();
    return truth::render_path(scene, kCamera, options, *team);
}

bool same(const truth::Film& a, const truth::Film& b) {
    return a.sums.size() == b.sums.size() &&
           std::memcmp(a.sums.data(), b.sums.data(), a.sums.size() * sizeof(double)) == 0 && a.ids == b.ids;
}

}  // namespace

TEST(RenderPath, TheNumberOfThreadsDoesNotShow) {
    truth::PathRenderOptions o = small_options();
    o.aovs = true;
    const truth::PathRender many = render(o, small_room_with_lights());
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const truth::PathRender single = render(o, small_room_with_lights());
    EXPECT_TRUE(same(many.film, single.film));
    EXPECT_EQ(many.film.tiles[0].samples, 10u);
    o.seed = 1;
    EXPECT_FALSE(same(render(o).film, many.film)) << "another seed has to give other noise";
}

TEST(RenderPath, AStoppedPictureGoesOnToTheSameBytes) {
    const TemporaryFolder folder;
    truth::PathRenderOptions o = small_options();
    const truth::PathRender whole = render(o);
    o.checkpoint = folder / "work.part";
    o.checkpoint_every_s = 0.0;
    std::atomic<bool> stop = true;
    o.stop = &stop;
    // Each start gets one tile further on each core.
    truth::PathRender stopped = render(o);
    EXPECT_EQ(stopped.outcome, truth::PathOutcome::stopped);
    EXPECT_LT(stopped.film.tiles.back().samples, 10u);
    EXPECT_EQ(render(o).outcome, truth::PathOutcome::stopped);
    stop = false;
    const truth::PathRender resumed = render(o);
    EXPECT_EQ(resumed.outcome, truth::PathOutcome::finished);
    EXPECT_TRUE(same(resumed.film, whole.film));
}

TEST(RenderPath, AKilledPictureGoesOnToTheSameBytes) {
    const TemporaryFolder folder;
    truth::PathRenderOptions o = small_options();
    o.checkpoint = folder / "work.part";
    o.checkpoint_every_s = 0.0;
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        // The first checkpoint is on disk when progress is reported; nothing is cleaned up after this.
        o.progress = [](const truth::PathProgress& p) {
            if (p.fraction > 0.3) kill(getpid(), SIGKILL);
        };
        o.progress_every_s = 0.0;
        (void)render(o);
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "it ended before it was killed";
    truth::Film so_far(o.width, o.height, {});
    ASSERT_EQ(truth::load_checkpoint(o.checkpoint, o.fingerprint, so_far), truth::CheckpointState::loaded);
    EXPECT_GT(so_far.tiles[0].samples, 0u);
    EXPECT_LT(so_far.tiles.back().samples, 10u);
    const truth::PathRender resumed = render(o);
    o.checkpoint.clear();
    EXPECT_TRUE(same(resumed.film, render(o).film));
}

TEST(RenderPath, ACheckpointOfSomethingElseIsNotUsed) {
    const TemporaryFolder folder;
    const std::string file = folder / "work.part";
    truth::Film film(40, 40, {});
    film.sums[7] = 5.0;
    film.tiles[0].blocks = 3;
    truth::save_checkpoint(file, film, 42);
    truth::Film out(40, 40, {});
    EXPECT_EQ(truth::load_checkpoint(file, 42, out), truth::CheckpointState::loaded);
    EXPECT_EQ(out.sums[7], 5.0);
    EXPECT_EQ(out.tiles[0].blocks, 3u);
    truth::Film other(40, 40, {});
    EXPECT_EQ(truth::load_checkpoint(file, 43, other), truth::CheckpointState::other) << "another job";
    truth::Film wide(41, 40, {});
    EXPECT_EQ(truth::load_checkpoint(file, 42, wide), truth::CheckpointState::other) << "another size";
    EXPECT_EQ(truth::load_checkpoint(folder / "absent", 42, other), truth::CheckpointState::absent);
    std::string bytes = slurp(file);
    bytes[bytes.size() / 2] ^= 1;
    std::ofstream(file, std::ios::binary) << bytes;
    EXPECT_EQ(truth::load_checkpoint(file, 42, other), truth::CheckpointState::other) << "a flipped bit";
    std::ofstream(file, std::ios::binary) << bytes.substr(0, 100);
    EXPECT_EQ(truth::load_checkpoint(file, 42, other), truth::CheckpointState::other) << "truncated";
    EXPECT_EQ(other.sums[7], 0.0);
    std::ofstream(file, std::ios::binary) << "somebody's notes";
    EXPECT_THROW((void)truth::load_checkpoint(file, 42, other), Error) << "must not be replaced";
}

TEST(RenderPath, TilesStopWhenTheirErrorIsReached) {
    truth::PathRenderOptions o = small_options();
    o.samples = 4096;
    o.target_error = 0.03;
    const truth::PathRender r = render(o);
    EXPECT_EQ(r.outcome, truth::PathOutcome::finished);
    const double floor_nit = truth::kErrorFloor * r.film.median_luminance_nit();
    std::uint32_t fewest = 4096;
    std::uint32_t most = 0;
    for (std::uint32_t t = 0; t < r.film.tile_count(); ++t) {
        EXPECT_LT(r.film.tile_error(t, floor_nit), 0.033)
            << "the floor moves a little after a tile has stopped";
        fewest = std::min(fewest, r.film.tiles[t].samples);
        most = std::max(most, r.film.tiles[t].samples);
    }
    EXPECT_LT(fewest, most) << "easy tiles stop first";
    EXPECT_LT(most, 4096u);
}

TEST(RenderPath, TilesAreJudgedAtTheSameSamplesWhereverItWasInterrupted) {
    const TemporaryFolder folder;
    truth::PathRenderOptions o = small_options();
    o.width = o.height = 32;  // one tile
    o.samples = 256;
    o.target_error = 0.3;
    const truth::PathRender whole = render(o);
    EXPECT_LT(whole.film.tiles[0].samples, 256u);
    o.checkpoint = folder / "work.part";
    o.time_limit_s = 1e-9;  // one block at a time
    for (int start = 0; start < 100; ++start) {
        const truth::PathRender part = render(o);
        if (part.outcome == truth::PathOutcome::finished) {
            EXPECT_TRUE(same(part.film, whole.film)) << part.film.tiles[0].samples << " samples";
            return;
        }
    }
    FAIL() << "it never ended";
}

TEST(RenderPath, ABlackPictureHasNoError) {
    truth::PathRenderOptions o = small_options();
    o.target_error = 0.01;
    o.samples = 1u << 20;
    o.path.max_bounces = 0;
    const auto team = truth::join_team();
    scene::Scene dark;
    place(dark, sphere(0.5f), grey(0.5f));
    const truth::PathRender r = truth::render_path(dark, kCamera, o, *team);
    EXPECT_EQ(r.film.picture_error(0.0), 0.0);
    EXPECT_EQ(r.film.tiles[0].samples, 32u) << "the first judgement ends it";
}

TEST(RenderPath, TheEstimatedErrorIsTheTrueOne) {
    truth::PathRenderOptions o = small_options();
    o.samples = 16;
    const truth::PathRender noisy = render(o);
    o.samples = 2048;
    o.seed = 5;
    const truth::PathRender clean = render(o);
    const double floor_nit = truth::kErrorFloor * clean.film.median_luminance_nit();
    double sum = 0.0;
    for (std::uint32_t y = 0; y < o.height; ++y) {
        for (std::uint32_t x = 0; x < o.width; ++x) {
            const double a = noisy.film.pixel(x, y)[1] / 16.0;
            const double b = clean.film.pixel(x, y)[1] / 2048.0;
            sum += (a - b) * (a - b) / (b * b + floor_nit * floor_nit);
        }
    }
    const double truly = std::sqrt(sum / (100.0 * 70.0));
    const double estimated = noisy.film.picture_error(floor_nit);
    // Samples that avoid each other do better than the independent ones that the estimate assumes, never
    // worse.
    EXPECT_LT(truly, 1.05 * estimated);
    EXPECT_GT(truly, 0.3 * estimated);
}

// With a target error the number of samples that it may take says nothing: how far it is has to follow from
// the tiles' errors.
TEST(RenderPath, ProgressOfATargetErrorEndsNearItsEnd) {
    truth::PathRenderOptions o = small_options();
    o.samples = 1u << 18;
    o.target_error = 0.03;
    o.progress_every_s = 0.0;
    std::vector<truth::PathProgress> reports;
    o.progress = [&](const truth::PathProgress& p) { reports.push_back(p); };
    EXPECT_EQ(render(o).outcome, truth::PathOutcome::finished);
    ASSERT_GT(reports.size(), 40u);
    EXPECT_GT(reports.back().fraction, 0.9);
    EXPECT_TRUE(reports.back().seconds_left.has_value());
    EXPECT_LT(reports.back().error, 0.03);
    const truth::PathProgress& middle = reports[reports.size() / 2];
    EXPECT_GT(middle.fraction, 0.25);
    EXPECT_LT(middle.fraction, 0.75);
}
