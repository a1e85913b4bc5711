#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "candela/io/image_read.hpp"
#include "candela/io/image_write.hpp"
#include "demo_scenes.hpp"
#include "process.hpp"
#include "test_pictures.hpp"

using namespace candela::test;
using candela::measure::Picture;
using nlohmann::json;

namespace {

void write_exr(const std::string& file, const Picture& picture,
               const std::map<std::string, candela::io::ExrAttribute>& attributes = {}) {
    std::vector<std::vector<float>> planes(3);
    for (const glm::vec3& p : picture.pixels)
        for (int c = 0; c < 3; ++c) planes[std::size_t(c)].push_back(p[c]);
    candela::io::write_exr(file, picture.width, picture.height,
                           {{"R", candela::io::PixelType::float32, std::span<const float>(planes[0])},
                            {"G", candela::io::PixelType::float32, std::span<const float>(planes[1])},
                            {"B", candela::io::PixelType::float32, std::span<const float>(planes[2])}},
                           attributes);
}

void write_png(const std::string& file, const Picture& picture) {
    std::vector<std::uint8_t> rgb;
    for (const glm::vec3& p : picture.pixels)
        for (int c = 0; c < 3; ++c) rgb.push_back(static_cast<std::uint8_t>(p[c] * 255.0f + 0.5f));
    candela::io::write_png(file, picture.width, picture.height, std::span<const std::uint8_t>(rgb));
}

Picture scaled(Picture picture, float factor) {
    for (glm::vec3& p : picture.pixels) p *= factor;
    return picture;
}

/// The metrics of the only picture that is not the reference.
json metrics_of(const Outcome& outcome) {
    const json out = json::parse(outcome.out, nullptr, false);
    EXPECT_FALSE(out.is_discarded()) << outcome.out << outcome.err;
    return out.is_discarded() ? json() : out["pictures"][0]["metrics"];
}

void expect_error(const Outcome& outcome, int exit_code, const std::string& mentions) {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(lines(outcome.err), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find(mentions), std::string::npos) << outcome.err;
}

class CompareCommand : public ::testing::Test {
  protected:
    void SetUp() override {
        write_exr(reference_, scaled(motley(40, 32), 100.0f), {{"candela/exposure", 0.01f}});
        write_exr(tested_, scaled(blurred(motley(40, 32), 1), 100.0f));
    }
    TemporaryFolder folder_;
    std::string reference_ = folder_ / "reference.exr";
    std::string tested_ = folder_ / "tested.exr";
};

}  // namespace

