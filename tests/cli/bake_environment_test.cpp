#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "process.hpp"

namespace candela::test {
namespace {

TEST(CliBakeEnvironment, StudioBecomesCubesHarmonicsAndMetadata) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_candela("bake studio --size 32 --irradiance-size 8 --json -o " + (folder / "studio"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["levels"], 6);
    EXPECT_EQ(report["technique"], "harmonic");
    EXPECT_TRUE(std::filesystem::exists(folder / "studio/environment.json"));
    for (const auto& file : report["files"])
        EXPECT_TRUE(
            std::filesystem::exists(std::filesystem::path(folder / "studio") / file.get<std::string>()))
            << file;
}

TEST(CliBakeEnvironment, EachPresetGetsWhatItAsksFor) {
    const TemporaryFolder folder;
    for (const char* preset : {"filament", "gltf"}) {
        const Outcome outcome =
            run_candela("bake studio --size 64 --preset " + std::string(preset) + " -o " + (folder / preset));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    }
}

TEST(CliBakeEnvironment, WrongNamesAreOneLine) {
    const TemporaryFolder folder;
    for (const char* wrong : {"--technique fast", "--mapping cubic", "--preset unreal", "--format png"}) {
        const Outcome outcome = run_candela("bake studio -o " + (folder / "x") + " " + wrong);
        EXPECT_EQ(outcome.exit_code, 2) << wrong;
        EXPECT_EQ(lines(outcome.err), 1u) << outcome.err;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "x"));
}

TEST(CliBakeDfg, WritesTableAndWhatItMeans) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_candela("bake dfg --dfg-size 8 --visibility uncorrelated --json -o " + (folder / "dfg.exr"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(outcome.out)["visibility"], "uncorrelated");
    EXPECT_TRUE(std::filesystem::exists(folder / "dfg.exr"));
    EXPECT_TRUE(std::filesystem::exists(folder / "dfg.json"));
    EXPECT_EQ(run_candela("bake dfg -o " + (folder / "dfg.png")).exit_code, 2);
}

}  // namespace
}  // namespace candela::test
