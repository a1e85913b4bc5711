// Where a stage's files may lie, where in the stage a mistake stands, and what is no stage at all.
#include <gtest/gtest.h>

#include "candela/io/file_kind.hpp"
#include "candela/io/json_position.hpp"
#include "candela/io/json_reader.hpp"
#include "candela/io/stage.hpp"
#include "candela/scene/error.hpp"
#include "candela/scene/printable.hpp"
#include "common/files.hpp"

namespace candela::test {
namespace {

namespace fs = std::filesystem;

std::string error_line(const std::string& file, const std::vector<fs::path>& search = {}) {
    try {
        (void)io::load_stage(file, search);
    } catch (const Error& error) {
        return error.line();
    }
    return {};
}

std::string stage_with(const std::string& file) {
    return R"({"environment": {"file": ")" + file + R"("}})";
}

TEST(StageFiles, AreFoundInTheFoldersThatTheUserNames) {
    const TemporaryFolder own;
    const TemporaryFolder library;
    const TemporaryFolder elsewhere;
    spit(library / "sky.exr", "x");
    spit(elsewhere / "sky.exr", "x");
    const std::string stage = own / "a.json";
    const auto found = [&](const std::string& name, const std::vector<fs::path>& search) {
        spit(stage, stage_with(name));
        return io::load_stage(stage, search).environment->file;
    };
    EXPECT_EQ(found("sky.exr", {library.path()}), library.path() / "sky.exr");
    EXPECT_EQ(found("sky.exr", {library.path(), elsewhere.path()}), library.path() / "sky.exr")
        << "the first";
    EXPECT_EQ(found(library / "sky.exr", {library.path()}), library.path() / "sky.exr") << "absolute";
    spit(own / "sky.exr", "x");
    EXPECT_EQ(found("sky.exr", {library.path()}), own.path() / "sky.exr") << "the stage's own folder first";
    EXPECT_EQ(found(own / "sky.exr", {}), own.path() / "sky.exr") << "absolute, but in the stage's folder";
}

TEST(StageFiles, AreNotReadFromAnywhereElse) {
    const TemporaryFolder own;
    const TemporaryFolder library;
    const TemporaryFolder secret;
    spit(secret / "key.exr", "x");
    fs::create_symlink(secret.path(), library.path() / "link");
    const std::string stage = own / "a.json";
    for (const std::string& name :
         {secret / "key.exr", std::string("/etc/passwd"), std::string("../key.exr"),
          std::string("link/key.exr"), library / "link/key.exr",
          (library / "..") + "/" + secret.path().filename().string() + "/key.exr"}) {
        spit(stage, stage_with(name));
        const std::string line = error_line(stage, {library.path()});
        EXPECT_NE(line.find("/environment/file"), std::string::npos) << name << ": " << line;
    }
    spit(stage, stage_with("sky.exr"));
    EXPECT_NE(error_line(stage, {own.path() / "none"}).find("--search"), std::string::npos);
}

TEST(StageFiles, ErrorsHaveLineAndColumn) {
    const TemporaryFolder folder;
    const std::string stage = folder / "a.json";
    const auto line = [&](const std::string& text) {
        spit(stage, text);
        return error_line(stage);
    };
    EXPECT_EQ(
        line("{\n  // a comment: \"lights\"\n  \"lights\": [\n    {\"type\": \"point\", \"power_lm\": 1},\n"
             "    {\"type\": \"sun\", \"illuminance_lx\": \"bright\"}\n  ]\n}")
            .rfind(stage + ":5:21: /lights/1/illuminance_lx: must be a number", 0),
        0u);
    EXPECT_EQ(
        line("{\"exposure\":\n\t{\"ev100\": 99}}").rfind(stage + ":2:3: /exposure/ev100: out of range", 0),
        0u);
    EXPECT_EQ(line("{\"camera\": {\"focal_mm\": 50},\n \"camera2\": {}}")
                  .rfind(stage + ":2:2: /camera2: unknown", 0),
              0u);
    EXPECT_EQ(line("{\"exposure\": {\"ev100\": 1,}}").rfind(stage + ":1:26: not valid JSON", 0), 0u)
        << line("{\"exposure\": {\"ev100\": 1,}}");
    EXPECT_NE(line(R"({"lights": [{"type": "point", "power": 1}]})").find("did you mean power_lm"),
              std::string::npos);
}

TEST(StageFiles, WhatIsNoStageIsNamed) {
    const TemporaryFolder folder;
    spit(folder / "a.gltf", R"({"asset": {"version": "2.0"}})");
    spit(folder / "b.json", "\x89PNG\r\n\x1a\n....");
    EXPECT_NE(error_line(folder / "a.gltf").find("not a stage: a glTF scene (candela render SCENE --stage"),
              std::string::npos);
    EXPECT_NE(error_line(folder / "b.json").find("not a stage: a PNG picture"), std::string::npos);
}

TEST(FileKind, IsToldByContentBeforeName) {
    const auto kind = [](const std::string& text, const std::string& name) {
        return io::kind_of_file(std::as_bytes(std::span(text)), name).name;
    };
    EXPECT_EQ(kind("v 0 0 0\n", "cube.obj"), "an OBJ mesh");
    EXPECT_EQ(kind("\x89PNG\r\n\x1a\n", "cube.glb"), "a PNG picture");
    EXPECT_EQ(kind("version https://git-lfs.github.com/spec/v1\n", "cube.glb"),
              "a Git LFS pointer, not the file itself");
    EXPECT_EQ(kind("\n<!DOCTYPE html><html>", "cube.glb"), "a web page");
    EXPECT_EQ(kind("BLENDER-v300", "a.blend"), "a Blender file");
    EXPECT_EQ(kind(R"({"lights": []})", "x"), "a stage");
    EXPECT_EQ(kind("BMW is a car", "x"), "");
    EXPECT_EQ(kind("", "x"), "");
}

TEST(Printable, SendsNoControlCharactersAndNoBrokenTextToTheTerminal) {
    EXPECT_EQ(printable("caf\xc3\xa9 \xe2\x82\xac"), "caf\xc3\xa9 \xe2\x82\xac");
    EXPECT_EQ(printable("a\x1b[2J\x7f"), "a?[2J?");
    EXPECT_EQ(printable("\xff\xfe\xc3"), "???");
    EXPECT_EQ(printable("\xc2\x9b"
                        "2J"),
              "??2J")
        << "a control character of Latin-1";
    EXPECT_LE(printable(std::string(5000, '\xff')).size(), 410u);
}

TEST(NearestName, IsNearOrLonger) {
    const std::vector<std::string> known{"--device", "--size", "--tonemap", "power_lm", "intensity_cd"};
    EXPECT_EQ(io::nearest_name("--sise", known), "--size");
    EXPECT_EQ(io::nearest_name("--tonempa", known), "--tonemap");
    EXPECT_EQ(io::nearest_name("--denoise", known), "");
    EXPECT_EQ(io::nearest_name("power", known), "power_lm");
}

}  // namespace
}  // namespace candela::test
