#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "candela/io/image_read.hpp"
#include "demo_scenes.hpp"
#include "process.hpp"

using namespace candela::test;

namespace {

constexpr float kPi = 3.14159265f;

/// The generated demo scenes, written once for all tests of this program.
const TemporaryFolder& scenes() {
    static const TemporaryFolder folder;
    static const bool written = [] {
        for (const auto& demo : candela::scenes::demos()) demo.write(folder.path());
        return true;
    }();
    (void)written;
    return folder;
}

std::string scene_file(const std::string& name) {
    for (const char* extension : {".glb", ".gltf"}) {
        const std::string file = scenes() / (name + extension);
        if (std::filesystem::exists(file)) return file;
    }
    ADD_FAILURE() << "no generated scene " << name;
    return {};
}

float center_red(const candela::io::FloatImage& image) {
    const std::vector<float>* red = image.find("R");
    return red ? red->at(std::size_t{image.height / 2} * image.width + image.width / 2) : std::nanf("");
}

}  // namespace

TEST(CommandLine, AMissingSceneIsExitCodeOneAndOneLine) {
    expect_one_line(run_candela("render no/such/scene.glb -o /tmp/never.png"), 1, "no/such/scene.glb");
    EXPECT_FALSE(std::filesystem::exists("/tmp/never.png"));
}

TEST(CommandLine, WrongUseIsExitCodeTwo) {
    expect_one_line(run_candela("render"), 2, "SCENE");
    expect_one_line(run_candela("render scene.glb --size 0x10"), 2, "--size");
    expect_one_line(run_candela("render scene.glb --size 12"), 2, "--size");
    expect_one_line(run_candela("render scene.glb --shadows ray"), 2, "--mode path for rays");
    expect_one_line(run_candela("render scene.glb --mode path --shadows map"), 2, "--shadows ray or none");
    expect_one_line(run_candela("render scene.glb -o picture.bmp"), 2, "picture.bmp");
    expect_one_line(run_candela("render scene.glb --aov beauty -o a.exr"), 2, "beauty");
    expect_one_line(run_candela("render scene.glb --tonemap filmic"), 2, "tonemap");
    expect_one_line(run_candela("fly"), 2, "");
    expect_one_line(run_candela("render " + scene_file("grey_plane") + " --aperture 8"), 2, "shutter");
    expect_one_line(
        run_candela("render " + scene_file("grey_plane") + " --shutter 1/0 --aperture 8 --iso 100"), 2,
        "--shutter");
}

TEST(CommandLine, WhatTheRequestNamesMustExist) {
    const std::string scene = scene_file("grey_plane");
    expect_one_line(run_candela("render " + scene + " --camera nobody"), 1, "nobody");
    expect_one_line(run_candela("render " + scene + " --env missing.exr"), 1, "missing.exr");
    expect_one_line(run_candela("render " + scene + " --stage missing.json"), 1, "missing.json");
    expect_one_line(run_candela("render " + scene + " -o no/such/folder/a.png"), 1, "no/such/folder");
}

TEST(CommandLine, HelpAndVersionGoToStandardOutput) {
    const Outcome help = run_candela("render --help");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.out.find("--ev100"), std::string::npos);
    EXPECT_EQ(run_candela("--version").out.rfind("candela ", 0), 0u);
}

// The whole way: glTF, shading, frame, EXR, in absolute cd/m^2.
TEST(CommandLine, TheGreyPlaneReadsTenThousandLuxTimesAlbedoOverPi) {
    const TemporaryFolder out;
    const Outcome run = run_candela("render " + scene_file("grey_plane") +
                                    " --env none --profile ue4 --size 64x64 --ev100 12 --exr-type float -o " +
                                    (out / "a.exr"));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const float expected_nit = 10000.0f * 0.5f / kPi;
    EXPECT_NEAR(center_red(candela::io::read_exr(out / "a.exr")), expected_nit, 0.005f * expected_nit);
}

TEST(CommandLine, JsonIsTheOnlyThingOnStandardOutput) {
    const TemporaryFolder out;
    const Outcome run =
        run_candela("render " + scene_file("grey_plane") + " --size 32x32 --json -o " + (out / "a.png"));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["width"], 32);
    EXPECT_TRUE(json["automatic_exposure"]);
    EXPECT_GT(json["passes"].size(), 2u);
    const auto info = nlohmann::json::parse(run_candela("info " + scene_file("lamps") + " --json").out);
    EXPECT_GE(info["scene"]["lights"].size(), 3u);
    const auto bench = nlohmann::json::parse(
        run_candela("bench " + scene_file("sphere_grid") + " --size 64x64 --frames 3 --json").out);
    EXPECT_GT(bench["frame_ms_median"], 0.0);
    const TemporaryFolder graphs;
    const std::string svg = (graphs / "frame.svg");
    EXPECT_EQ(run_candela("bench " + scene_file("sphere_grid") + " --size 64x64 --frames 1 --graph " + svg)
                  .exit_code,
              0);
    EXPECT_NE(slurp(svg).find("gbuffer"), std::string::npos);
    EXPECT_EQ(run_candela("bench " + scene_file("sphere_grid") + " --graph frame.png").exit_code, 2);
    EXPECT_GT(bench["peak_host_mib"], 1.0);
    EXPECT_GT(bench["start_to_first_frame_ms_cold"], 0.0);
    EXPECT_GT(bench["start_to_first_frame_ms_warm"], 0.0);
}

