#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "demo_scenes.hpp"
#include "process.hpp"

using namespace candela::test;
using nlohmann::json;

namespace {

void write(const std::string& file, const std::string& text) {
    std::ofstream(file) << text;
}

json light_of(const Outcome& outcome, const std::string& name) {
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const json out = json::parse(outcome.out);
    for (const json& light : out["scene"]["lights"]) {
        if (light["name"] == name) return light;
    }
    ADD_FAILURE() << "no light " << name << " in " << outcome.out;
    return {};
}

const std::string& picture_options() {
    static const std::string options = " --size 96x64 --samples 1 --ev100 9 --env none";
    return options;
}

}  // namespace

TEST(LightCommands, InfoShowsEveryUnitThatApplies) {
    const TemporaryFolder folder;
    candela::scenes::write_grey_plane(folder.path());
    write(folder / "a.json",
          R"({"lights": [{"name": "Ball", "type": "sphere", "radius_m": 0.15, "power_lm": 1500},
        {"name": "Lamp", "type": "spot", "power_w": 10, "efficacy_lm_per_w": 100, "outer_cone_deg": 30}]})");
    const std::string command = "info " + (folder / "grey_plane.glb") + " --stage " + (folder / "a.json");
    const Outcome outcome = run_candela(command + " --json");
    const json ball = light_of(outcome, "Ball");
    // The example under Frostbite Table 12.
    EXPECT_NEAR(ball["luminance_nit"].get<double>(), 1688.0, 1.0);
    EXPECT_NEAR(ball["power_lm"].get<double>(), 1500.0, 0.01);
    EXPECT_NEAR(ball["intensity_cd"].get<double>(), 1500.0 / (4.0 * M_PI), 0.01);
    EXPECT_NEAR(ball["ev100"].get<double>(), std::log2(1688.7) + 3.0, 1e-3);
    EXPECT_EQ(ball["carrier"], "stage");
    const json lamp = light_of(outcome, "Lamp");
    EXPECT_NEAR(lamp["power_w"].get<double>(), 10.0, 1e-3);
    EXPECT_NEAR(lamp["intensity_cd"].get<double>(), 1000.0 / M_PI, 0.01);
    EXPECT_LT(lamp["emitted_lm"].get<double>(), 0.3 * lamp["power_lm"].get<double>());
    const std::string text = run_candela(command).out;
    EXPECT_NE(text.find("Ball: sphere radius 0.15 m (stage)"), std::string::npos) << text;
    EXPECT_NE(text.find("EV100 13.72"), std::string::npos) << text;
}

TEST(LightCommands, AConvertedSceneGivesTheSamePicture) {
    const TemporaryFolder folder;
    candela::scenes::write_still_life(folder.path());
    const std::string scene = folder / "still_life.glb", copy = folder / "copy.gltf";
    const Outcome outcome = run_candela("convert " + scene + " -o " + copy);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out + outcome.err, "candela: wrote " + copy + "\n") << "and no warning";
    EXPECT_TRUE(std::filesystem::exists(folder / "copy.bin"));
    EXPECT_EQ(run_candela("render " + scene + picture_options() + " -o " + (folder / "a.png")).exit_code, 0);
    EXPECT_EQ(run_candela("render " + copy + picture_options() + " -o " + (folder / "b.png")).exit_code, 0);
    EXPECT_GT(slurp(folder / "a.png").size(), 1000u);
    // Positions are written in other units than they are drawn in: the last bit may differ.
    const Outcome compared =
        run_candela("compare " + (folder / "b.png") + " " + (folder / "a.png") + " --json");
    EXPECT_LT(json::parse(compared.out)["pictures"][0]["metrics"]["flip"].get<double>(), 1e-3)
        << compared.err;
}

TEST(LightCommands, ConvertSaysWhatItCannotWriteAndRefusesWhatItMustNot) {
    const TemporaryFolder folder;
    candela::scenes::write_grey_plane(folder.path());
    const std::string scene = folder / "grey_plane.glb";
    write(folder / "a.json",
          R"({"lights": [{"name": "Ball", "type": "sphere", "radius_m": 0.15, "power_lm": 1500}],
        "exposure": {"ev100": 9}})");
    const Outcome outcome =
        run_candela("convert " + scene + " --stage " + (folder / "a.json") + " -o " + (folder / "b.glb"));
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(lines(outcome.err), 3u) << outcome.err;
    EXPECT_NE(outcome.err.find("light Ball"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("exposure"), std::string::npos) << outcome.err;

    EXPECT_EQ(run_candela("convert " + scene + " -o " + scene).exit_code, 2);
    EXPECT_EQ(run_candela("convert " + scene + " -o " + (folder / "b.obj")).exit_code, 2);
    EXPECT_EQ(run_candela("convert " + scene + " -o " + (folder / "no/b.glb")).exit_code, 1);
    EXPECT_EQ(run_candela("info " + scene + " --light-units lumen").exit_code, 2);
}

TEST(LightCommands, BlendersRawWattsBecomeCandela) {
    const TemporaryFolder folder;
    candela::scenes::write_lamps(folder.path());
    const std::string scene = folder / "lamps.glb";
    const json spec = json::parse(run_candela("info " + scene + " --json").out)["scene"]["lights"];
    const json raw =
        json::parse(run_candela("info " + scene + " --light-units raw --json").out)["scene"]["lights"];
    ASSERT_FALSE(spec.empty());
    for (std::size_t i = 0; i < spec.size(); ++i) {
        const bool distant = spec[i]["type"] == "directional";
        const char* key = distant ? "illuminance_lx" : "intensity_cd";
        EXPECT_NEAR(raw[i][key].get<double>() / spec[i][key].get<double>(),
                    distant ? 683.0 : 683.0 / (4.0 * M_PI), 1e-3);
    }
}
