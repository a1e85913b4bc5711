#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "candela/io/image_read.hpp"
#include "demo_scenes.hpp"
#include "process.hpp"

using namespace candela;
using namespace candela::test;

namespace {

/// The room, made once for this process.
std::string room() {
    static const TemporaryFolder folder;
    if (!std::filesystem::exists(folder / "cornell_room.glb")) scenes::write_room(folder.path());
    return (folder / "cornell_room.glb") + " --env none --ev100 5 ";
}

bool have_mpirun() {
    return std::system("command -v mpirun >/dev/null 2>&1") == 0;
}

}  // namespace

TEST(PathMode, AnEmissivePanelLightsTheRoom) {
    const TemporaryFolder out;
    const Outcome run = run_candela(
        "render " + room() + "--mode path --spp 16 --size 64x36 --aov all --json -o " + (out / "a.exr"));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["mode"], "path");
    EXPECT_EQ(json["samples"], 16);
    EXPECT_GT(json["estimated_relative_error"].get<double>(), 0.0);
    const io::FloatImage image = io::read_exr(out / "a.exr");
    const auto at = [&](const char* channel, std::size_t x, std::size_t y) {
        const std::vector<float>* plane = image.find(channel);
        EXPECT_TRUE(plane) << channel;
        return plane ? plane->at(y * 64 + x) : 0.0f;
    };
    EXPECT_GT(at("G", 32, 30), 0.5f) << "the floor";
    EXPECT_EQ(at("sample_count.N", 32, 30), 16.0f);
    EXPECT_GT(at("variance.Y", 32, 30), 0.0f);
    // The red wall on the left colours what stands beside it.
    EXPECT_GT(at("R", 17, 22), 3.0f * at("B", 17, 22));
    EXPECT_FALSE(std::filesystem::exists(out / "a.exr.part")) << "a finished picture leaves no work behind";
}

TEST(PathMode, TheSameBytesForAnyNumberOfProcesses) {
    if (!have_mpirun()) GTEST_SKIP() << "no mpirun";
    const TemporaryFolder out;
    // 10 samples: three blocks, the last one short, fewer than five processes.
    const std::string render = " render " + room() + "--mode path --spp 10 --size 40x30 --aov all -o ";
    ASSERT_EQ(run_candela(render + (out / "0.exr")).exit_code, 0);
    for (const std::string ranks : {"1", "2", "5"}) {
        const std::string file = out / (ranks + ".exr");
        const std::string command = "mpirun --allow-run-as-root --oversubscribe -n " + ranks + " " +
                                    CANDELA_BINARY + render + file + " >" + (out / "log") + " 2>&1";
        ASSERT_EQ(std::system(command.c_str()), 0) << slurp(out / "log");
        EXPECT_EQ(slurp(file), slurp(out / "0.exr")) << ranks << " processes";
    }
}

TEST(PathMode, TimeLimitWritesWhatThereIsAndTheSameCommandGoesOn) {
    const TemporaryFolder out;
    const std::string command =
        "render " + room() + "--mode path --spp 8 --size 128x128 -o " + (out / "a.exr");
    const Outcome first = run_candela(command + " --time-limit 0.000001");
    ASSERT_EQ(first.exit_code, 0) << first.err;
    EXPECT_EQ(first.err.find("black"), std::string::npos) << "every tile has something: " << first.err;
    EXPECT_NE(first.err.find("goes on from"), std::string::npos) << first.err;
    EXPECT_TRUE(std::filesystem::exists(out / "a.exr.part"));
    EXPECT_EQ(run_candela(command).exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(out / "a.exr.part"));
    EXPECT_EQ(run_candela("render " + room() + "--mode path --spp 8 --size 128x128 -o " + (out / "b.exr"))
                  .exit_code,
              0);
    EXPECT_EQ(slurp(out / "a.exr"), slurp(out / "b.exr"));
}

TEST(PathMode, AFileThatIsNoCheckpointIsLeftAlone) {
    const TemporaryFolder out;
    std::ofstream(out / "notes.txt") << "mine";
    const Outcome run = run_candela("render " + room() + "--mode path --spp 1 --size 16x16 --checkpoint " +
                                    (out / "notes.txt") + " -o " + (out / "a.png"));
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find("notes.txt: is there already and is no checkpoint"), std::string::npos) << run.err;
    EXPECT_EQ(slurp(out / "notes.txt"), "mine");
}

TEST(PathMode, NumbersThatAreNoneAreUsage) {
    for (const char* option :
         {"--env-scale nan", "--env-scale -1", "--env-lux 0", "--env-lux 1e30", "--light-scale nan",
          "--look-from nan,1,1", "--env-rotate inf", "--time nan"}) {
        const Outcome run = run_candela("render " + room() + option + " -o x.png");
        EXPECT_EQ(run.exit_code, 2) << option;
        EXPECT_EQ(lines(run.err), 1u) << run.err;
    }
}

TEST(PathMode, OptionsThatDoNotFitAreUsage) {
    EXPECT_EQ(run_candela("render " + room() + "--max-bounces 3").exit_code, 2);
    EXPECT_EQ(run_candela("render " + room() + "--aov variance -o x.exr").exit_code, 2);
    EXPECT_EQ(run_candela("render " + room() + "--mode path --depth-of-field -o x.exr").exit_code, 2);
    EXPECT_EQ(run_candela("render " + room() + "--mode path --target-error 0 -o x.exr").exit_code, 2);
    EXPECT_EQ(run_candela("render " + room() + "--mode path --max-bounces -1 -o x.exr").exit_code, 2);
}

TEST(PathMode, TheRealTimeFrameShowsTheSamePixels) {
    const TemporaryFolder out;
    scenes::write_still_life(out.path());
    const std::string scene = (out / "still_life.glb") + " --stage " + (out / "still_life.stage.json") +
                              " --size 160x90 --aov all --spp 16 -o ";
    ASSERT_EQ(run_candela("render " + scene + (out / "frame.exr")).exit_code, 0);
    ASSERT_EQ(run_candela("render --mode path --max-bounces 0 " + scene + (out / "path.exr")).exit_code, 0);
    const io::FloatImage frame = io::read_exr(out / "frame.exr");
    const io::FloatImage path = io::read_exr(out / "path.exr");
    int same = 0;
    int same_material = 0;
    double normal_error = 0.0;
    constexpr std::size_t pixels = std::size_t{160} * 90;
    for (std::size_t i = 0; i < pixels; ++i) {
        const double z = (*frame.find("depth.Z"))[i];
        if (std::abs((*path.find("depth.Z"))[i] - z) <= 0.01 * z + 1e-6) ++same;
        if ((*path.find("material_index.I"))[i] == (*frame.find("material_index.I"))[i]) ++same_material;
        normal_error +=
            std::abs(static_cast<double>((*path.find("sh_normal.Y"))[i] - (*frame.find("sh_normal.Y"))[i]));
    }
    // Silhouettes differ by where in the pixel the samples fall.
    EXPECT_GT(same, 0.93 * pixels);
    EXPECT_GT(same_material, 0.93 * pixels);
    EXPECT_LT(normal_error / pixels, 0.02);
}
