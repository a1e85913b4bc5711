// What a stranger types: one line that says what to do, and the exit code that the README promises.
#include <cmath>
#include <nlohmann/json.hpp>

#include "candela/io/image_write.hpp"
#include "demo_scenes.hpp"
#include "process.hpp"

namespace candela::test {
namespace {

const TemporaryFolder& scenes() {
    static const TemporaryFolder folder;
    static const bool written = (scenes::write_grey_plane(folder.path()), true);
    (void)written;
    return folder;
}

std::string plane() {
    return scenes() / "grey_plane.glb";
}

TEST(Messages, AMisspeltCommandOrOptionGetsItsNeighbour) {
    expect_one_line(run_candela("rendr scene.glb"), 2, "rendr: no such command (did you mean render?)");
    expect_one_line(run_candela("env inof sky.exr"), 2, "inof: no such command (did you mean info?)");
    expect_one_line(run_candela("render scene.glb --sise 8x8"), 2,
                    "--sise: no such option of candela render (did you mean --size?)");
    expect_one_line(run_candela("render scene.glb --tonemapp=aces"), 2, "did you mean --tonemap?");
    expect_one_line(run_candela("render scene.glb --denoise"), 2,
                    "no such option of candela render (there is no denoiser: more --samples");
    expect_one_line(run_candela("render scene.glb --fov 40"), 2, "(did you mean --focal-mm?)");
    expect_one_line(run_candela("render scene.glb --look 1,2,3"), 2, "--look-from or --look-at?");
    expect_one_line(run_candela("my/scene.glb -o a.png"), 2,
                    "no command, but a file (did you mean candela render my/scene.glb?)");
    expect_one_line(run_candela("lamp.ies"), 2, "candela light lamp.ies");
    expect_one_line(run_candela("help rendr"), 2, "rendr: no such command (did you mean render?)");
    expect_one_line(run_candela(""), 2, "needs a command: render");
    expect_one_line(run_candela("env"), 2, "needs a command: info, calibrate, split");
    expect_one_line(run_candela("render scene.glb extra"), 2, "extra: not expected (candela render --help)");
    expect_one_line(run_candela("render scene.glb --size"), 2, "--size: needs a value");
    expect_one_line(run_candela("render scene.glb --seed -1"), 2, "--seed: not what it takes: -1");
    expect_one_line(run_candela("meter scene.glb --at 0,0"), 2, "--at: needs 3 values and has 2");
    expect_one_line(run_candela("info scene.glb --light-units ell"), 2, "--light-units: ell not in {");
    // Before anything is rendered.
    expect_one_line(run_candela("compare scene.glb --names a"), 2, "--names: as many names as pictures");
    expect_one_line(run_candela("--size 4x4 render s.glb"), 2, "--size: stands before the command");
    expect_one_line(run_candela("\"$(printf 'two\\nlines')\""), 2, "two?lines: no such command");
}

// What the program itself has a list of is usage, wherever it stands: 2. What a file lacks is 1.
TEST(Messages, UnknownValuesOfOptionsAreUsage) {
    const std::string render = "render " + plane();
    expect_one_line(run_candela(render + " --profile phong"), 2, "--profile: no such profile: phong");
    expect_one_line(run_candela(render + " --tonemap filmic"), 2, "--tonemap");
    expect_one_line(run_candela(render + " --mode guess"), 2, "--mode");
    expect_one_line(run_candela(render + " --aov beauty -o a.exr"), 2, "beauty");
    expect_one_line(run_candela(render + " --device 4711"), 2, "--device 4711: no such device");
    expect_one_line(run_candela("validate --only karis2013_figur2"), 2, "did you mean");
    expect_one_line(run_candela("validate --only ''"), 2, "--only");
    expect_one_line(run_candela("bake studio --technique fast"), 2, "fast");
    expect_one_line(run_candela("bake dfg --visibility none"), 2, "--visibility");
    expect_one_line(run_candela("bake ltc -o table.json"), 2, "table.json");
    spit(scenes() / "profile.json", R"({"base": "phong"})");
    expect_one_line(run_candela(render + " --profile " + (scenes() / "profile.json")), 1,
                    "profile.json: /base: no such profile: phong");
    spit(scenes() / "profile.json", R"({"base": "ue4", "falloff-offset-m2": -1})");
    expect_one_line(run_candela(render + " --profile " + (scenes() / "profile.json")), 1,
                    "profile.json: /falloff-offset-m2: is not from 0 to 1e6 m^2");
    expect_one_line(run_candela(render + " --camera nobody"), 1, "nobody");
}

// nan is not outside of any range.
TEST(Messages, NotANumberIsNoNumberOfAnyOption) {
    for (const char* arguments :
         {"bake studio --env-rotate nan", "bake studio --env-rotate 1e30", "bake studio --env-scale nan",
          "render s.glb --mode path --time-limit nan", "render s.glb --mode path --target-error nan",
          "render s.glb --mode path --depth-of-field --focus-m nan", "render s.glb --ev100 nan",
          "render s.glb --mode path --checkpoint-every nan", "render s.glb --focal-mm nan",
          "compare a.exr b.exr --exposure nan", "compare a.exr b.exr --pixels-per-degree nan",
          "meter s.glb --from 0,0,0 --towards 0,1,0 --field-deg nan"}) {
        SCOPED_TRACE(arguments);
        expect_one_line(run_candela(arguments), 2, "not in range");
    }
}

TEST(Messages, AnEmptyValueIsNone) {
    expect_one_line(run_candela("render s.glb --stage ''"), 2, "--stage: has no value");
    expect_one_line(run_candela("render s.glb --env ''"), 2, "--env: has no value");
    expect_one_line(run_candela("render ''"), 2, "SCENE: has no value");
    expect_one_line(run_candela("env info ''"), 2, "ENV: has no value");
    expect_one_line(run_candela("compare '' b.exr"), 2, "PICTURES: has no value");
}

TEST(Messages, FilesThatAreNotWhatTheyShouldBe) {
    const TemporaryFolder folder;
    spit(folder / "empty.glb", "");
    spit(folder / "list.json", "[]");
    spit(folder / "no_env.json", R"({"environment": {"file": "missing.exr"}})");
    spit(folder / "no_ies.json", R"({"lights": [{"type": "point", "profile": "missing.ies"}]})");
    const std::string staged = "render " + plane() + " -o " + (folder / "a.png") + " --stage ";
    expect_one_line(run_candela(staged + CANDELA_BINARY), 1, "not a stage: a program");
    expect_one_line(run_candela(staged + plane()), 1, "not a stage: a binary glTF scene");
    expect_one_line(run_candela(staged + (folder / "empty.glb")), 1, "the file is empty");
    expect_one_line(run_candela(staged + (folder / "list.json")), 1, "list.json: a stage is a JSON object");
    expect_one_line(run_candela(staged + (folder / "no_env.json")), 1,
                    "no_env.json:1:18: /environment/file: " + (folder / "missing.exr") + ": no such file");
    expect_one_line(run_candela(staged + (folder / "no_ies.json")), 1,
                    "no_ies.json:1:31: /lights/0/profile: ");
    expect_one_line(run_candela("info " + (folder / "empty.glb")), 1, "empty.glb: the file is empty");
    expect_one_line(run_candela("info " CANDELA_BINARY), 1, "not glTF: a program");
    const Outcome plot = run_candela("light a.ies --plot a.bmp");
    expect_one_line(plot, 2, "--plot: a.bmp is neither .svg nor .png");
    EXPECT_EQ(plot.err.find("--plot: --plot"), std::string::npos) << plot.err;
}

// One rule for every -o: the last folder is made, its parent is not.
TEST(Messages, OnlyTheLastFolderOfAnOutputIsMade) {
    const TemporaryFolder folder;
    const std::vector<float> grey(32, 1000.0f);
    const std::span<const float> pixels(grey);
    io::write_exr(folder / "sky.exr", 8, 4,
                  {{"R", io::PixelType::float32, pixels},
                   {"G", io::PixelType::float32, pixels},
                   {"B", io::PixelType::float32, pixels}},
                  {});
    for (const std::string& command :
         {"env split " + (folder / "sky.exr"), std::string("bake studio --size 8 --irradiance-size 4"),
          std::string("validate --only teaching_page"), "bake probes " + plane()}) {
        SCOPED_TRACE(command);
        expect_one_line(run_candela(command + " -o " + (folder / "not/there")), 1,
                        "the folder does not exist (make it first");
        EXPECT_FALSE(std::filesystem::exists(folder / "not"));
        expect_one_line(run_candela(command + " -o " + (folder / "sky.exr")), 1, "is not a folder");
    }
    EXPECT_EQ(run_candela("env split " + (folder / "sky.exr") + " -o " + (folder / "split")).exit_code, 0);
    EXPECT_EQ(run_candela("env split " + (folder / "sky.exr") + " -o " + (folder / "slash/")).exit_code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "slash/stage.json"));
    for (const std::string& command :
         {"render " + plane() + " -o " + (folder / "not/a.png"),
          "convert " + plane() + " -o " + (folder / "not/a.glb"),
          "env calibrate " + (folder / "sky.exr") + " --grey-card 0,0,1,1 --value 5 -o " +
              (folder / "not/a.exr"),
          "bake dfg -o " + (folder / "not/a.exr"),
          "validate --only teaching_page --techniques " + (folder / "not/a.md")}) {
        SCOPED_TRACE(command);
        expect_one_line(run_candela(command), 1, "the folder does not exist (make it first)");
    }
}

TEST(Messages, TexelsThatAreNoLuminanceAreCounted) {
    const TemporaryFolder folder;
    std::vector<float> plane(32, 1000.0f);
    plane[3] = plane[4] = -0.5f;
    plane[5] = -2.5f;
    plane[9] = std::nanf("");
    const std::span<const float> pixels(plane);
    io::write_exr(folder / "sky.exr", 8, 4,
                  {{"R", io::PixelType::float32, pixels},
                   {"G", io::PixelType::float32, pixels},
                   {"B", io::PixelType::float32, pixels}},
                  {});
    const Outcome outcome = run_candela("env info " + (folder / "sky.exr"));
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(
        outcome.err.find(
            "negative luminance became 0, in 3 of 32 texels, the least -2.5; the up-facing illuminance "),
        std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find("not a number became 0, in 1 of 32 texels"), std::string::npos) << outcome.err;
    EXPECT_EQ(lines(outcome.err), 2u) << outcome.err;
}

TEST(Messages, ConvertSaysWhatItWrote) {
    const TemporaryFolder folder;
    const Outcome outcome = run_candela("convert " + plane() + " -o " + (folder / "a.glb"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "candela: wrote " + (folder / "a.glb") + "\n");
    EXPECT_EQ(run_candela("convert " + plane() + " --json -o " + (folder / "b.glb")).err, "");
}

TEST(Messages, RenderSaysInItsHelpWhatItWritesWithoutAName) {
    EXPECT_NE(run_candela("render --help").out.find("(out.png)"), std::string::npos);
}

TEST(Messages, CompareShowsNamesInFull) {
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> rgb(12, 100);
    const std::string long_name = "a name of more than fourteen letters";
    for (const std::string& name : {std::string("a"), std::string("b")})
        io::write_png(folder / (name + ".png"), 2, 2, std::span<const std::uint8_t>(rgb), {});
    const Outcome outcome = run_candela("compare " + (folder / "a.png") + " " + (folder / "b.png") +
                                        " --names '" + long_name + ",reference'");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("  " + long_name + "\n"), std::string::npos) << outcome.out;
    // Numbers stand under the end of their name.
    const auto line = [&](const std::string& with) {
        const std::size_t at = outcome.out.find(with);
        const std::size_t begin = outcome.out.rfind('\n', at) + 1;
        return outcome.out.substr(begin, outcome.out.find('\n', at) - begin);
    };
    ASSERT_NE(outcome.out.find("\nrmse "), std::string::npos) << outcome.out;
    EXPECT_EQ(line(long_name).size(), line("rmse ").size()) << outcome.out;
}

TEST(Messages, HelpIsInGroupsWithExamples) {
    const Outcome help = run_candela("help render");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_EQ(help.out, run_candela("render --help").out);
    std::size_t before = 0;
    for (const char* group : {"What is shown:", "Light:", "Camera and exposure:", "Quality and speed:",
                              "Output:", "Examples:\n  candela render scene.glb -o picture.png"}) {
        const std::size_t at = help.out.find(group);
        ASSERT_NE(at, std::string::npos) << group << help.out;
        EXPECT_GT(at, before) << group;
        before = at;
    }
    EXPECT_LT(help.out.find("Light:"), help.out.find("--env "));
    EXPECT_LT(help.out.find("--env "), help.out.find("Camera and"));
    EXPECT_NE(run_candela("help").out.find("candela help COMMAND"), std::string::npos);
    EXPECT_NE(run_candela("help env split").out.find("--contrast"), std::string::npos);
    for (const char* command :
         {"info", "bench", "compare", "meter", "bake", "bake probes", "convert", "validate", "light", "env"})
        EXPECT_NE(run_candela(std::string("help ") + command).out.find("Examples:"), std::string::npos)
            << command;
}

TEST(Messages, SidesAndAperturesAreTakenAsPeopleWriteThem) {
    const TemporaryFolder folder;
    const auto size = [&](const std::string& options) {
        const Outcome outcome =
            run_candela("render " + plane() + " --json -o " + (folder / "a.png") + " " + options);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const auto json = nlohmann::json::parse(outcome.out);
        return json["width"].dump() + "x" + json["height"].dump();
    };
    EXPECT_EQ(size("--width 32 --height 20"), "32x20");
    EXPECT_EQ(size("--width 32"), "32x18");
    EXPECT_EQ(size("--height 18"), "32x18");
    expect_one_line(run_candela("render s.glb --width 32 --size 8x8"), 2, "contradicts --size");
    for (const char* aperture : {"8", "f/8", "F/8", "f8"})
        EXPECT_EQ(size(std::string("--size 8x8 --shutter 1/125 --iso 100 --aperture ") + aperture), "8x8");
    expect_one_line(run_candela("render s.glb --aperture g/8"), 2, "--aperture");
    // An option takes one file; what follows is the scene.
    EXPECT_EQ(run_candela("render --size 8x8 -o " + (folder / "b.png") + " " + plane()).exit_code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "b.png"));
}

