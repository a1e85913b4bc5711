// `--env sky`: what the commands make of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "process.hpp"

namespace {

using candela::test::Outcome;
using candela::test::run_candela;
using candela::test::spit;
using candela::test::TemporaryFolder;

/// Illuminance in lx of level ground with nothing on it.
double level_lx(const std::string& arguments) {
    const TemporaryFolder folder;
    const std::string file = folder / "nothing.gltf";
    spit(file, R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{}]})");
    const std::string stage = folder / "sky.stage.json";
    spit(stage, R"({"environment": {"sky": {"elevation_deg": 35, "turbidity": 3}}})");
    const std::string staged = arguments == "stage" ? "--stage " + stage : arguments;
    const Outcome o = run_candela("meter " + file + " --at 0,0,0 --json " + staged);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    return o.exit_code == 0 ? nlohmann::json::parse(o.out).value("illuminance_lx", -1.0) : -1.0;
}

TEST(SkyOption, EveryModeReadsTheSameSunAndSky) {
    const std::string sky = "--env sky:elevation=35,turbidity=3";
    const double path = level_lx(sky + " --mode path --spp 256");
    // 76,343 lx across the rays of the sun and some 20,000 lx of sky (candela validate --only
    // hillaire2020_sky).
    EXPECT_NEAR(path, 76343.0 * std::sin(35.0 * 3.14159265 / 180.0) + 19950.0, 1200.0);
    EXPECT_NEAR(level_lx(sky + " --mode realtime") / path, 1.0, 0.02);
    EXPECT_NEAR(level_lx("stage") / path, 1.0, 0.01);
    EXPECT_NEAR(level_lx(sky + " --env-scale 0.5") / path, 0.5, 0.01);
    EXPECT_NEAR(level_lx(sky + " --env-rotate 90") / path, 1.0, 0.01);
}

TEST(SkyOption, AnIlluminanceIsThatOfSunAndSkyTogether) {
    EXPECT_NEAR(level_lx("--env sky --env-lux 1000 --mode path --spp 256"), 1000.0, 10.0);
}

TEST(SkyOption, WrongKeysAndValuesAreOneLine) {
    for (const char* wrong :
         {"elevaton=3", "turbidity=99", "albedo", "elevation=high", "azimuth=nan", "ozone=1e"}) {
        const TemporaryFolder folder;
        const std::string file = folder / "nothing.gltf";
        spit(file, R"({"asset": {"version": "2.0"}})");
        const Outcome o = run_candela("meter " + file + " --at 0,0,0 --env sky:" + wrong);
        EXPECT_EQ(o.exit_code, 2) << wrong;
        EXPECT_NE(o.err.find("--env sky"), std::string::npos) << o.err;
        EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
    }
}

}  // namespace
