#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "candela/io/environment_read.hpp"
#include "candela/io/image_write.hpp"
#include "candela/io/stage.hpp"
#include "process.hpp"

namespace candela::test {
namespace {

using nlohmann::json;

constexpr std::uint32_t kWidth = 128, kHeight = 64;

/// A grey sky of 1000 cd/m^2 with a sun of one texel.
void write_sky(const std::string& file, float sun_nit) {
    std::vector<float> plane(std::size_t{kWidth} * kHeight, 1000.0f);
    plane[std::size_t{16} * kWidth + 64] = sun_nit;
    const std::span<const float> pixels(plane);
    io::write_exr(file, kWidth, kHeight,
                  {{"R", io::PixelType::float32, pixels},
                   {"G", io::PixelType::float32, pixels},
                   {"B", io::PixelType::float32, pixels}},
                  {});
}

TEST(CliEnv, InfoSaysIlluminanceAndTheSun) {
    const TemporaryFolder folder;
    write_sky(folder / "sky.exr", 1e8f);
    const Outcome outcome = run_candela("env info " + (folder / "sky.exr") + " --json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json out = json::parse(outcome.out);
    const json sun = out["sun"];
    EXPECT_NEAR(double(sun["elevation_deg"]), 90.0 - 180.0 * 16.5 / 64, 0.01);
    EXPECT_NEAR(double(sun["azimuth_deg"]), 180.0 / 128, 0.01);
    EXPECT_NEAR(double(out["upward_illuminance_lx"]), 3141.59 + double(sun["upward_lx"]), 40.0);
    EXPECT_NE(run_candela("env info " + (folder / "sky.exr")).out.find("lx at normal incidence"),
              std::string::npos);
    const json scaled = json::parse(run_candela("env info --env-lux 500 --json " + (folder / "sky.exr")).out);
    EXPECT_NEAR(double(scaled["upward_illuminance_lx"]), 500.0, 0.01);
}

/// Lines of `text` that say that a file's level is relative.
std::size_t relative_lines(const std::string& text) {
    std::size_t count = 0;
    for (std::size_t at = text.find("relative: "); at != std::string::npos;
         at = text.find("relative: ", at + 1))
        ++count;
    return count;
}

TEST(CliEnv, ALevelThatNoPlaceHasIsSaidOnce) {
    const TemporaryFolder folder;
    const auto even = [&](const char* name, float value,
                          const std::map<std::string, io::ExrAttribute>& more) {
        const std::vector<float> plane(32, value);
        const std::span<const float> pixels(plane);
        io::write_exr(folder / name, 8, 4,
                      {{"R", io::PixelType::float32, pixels},
                       {"G", io::PixelType::float32, pixels},
                       {"B", io::PixelType::float32, pixels}},
                      more);
    };
    even("dim.exr", 0.73f, {});
    even("room.exr", 100.0f, {});
    even("glare.exr", 1.0e6f, {});
    even("night.exr", 0.01f, {{"whiteLuminance", 1.0f}});
    const std::string dim = folder / "dim.exr";
    const Outcome info = run_candela("env info " + dim);
    EXPECT_NE(info.err.find("dim.exr: relative: 2.293 lx up-facing; a sunset has about 400: --env-lux"),
              std::string::npos)
        << info.err;
    EXPECT_EQ(relative_lines(info.err), 1u);
    for (const char* how : {" --env-lux 400", " --env-scale 1"})
        EXPECT_EQ(relative_lines(run_candela("env info " + dim + how).err), 0u) << how;
    EXPECT_EQ(relative_lines(run_candela("env info " + (folder / "room.exr")).err), 0u);
    EXPECT_EQ(relative_lines(run_candela("env info " + (folder / "glare.exr")).err), 1u);
    EXPECT_EQ(relative_lines(run_candela("env info " + (folder / "night.exr")).err), 0u)
        << "it says its unit";
    const std::string file = folder / "nothing.gltf";
    spit(file, R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{}]})");
    const std::string meter = "meter " + file + " --at 0,0,0 --mode path --samples 4 --env ";
    EXPECT_EQ(relative_lines(run_candela(meter + dim).err), 1u);
    EXPECT_EQ(relative_lines(run_candela(meter + dim + " --env-lux 400").err), 0u);
    EXPECT_EQ(relative_lines(run_candela(meter + "studio").err), 0u);
    // What calibrate writes says that it is absolute.
    ASSERT_EQ(
        run_candela("env calibrate " + dim + " --grey-card 0,0,8,4 --value 0.5 -o " + (folder / "half.exr"))
            .exit_code,
        0);
    EXPECT_EQ(relative_lines(run_candela("env info " + (folder / "half.exr")).err), 0u);
}

TEST(CliEnv, CalibrationMakesTheCardItsLuminance) {
    const TemporaryFolder folder;
    write_sky(folder / "sky.exr", 1000.0f);
    const std::string command = "env calibrate " + (folder / "sky.exr") +
                                " --grey-card 10,40,20,5 --value 250 --json -o " + (folder / "out.exr");
    const Outcome outcome = run_candela(command);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NEAR(double(json::parse(outcome.out)["factor"]), 0.25, 1e-6);
    Diagnostics diagnostics;
    EXPECT_NEAR(io::read_environment(folder / "out.exr", diagnostics).luminance_nit[0].y, 250.0f, 0.01f);
    const Outcome outside =
        run_candela("env calibrate " + (folder / "sky.exr") + " --grey-card 120,0,20,5 --value 250");
    EXPECT_EQ(outside.exit_code, 1);
    EXPECT_NE(outside.err.find("128 x 64"), std::string::npos) << outside.err;
}

TEST(CliEnv, SplitWritesAStageThatGivesTheSameLight) {
    const TemporaryFolder folder;
    write_sky(folder / "sky.exr", 1e8f);
    const Outcome outcome =
        run_candela("env split " + (folder / "sky.exr") + " --json -o " + (folder / "split"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json out = json::parse(outcome.out);
    EXPECT_NEAR(double(out["total_after_lx"]) / double(out["total_before_lx"]), 1.0, 0.005);
    const io::Stage stage = io::load_stage(folder / "split/stage.json");
    ASSERT_EQ(stage.lights.size(), 1u);
    ASSERT_TRUE(stage.environment);
    Diagnostics diagnostics;
    scene::Scene scene;
    io::place_stage_lights(stage.lights, scene, diagnostics);
    EXPECT_NEAR(double{scene.lights[0].intensity} / double(out["sources"][0]["illuminance_lx"]), 1.0, 1e-4);
    for (const glm::vec3& t : io::read_environment(stage.environment->file, diagnostics).luminance_nit)
        ASSERT_NEAR(t.x, 1000.0f, 1.0f);
}

TEST(CliEnv, EveryModeSeesTheSunThatWasTakenOutAndNoLightIsLost) {
    const TemporaryFolder folder;
    write_sky(folder / "sky.exr", 1e8f);
    const std::string sky = folder / "sky.exr", file = folder / "nothing.gltf";
    spit(file, R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{}]})");
    const double lx = json::parse(run_candela("env info --json " + sky).out)["upward_illuminance_lx"];
    for (const char* how :
         {"--mode path", "--mode path --env-keep-sun", "--mode integrate", "--mode realtime"}) {
        const Outcome o = run_candela("meter " + file + " --at 0,0,0 --json --env " + sky + " " + how);
        ASSERT_EQ(o.exit_code, 0) << o.err;
        EXPECT_NEAR(double(json::parse(o.out)["illuminance_lx"]) / lx, 1.0, 0.01) << how;
    }
}

TEST(CliEnv, MistakesAreOneLineWithTheRightExitCode) {
    const TemporaryFolder folder;
    write_sky(folder / "sky.exr", 1000.0f);
    spit(folder / "broken.ktx2", std::string("\xabKTX 20\xbb\r\n\x1a\n", 12));
    spit(folder / "broken.dds", "DDS ");
    const std::string sky = folder / "sky.exr";
    const std::pair<std::string, int> cases[] = {
        {"env", 2},
        {"env info", 2},
        {"env info no.exr", 1},
        {"env info " + (folder / "broken.ktx2"), 1},
        {"env info " + (folder / "broken.dds"), 1},
        {"env info " + folder.path().string(), 1},
        {"env info " + sky + " --env-layout ball", 2},
        {"env info " + sky + " --env-layout cross", 1},
        {"env info " + sky + " --env-scale 0", 2},
        {"env calibrate " + sky + " --value 100", 2},
        {"env calibrate " + sky + " --grey-card 0,0,1,1 --value -1", 2},
        {"env calibrate " + sky + " --grey-card 0,0,0,1 --value 1", 1},
        {"env split " + sky, 2},
        {"env split " + sky + " -o " + sky, 1},
        {"env split " + sky + " --contrast 1 -o " + (folder / "x"), 2},
    };
    for (const auto& [arguments, code] : cases) {
        const Outcome outcome = run_candela(arguments);
        EXPECT_EQ(outcome.exit_code, code) << arguments << "\n" << outcome.err;
        EXPECT_EQ(lines(outcome.err), 1u) << arguments << "\n" << outcome.err;
        EXPECT_TRUE(outcome.out.empty()) << arguments;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "x"));
}

}  // namespace
}  // namespace candela::test