TEST(Messages, WrongKindsOfFileAreNamed) {
    const TemporaryFolder folder;
    spit(folder / "cube.obj", "v 0 0 0\nv 1 0 0\n");
    spit(folder / "a.stage.json", R"({"environment": {"sky": {}}})");
    spit(folder / "a.png", "\x89PNG\r\n\x1a\n\x00\x1b[2J");
    expect_one_line(run_candela("info " + (folder / "cube.obj")), 1,
                    "cube.obj: not glTF: an OBJ mesh (export it as .glb");
    expect_one_line(run_candela("info " + (folder / "a.stage.json")), 1, "not glTF: a stage (candela render");
    expect_one_line(run_candela("light " + (folder / "a.png")), 1,
                    "not a photometric file (IES or EULUMDAT): a PNG");
    expect_one_line(run_candela("env info " + plane()), 1, "a binary glTF scene");
    expect_one_line(run_candela("render " + plane() + " --env studoi"), 1,
                    "studoi: no such file (did you mean studio? built in are studio, sky");
}

TEST(Messages, CompareNamesBothFiles) {
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> rgb(48, 100);
    io::write_png(folder / "a.png", 2, 2, std::span<const std::uint8_t>(rgb).first(12), {});
    io::write_png(folder / "b.png", 4, 4, std::span<const std::uint8_t>(rgb), {});
    expect_one_line(run_candela("compare " + (folder / "a.png") + " " + (folder / "b.png")), 1,
                    (folder / "a.png") + ": is 2x2 pixels, the reference " + (folder / "b.png") + " 4x4");
}

