// Files that are no files, outputs that cannot be, and what a command line means but does not say: one line,
// the exit code, and nothing left behind.
#include <filesystem>

#include "candela/io/image_write.hpp"
#include "demo_scenes.hpp"
#include "process.hpp"

namespace candela::test {
namespace {

namespace fs = std::filesystem;

class Refusals : public testing::Test {
  protected:
    void SetUp() override {
        scenes::write_grey_plane(folder_.path());
        fs::create_directory(folder_ / "folder");
        spit(folder_ / "empty.exr", "");
        spit(folder_ / "noise.exr", "neither light nor a picture");
    }

    [[nodiscard]] std::string at(const std::string& name) const { return folder_ / name; }
    [[nodiscard]] std::string plane() const { return at("grey_plane.glb"); }

    TemporaryFolder folder_;
};

TEST_F(Refusals, WhatIsPrintedHasToArrive) {
    for (const std::string& arguments :
         {"info " + plane(), "info " + plane() + " --json", std::string("--version"),
          std::string("help render"), std::string("validate --list")}) {
        SCOPED_TRACE(arguments);
        // The last redirection of standard output counts.
        const TemporaryFolder streams;
        const std::string command =
            std::string(CANDELA_BINARY) + " " + arguments + " >/dev/full 2>" + (streams / "err");
        const int status = std::system(command.c_str());
        EXPECT_EQ(WEXITSTATUS(status), 3);
        EXPECT_NE(
            slurp(streams / "err").find("candela: error: standard output: cannot be written: No space left"),
            std::string::npos)
            << slurp(streams / "err");
    }
}

TEST_F(Refusals, HelpOnlyHelps) {
    expect_one_line(run_candela("help render " + plane()), 2,
                    "no command of candela render (candela help render)");
    expect_one_line(run_candela("help env inof"), 2, "inof: no command of candela env (candela help env)");
    EXPECT_EQ(run_candela("help render --help").exit_code, 0);
}

TEST_F(Refusals, OfOutputs) {
    const std::string render = "render " + plane() + " --size 16x9";
    expect_one_line(run_candela(render + " -o " + at("a.png") + " -o " + at("folder/../a.png")), 2,
                    "is given twice");
    expect_one_line(run_candela("compare " + plane() + " -o " + at("a.html") + " -o " + at("./a.html")), 2,
                    "is given twice");
    expect_one_line(
        run_candela(render + " -o " + at("a.png") + " --mode path --checkpoint " + at("gone/c.part")), 1,
        "the folder does not exist");
    EXPECT_FALSE(fs::exists(at("a.png")));
    EXPECT_FALSE(fs::exists(at("a.html")));
}

TEST_F(Refusals, OfFilesOfTheWrongKind) {
    expect_one_line(run_candela("compare " + at("noise.exr") + " " + at("noise.exr")), 1,
                    "not an OpenEXR, Radiance .hdr, PNG, JPEG or WebP picture");
    expect_one_line(run_candela("env info " + at("empty.exr")), 1, "empty.exr: the file is empty");
    expect_one_line(run_candela("light " + at("empty.exr")), 1, "empty.exr: the file is empty");
    expect_one_line(run_candela("info " + at("empty.exr")), 1, "empty.exr: the file is empty");
    expect_one_line(run_candela("info " + plane() + " --stage " + at("grey_plane.stage.json") + " --search " +
                                at("gone")),
                    1, "gone: no such folder (--search)");
}

TEST_F(Refusals, OfNumbersSayWhatIsWrongWithThem) {
    expect_one_line(run_candela("render a.glb --samples 0"), 2, "--samples: 0 is not in range 1 to 16777216");
    expect_one_line(run_candela("render a.glb --samples 1.5"), 2, "--samples: 1.5 is not a whole number");
    expect_one_line(run_candela("render a.glb --samples many"), 2, "--samples: not a number: many");
    expect_one_line(run_candela("render a.glb --samples 99999999999999999999"), 2, "is not in range");
    expect_one_line(run_candela("bench bake --size 3"), 2, "--size: 3 is not a power of two from 4 to 2048");
    expect_one_line(run_candela("compare a.glb --modes ''"), 2, "--modes: has no value");
    expect_one_line(run_candela("render"), 2, "candela render: needs SCENE (candela render --help)");
}

// 2^28 pixels of the path tracer's sums are 16 GiB and more.
TEST_F(Refusals, OfPicturesThatDoNotFitIntoMemory) {
    const std::string arguments =
        "render " + plane() + " --mode path --samples 1 --size 16384x16384 -o " + at("a.png");
    const TemporaryFolder streams;
    const std::string command = "ulimit -v 4000000; " + std::string(CANDELA_BINARY) + " " + arguments +
                                " 2>" + (streams / "err") + " >/dev/null";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 3);
    EXPECT_NE(slurp(streams / "err").find("--size: the picture takes 20"), std::string::npos)
        << slurp(streams / "err");
    EXPECT_FALSE(fs::exists(at("a.png")));
}

}  // namespace
}  // namespace candela::test