TEST(CommandLine, TwoRunsGiveTheSameBytesAndSeveralOutputsOnePicture) {
    const TemporaryFolder out;
    const std::string args = "render " + scene_file("sphere_grid") + " --env studio --size 96x54 --aov all";
    ASSERT_EQ(run_candela(args + " -o " + (out / "a.png") + " -o " + (out / "a.exr")).exit_code, 0);
    ASSERT_EQ(run_candela(args + " -o " + (out / "b.png") + " -o " + (out / "b.exr")).exit_code, 0);
    EXPECT_EQ(slurp(out / "a.png"), slurp(out / "b.png"));
    EXPECT_EQ(slurp(out / "a.exr"), slurp(out / "b.exr"));
    const auto exr = candela::io::read_exr(out / "a.exr");
    for (const char* channel : {"albedo.R", "sh_normal.Z", "depth.Z", "direct_diffuse.G",
                                "indirect_specular.B", "emissive.R", "shape_index.I", "material_index.I"}) {
        EXPECT_NE(exr.find(channel), nullptr) << channel;
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(out.path()), {}), 4)
        << "no temporary file stays behind";
}

TEST(CommandLine, ModesAreNamedInWhatTheyWrite) {
    const TemporaryFolder folder;
    const std::string file = folder / "plane.exr";
    const std::string arguments = " --size 16x16 --ev100 10 --json -o " + file;
    const auto json_of = [&](const std::string& mode) {
        const Outcome outcome = run_candela("render " + scene_file("grey_plane") + mode + arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out);
    };
    const auto has = [&](const std::string& text) {
        const auto bytes = candela::io::read_file(file, 1u << 20);
        return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).find(text) !=
               std::string_view::npos;
    };
    EXPECT_EQ(json_of("")["mode"], "realtime");
    EXPECT_TRUE(has("realtime"));
    const auto integrated = json_of(" --mode integrate");
    EXPECT_EQ(integrated["mode"], "integrate");
    EXPECT_EQ(integrated["samples"], 64);
    EXPECT_TRUE(has("integrate"));
    EXPECT_NEAR(center_red(candela::io::read_exr(file)) / (10000.0f * 0.5f / kPi), 1.0f, 0.01f);
    expect_one_line(run_candela("render scene.glb --mode guess"), 2, "--mode");
}

TEST(CommandLine, AnUnlitSceneGetsTheStudioAndSaysSo) {
    const TemporaryFolder out;
    const Outcome run =
        run_candela("render " + scene_file("sphere_grid") + " --size 64x36 -o " + (out / "a.exr"));
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_NE(run.err.find("studio"), std::string::npos) << run.err;
    const float lit = center_red(candela::io::read_exr(out / "a.exr"));
    EXPECT_GT(lit, 0.0f);
    // The options of an environment are the studio's too.
    ASSERT_EQ(run_candela("render " + scene_file("sphere_grid") + " --env-scale 3 --size 64x36 -o " +
                          (out / "b.exr"))
                  .exit_code,
              0);
    EXPECT_NEAR(center_red(candela::io::read_exr(out / "b.exr")) / lit, 3.0f, 0.03f);
}

TEST(CommandLine, EnvironmentsAreBackgroundUnlessHidden) {
    const TemporaryFolder out;
    const auto corner = [&](const std::string& option) {
        EXPECT_EQ(run_candela("render " + scene_file("sphere_grid") + " --env studio --size 32x18 " + option +
                              " -o " + (out / "a.exr"))
                      .exit_code,
                  0);
        return candela::io::read_exr(out / "a.exr").find("R")->front();
    };
    EXPECT_GT(corner(""), 1.0f);
    EXPECT_EQ(corner("--env-hidden"), 0.0f);
}

TEST(CommandLine, EnvLuxSetsTheUpFacingIlluminance) {
    const TemporaryFolder out;
    const auto brightness = [&](int lux) {
        const Outcome run = run_candela("render " + scene_file("sphere_grid") + " --env studio --env-lux " +
                                        std::to_string(lux) + " --ev100 8 --size 64x36 --exr-type float -o " +
                                        (out / "a.exr"));
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return center_red(candela::io::read_exr(out / "a.exr"));
    };
    EXPECT_NEAR(brightness(5000) / brightness(500), 10.0f, 0.05f);
}