TEST(Messages, ATimeWithoutAnAnimationIsSaid) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_candela("render " + plane() + " --time 2 --size 8x8 -o " + (folder / "a.png"));
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find("the time has no effect: the scene has no animation"), std::string::npos)
        << outcome.err;
    expect_one_line(run_candela("render " + plane() + " --search " + folder.path().string()), 2,
                    "--search: has no effect without a stage");
}

// Two suns are seldom meant: a scene made for its own sun under a sky with one.
TEST(Messages, ASkyOverASceneWithASunIsTwoSuns) {
    const auto warnings = [](const std::string& options) {
        const Outcome outcome =
            run_candela("meter " + plane() + " --at 0,0.5,0 --spp 1 --mode path " + options);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.err;
    };
    const std::string two = warnings("--env sky:elevation=35");
    EXPECT_NE(two.find("two suns: the scene's light \"lamp\""), std::string::npos) << two;
    EXPECT_NE(two.find(R"("override": "lamp", "off": true)"), std::string::npos) << two;
    EXPECT_EQ(lines(two), 1u) << two;
    EXPECT_EQ(warnings("--env sky:elevation=-5"), "") << "no sun in that sky";
    EXPECT_EQ(warnings("--env studio"), "");
    EXPECT_EQ(warnings("--env sky --light-scale 0.0001"), "") << "a moon is no sun";
    // What the warning says to do.
    spit(scenes() / "off.json", R"({"lights": [{"override": "lamp", "off": true}]})");
    EXPECT_EQ(warnings("--env sky --stage " + (scenes() / "off.json")), "");
}