TEST_F(CompareCommand, SaysWhatIsDifferent) {
    const Outcome outcome = run_candela("compare " + tested_ + " " + reference_ + " --json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const json out = json::parse(outcome.out);
    EXPECT_EQ(out["reference"], "reference");
    EXPECT_EQ(out["unit"], "cd/m2");
    EXPECT_EQ(out["exposure_source"], "picture");
    EXPECT_NEAR(out["exposure"], 0.01, 1e-6);
    const json metrics = out["pictures"][0]["metrics"];
    EXPECT_GT(metrics["rmse"], 1.0);
    EXPECT_GT(metrics["flip"], 0.01);
    EXPECT_LT(metrics["ssim"], 1.0);
    EXPECT_NE(run_candela("compare " + tested_ + " " + reference_).out.find("hdr-flip"), std::string::npos);
}

TEST_F(CompareCommand, APictureEqualsItself) {
    const json m = metrics_of(run_candela("compare " + reference_ + " " + reference_ + " --json"));
    for (const char* name : {"rmse", "relmse", "mae", "max", "flip", "hdr_flip", "bias", "nonfinite"})
        EXPECT_EQ(m[name], 0.0) << name;
    EXPECT_TRUE(m["psnr"].is_null());
    EXPECT_EQ(m["ssim"], 1.0);
}

TEST_F(CompareCommand, ThresholdsDecideTheExitCode) {
    const std::string pair = "compare " + tested_ + " " + reference_;
    EXPECT_EQ(run_candela(pair + " --threshold flip=1 --threshold psnr=1 --threshold ssim=-1").exit_code, 0);
    const Outcome flip = run_candela(pair + " --threshold flip=0.0001");
    EXPECT_EQ(flip.exit_code, 1);
    EXPECT_NE(flip.err.find("flip"), std::string::npos);
    EXPECT_EQ(run_candela(pair + " --threshold psnr=90").exit_code, 1) << "psnr is a minimum";
    EXPECT_EQ(run_candela(pair + " --threshold ssim=0.9999999").exit_code, 1) << "ssim is a minimum";
    EXPECT_EQ(run_candela(pair + " --threshold rmse=1e9 --threshold hdr_flip=0").exit_code, 1);
    const std::string same = "compare " + reference_ + " " + reference_;
    EXPECT_EQ(run_candela(same + " --threshold psnr=90 --threshold flip=0 --threshold rmse=0").exit_code, 0);
    const Outcome reported = run_candela(pair + " --json --threshold max=0");
    EXPECT_EQ(reported.exit_code, 1);
    EXPECT_FALSE(json::parse(reported.out)["passed"]);
}

TEST_F(CompareCommand, WrongRequestsAreOneLine) {
    expect_error(run_candela("compare"), 2, "PICTURES");
    expect_error(run_candela("compare " + tested_), 2, "nothing to be compared");
    expect_error(run_candela("compare " + tested_ + " " + reference_ + " --threshold beauty=1"), 2, "relmse");
    expect_error(run_candela("compare " + tested_ + " " + reference_ + " --threshold flip=low"), 2, "low");
    expect_error(run_candela("compare " + tested_ + " " + reference_ + " -o a.txt"), 2, "a.txt");
    expect_error(run_candela("compare " + tested_ + " " + reference_ + " -o no/folder/a.html"), 1,
                 "no/folder");
    expect_error(run_candela("compare " + tested_ + " " + reference_ + " --names one"), 2, "--names");
    expect_error(run_candela("compare " + tested_ + " " + (folder_ / "none.exr")), 1, "none.exr");
    expect_error(run_candela("compare scene.glb " + reference_), 2, "scene");
    expect_error(run_candela("compare scene.glb --no-truth --profile best"), 2, "--profile");
}

TEST_F(CompareCommand, PicturesOfTwoSizesAreAnError) {
    const std::string small = folder_ / "small.exr";
    write_exr(small, motley(39, 32));
    expect_error(run_candela("compare " + small + " " + reference_), 1, "39x32");
}

TEST_F(CompareCommand, PixelsWithoutAValueAreSaidAndCanFail) {
    Picture holed = scaled(motley(40, 32), 100.0f);
    holed.pixels[7].x = std::nanf("");
    holed.pixels[9].z = std::numeric_limits<float>::infinity();
    const std::string file = folder_ / "holed.exr";
    write_exr(file, holed);
    const Outcome outcome = run_candela("compare " + file + " " + reference_ + " --json");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(metrics_of(outcome)["nonfinite"], 2.0);
    EXPECT_EQ(metrics_of(outcome)["rmse"], 0.0);
    EXPECT_NE(outcome.err.find("2 pixels"), std::string::npos) << outcome.err;
    EXPECT_EQ(run_candela("compare " + file + " " + reference_ + " --threshold nonfinite=0").exit_code, 1);
}

TEST_F(CompareCommand, DisplayPicturesAreComparedAsTheyAre) {
    const std::string a = folder_ / "a.png", b = folder_ / "b.png";
    write_png(a, uniform(16, 16, glm::vec3(0.6f)));
    write_png(b, uniform(16, 16, glm::vec3(0.4f)));
    const json m = metrics_of(run_candela("compare " + a + " " + b + " --json"));
    EXPECT_NEAR(m["rmse"], 0.2, 1e-6);
    EXPECT_NEAR(m["psnr"], -20.0 * std::log10(0.2), 1e-4);
    EXPECT_FALSE(m.contains("hdr_flip"));
    expect_error(run_candela("compare " + a + " " + b + " --threshold hdr-flip=1"), 2, "hdr-flip");
}

TEST_F(CompareCommand, LuminanceBesideADisplayPictureIsExposed) {
    // 50 cd/m2 at an exposure of 0.01 without a curve is 0.5 of white: code value 188.
    const std::string light = folder_ / "light.exr", shown = folder_ / "shown.png";
    write_exr(light, uniform(16, 16, glm::vec3(50.0f)), {{"candela/exposure", 0.01f}});
    write_png(shown, uniform(16, 16, glm::vec3(188.0f / 255.0f)));
    const Outcome outcome = run_candela("compare " + light + " " + shown + " --tonemap none --json");
    EXPECT_LT(metrics_of(outcome)["max"], 0.5 / 255.0) << outcome.out;
    EXPECT_NE(outcome.err.find("warning"), std::string::npos);
}

TEST_F(CompareCommand, ErrorMapsHoldTheDifference) {
    const std::string exr = folder_ / "diff.exr", png = folder_ / "diff.png";
    ASSERT_EQ(run_candela("compare " + tested_ + " " + reference_ + " -o " + exr + " -o " + png).exit_code,
              0);
    const auto map = candela::io::read_exr(exr);
    ASSERT_NE(map.find("R"), nullptr);
    ASSERT_NE(map.find("flip.Y"), nullptr);
    ASSERT_NE(map.find("hdr_flip.Y"), nullptr);
    const auto a = candela::io::read_exr(tested_), b = candela::io::read_exr(reference_);
    for (std::size_t i = 0; i < map.find("G")->size(); ++i)
        EXPECT_FLOAT_EQ((*map.find("G"))[i], std::abs((*a.find("G"))[i] - (*b.find("G"))[i]));
    const auto picture = candela::io::decode_image(candela::io::read_file(png, 1u << 24), png);
    EXPECT_EQ(picture.width, 40u);
}

TEST_F(CompareCommand, TheReportKeepsHostileNamesInside) {
    const std::string report = folder_ / "report.html";
    const Outcome outcome = run_candela("compare " + tested_ + " " + reference_ + " -o " + report +
                                        " --names '</script><script>alert(1)</script>,<!--SHADER-->'");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string page = slurp(report);
    EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
    EXPECT_EQ(page.find("http://"), std::string::npos) << "nothing comes from a network";
    EXPECT_EQ(page.find("https://"), std::string::npos);
}

TEST_F(CompareCommand, AScenesFrameIsComparedWithItsTruth) {
    for (const auto& demo : candela::scenes::demos()) demo.write(folder_.path());
    const std::string scene = folder_ / "sphere_grid.glb";
    const std::string report = folder_ / "report.html";
    const Outcome outcome = run_candela(
        "compare " + scene + " --stage " + (folder_ / "sphere_grid.stage.json") +
        " --size 96x54 --samples 1 --path-spp 4 --integrate-spp 1 --profile best --profile mobile --json "
        "-o " +
        report);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json out = json::parse(outcome.out);
    EXPECT_EQ(out["reference"], "path");
    ASSERT_EQ(out["pictures"].size(), 3u);
    EXPECT_EQ(out["pictures"][0]["name"], "realtime best");
    EXPECT_EQ(out["pictures"][1]["name"], "realtime mobile");
    EXPECT_EQ(out["pictures"][2]["name"], "integrate");
    EXPECT_GT(out["pictures"][0]["metrics"]["flip"], 0.0);
    EXPECT_EQ(out["pictures"][0]["verdict"].get<std::string>().rfind("realtime best ", 0), 0u);
    EXPECT_GT(out["reference_noise"]["flip"], 0.0);
    EXPECT_TRUE(std::filesystem::exists(report));
    EXPECT_NE(slurp(report).find("--integrate-spp 1 --profile best"), std::string::npos)
        << "the command line";
    // The paths add up to what is seen but the background, each on its side.
    const json& paths = out["pictures"][0]["light_paths"];
    ASSERT_EQ(paths.size(), 7u);
    double share = 0.0;
    for (const json& row : paths) share += row["share"].get<double>();
    EXPECT_NEAR(share, 1.0, 1e-6);
    EXPECT_GT(paths[2]["reference_mean_nit"], 0.0) << "the environment is no direct light";
    EXPECT_NEAR(paths[2]["mean_nit"].get<double>() / paths[2]["reference_mean_nit"].get<double>(), 1.0, 0.5);
    // Spheres hide some of the environment from each other, which the frame does not see.
    EXPECT_EQ(paths[6]["path"], "occlusion (in environment)");
    EXPECT_GT(paths[6]["reference_mean_nit"], 0.0);
    EXPECT_LT(paths[6]["reference_mean_nit"], 0.5 * (paths[2]["reference_mean_nit"].get<double>() +
                                                     paths[3]["reference_mean_nit"].get<double>()));
    EXPECT_EQ(paths[6]["mean_nit"], 0.0);
    EXPECT_EQ(paths[6]["share"], 0.0);
}

// Noise of the reference is not light of another path.
TEST_F(CompareCommand, WhereAllLightIsDirectNothingIsIndirect) {
    for (const auto& demo : candela::scenes::demos()) demo.write(folder_.path());
    const json out = json::parse(
        run_candela("compare " + (folder_ / "lamps.glb") + " --stage " + (folder_ / "lamps.stage.json") +
                    " --size 64x36 --samples 1 --json --modes realtime,path --path-spp 4 "
                    "--direct-only")
            .out);
    const json& paths = out["pictures"][0]["light_paths"];
    EXPECT_GT(paths[0]["reference_mean_nit"], 0.0);
    for (const std::size_t indirect : {2u, 3u}) {
        EXPECT_EQ(paths[indirect]["reference_mean_nit"], 0.0);
        EXPECT_EQ(paths[indirect]["mean_absolute_difference_nit"], 0.0);
    }
}

TEST_F(CompareCommand, AModeThatIsNotNamedIsLeftOut) {
    for (const auto& demo : candela::scenes::demos()) demo.write(folder_.path());
    const std::string command = "compare " + (folder_ / "lamps.glb") + " --stage " +
                                (folder_ / "lamps.stage.json") + " --size 64x36 --samples 1 --json ";
    const json out = json::parse(run_candela(command + "--modes realtime,path --path-spp 4").out);
    ASSERT_EQ(out["pictures"].size(), 1u);
    EXPECT_EQ(out["pictures"][0]["name"], "realtime");
    EXPECT_EQ(out["reference"], "path");
    // Direct light is that of the lights on both sides, and shadows take away about as much.
    const json& paths = out["pictures"][0]["light_paths"];
    ASSERT_EQ(paths.size(), 6u);
    EXPECT_GT(paths[0]["reference_mean_nit"], 0.0);
    EXPECT_NEAR(paths[0]["mean_nit"].get<double>() / paths[0]["reference_mean_nit"].get<double>(), 1.0, 0.2);
    EXPECT_EQ(
        json::parse(run_candela(command + "--modes realtime,integrate --integrate-spp 1").out)["reference"],
        "integrate");
    expect_one_line(run_candela(command + "--modes path"), 2,
                    "--samples: has no effect without the mode realtime");
    expect_one_line(run_candela(command + "--modes realtime,path --integrate-spp 4"), 2,
                    "--integrate-spp: has no effect without the mode integrate");
}
