#include <gtest/gtest.h>

#include <cstdlib>

#include "demo_scenes.hpp"
#include "process.hpp"

namespace candela::test {
namespace {

TEST(CliBake, WhatIsNoTableIsOneLineAndNoFile) {
    const TemporaryFolder folder;
    const Outcome outcome = run_candela("bake lct -o " + (folder / "table.bin"));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(lines(outcome.err), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find("candela bake ltc"), std::string::npos) << outcome.err;
    EXPECT_TRUE(outcome.out.empty());
    EXPECT_EQ(run_candela("bake").exit_code, 2);
}

// A second run finds what the first one kept; another scene does not.
TEST(CliBake, ProbesAreKeptInTheCacheByWhatTheyDependOn) {
    const TemporaryFolder folder;
    scenes::write_room(folder.path());
    ASSERT_EQ(setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1), 0);
    const std::string args = "bake probes " + (folder / "cornell_room.glb") + " --stage " +
                             (folder / "cornell_room.stage.json") + " --samples 16";
    EXPECT_NE(run_candela(args + " --json").out.find("\"cached\": false"), std::string::npos);
    EXPECT_NE(run_candela(args).out.find("found in"), std::string::npos);
    EXPECT_NE(run_candela(args + " --light-scale 2").out.find("found in"), std::string::npos)
        << "no punctual lights to scale";
    EXPECT_NE(run_candela(args + " --env studio").out.find("written to"), std::string::npos);
    EXPECT_NE(run_candela(args + " --refresh").out.find("written to"), std::string::npos);
    unsetenv("XDG_CACHE_HOME");
}

TEST(CliBake, PicturesOfProbesThatAreNotThereAreSaidNotToBe) {
    const TemporaryFolder folder;
    scenes::write_room(folder.path());
    ASSERT_EQ(setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1), 0);
    const Outcome outcome =
        run_candela("bake probes " + (folder / "cornell_room.glb") + " --stage " +
                    (folder / "cornell_room.stage.json") + " --samples 16 -o " + (folder / "pictures"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("1 irradiance volume: written to"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("reflection probes: none in the stage"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("nothing written into " + (folder / "pictures")), std::string::npos);
    EXPECT_EQ(outcome.err, "") << "and the volume stands well";
    unsetenv("XDG_CACHE_HOME");
}

// Said when the volumes are baked, and when they are found in the cache.
TEST(CliBake, AVolumeBeyondTheWallsIsWarnedOfEachTime) {
    const TemporaryFolder folder;
    scenes::write_room(folder.path());
    ASSERT_EQ(setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1), 0);
    spit(folder / "large.json", R"({"environment": {"none": true}, "irradiance_volumes": [
        {"name": "too large", "center": [0, 2.75, 0], "size_m": [11, 11, 11], "cells": [6, 6, 6]}]})");
    for (int run = 0; run < 2; ++run) {
        const Outcome outcome = run_candela("bake probes " + (folder / "cornell_room.glb") + " --stage " +
                                            (folder / "large.json") + " --samples 16");
        EXPECT_EQ(outcome.exit_code, 0);
        EXPECT_EQ(lines(outcome.err), 1u) << outcome.err;
        EXPECT_NE(outcome.err.find("\"too large\""), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("outside of the walls"), std::string::npos) << outcome.err;
    }
    unsetenv("XDG_CACHE_HOME");
}

TEST(CliBake, AStageWithoutProbesHasNothingToBake) {
    const TemporaryFolder folder;
    scenes::write_grey_card(folder.path());
    const Outcome outcome = run_candela("bake probes " + (folder / "grey_card.glb"));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("irradiance_volumes"), std::string::npos) << outcome.err;
    EXPECT_EQ(run_candela("bake probes").exit_code, 2);
}

}  // namespace
}  // namespace candela::test