TEST(Messages, InfoListsProbesAndEmissiveSurfaces) {
    const TemporaryFolder folder;
    candela::scenes::write_two_rooms(folder.path());
    const std::string command =
        "info " + (folder / "two_rooms.glb") + " --stage " + (folder / "two_rooms.stage.json");
    const nlohmann::json scene = nlohmann::json::parse(run_candela(command + " --json").out)["scene"];
    ASSERT_EQ(scene["emissive_surfaces"].size(), 2u);
    // 3000 lm from 0.36 m^2.
    const auto& panel = scene["emissive_surfaces"][0];
    EXPECT_NEAR(panel["power_lm"].get<double>(), 3000.0, 1.0);
    EXPECT_NEAR(panel["area_m2"].get<double>(), 0.36, 1e-4);
    EXPECT_NEAR(panel["luminance_nit"].get<double>(), 3000.0 / (3.14159265 * 0.36), 1.0);
    EXPECT_EQ(panel["material"], "panel");
    ASSERT_EQ(scene["reflection_probes"].size(), 2u);
    ASSERT_EQ(scene["irradiance_volumes"].size(), 2u);
    const auto& volume = scene["irradiance_volumes"][0];
    EXPECT_EQ(volume["cells"], (nlohmann::json{8, 6, 10}));
    EXPECT_NEAR(volume["size_m"][1].get<double>(), 2.8, 1e-5);
    const std::string text = run_candela(command).out;
    for (const char* line : {"emissive panel", "reflection probe cool room", "irradiance volume warm room"})
        EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
    // Nothing unprintable stands in for the end of a line.
    EXPECT_EQ(text.find('?'), std::string::npos) << text;
    EXPECT_NE(text.find("bounds   -4.3, -0.2, -2.7 to 4.3, 3, 2.7 m"), std::string::npos) << text;
}

}  // namespace
}  // namespace candela::test
