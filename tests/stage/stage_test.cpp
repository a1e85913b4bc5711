#include "candela/io/stage.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "candela/scene/error.hpp"

namespace candela {
namespace {

using nlohmann::json;

std::string text_of(const std::string& relative) {
    std::ifstream in(std::string(CANDELA_SOURCE_DIR "/") + relative);
    return {std::istreambuf_iterator<char>(in), {}};
}

json json_of(const std::string& relative) {
    return json::parse(text_of(relative));
}

class StageFiles : public testing::Test {
  protected:
    StageFiles() {
        folder_ = std::filesystem::temp_directory_path() / ("candela-stage-" + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
    }
    ~StageFiles() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] io::Stage load(const std::string& text) const {
        std::ofstream(file()) << text;
        return io::load_stage(file());
    }
    [[nodiscard]] std::filesystem::path file() const { return folder_ / "a.stage.json"; }

  private:
    std::filesystem::path folder_;
};

TEST_F(StageFiles, EachDocumentOfTheTableIsReadOrRefusedAtItsPointer) {
    for (const json& entry : json_of("tests/stage/documents.json")) {
        const std::string document = entry["document"].dump();
        if (!entry.contains("message")) {
            EXPECT_NO_THROW((void)load(document)) << document;
            continue;
        }
        try {
            (void)load(document);
            ADD_FAILURE() << document << " was accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.fault(), Fault::input);
            EXPECT_EQ(error.where(), file().string() + ": " + entry["pointer"].get<std::string>())
                << document;
            EXPECT_NE(error.line().find(entry["message"].get<std::string>()), std::string::npos)
                << error.line();
        }
    }
}

/// Every key of the schema with its example, and what the key needs beside it.
TEST_F(StageFiles, EveryKeyOfTheSchemaIsRead) {
    const json schema = json_of("docs/stage.schema.json");
    int keys = 0;
    for (const auto& [name, part] : schema["properties"].items()) {
        if (!part.contains("properties")) {
            EXPECT_NO_THROW((void)load(json{{name, part["examples"][0]}}.dump())) << name;
            ++keys;
            continue;
        }
        for (const auto& [key, property] : part["properties"].items()) {
            json object{{key, property["examples"][0]}};
            if (name == "environment" && key != "file") object["studio"] = true;
            if (part.contains("dependentRequired") && part["dependentRequired"].contains(key)) {
                for (const json& other : part["dependentRequired"][key])
                    object[other.get<std::string>()] =
                        part["properties"][other.get<std::string>()]["examples"][0];
            }
            EXPECT_NO_THROW((void)load(json{{name, object}}.dump())) << name << "/" << key;
            ++keys;
        }
    }
    EXPECT_GT(keys, 10);
}

/// The loader's handlers are read from its source: a key that only the loader knows has no other trace.
TEST_F(StageFiles, EveryKeyOfTheLoaderIsInTheSchemaAndInTheGuide) {
    const json schema = json_of("docs/stage.schema.json");
    std::set<std::string> described;
    for (const auto& [name, part] : schema["properties"].items()) {
        described.insert(name);
        if (!part.contains("properties")) continue;
        for (const auto& [key, property] : part["properties"].items()) described.insert(key);
    }
    const std::string source = text_of("src/candela/io/stage.cpp");
    const std::regex handler(R"re(\{"(\$?[a-z0-9_]+)",\s*\[)re");
    std::set<std::string> read;
    for (std::sregex_iterator i(source.begin(), source.end(), handler), end; i != end; ++i)
        read.insert((*i)[1]);
    EXPECT_EQ(read, described);
    const std::string guide = text_of("docs/stage.md");
    for (const std::string& key : read) EXPECT_NE(guide.find("`" + key + "`"), std::string::npos) << key;
}

TEST_F(StageFiles, ValuesArriveInTheirUnits) {
    const io::Stage stage = load(R"({// a comment
        "environment": {"file": "sky.exr", "rotation_deg": 180, "illuminance_lx": 20000, "visible": false},
        /* another */ "camera": {"look_from": [1, 2, 3], "focal_mm": 85},
        "exposure": {"aperture_f": 16, "shutter_s": 0.008, "iso": 100, "compensation_ev": 1}})");
    ASSERT_TRUE(stage.environment.has_value());
    EXPECT_EQ(stage.environment->file.filename(), "sky.exr");
    EXPECT_NEAR(stage.environment->rotation_rad, 3.14159265f, 1e-6f);
    EXPECT_EQ(stage.environment->illuminance_lx, 20000.0f);
    EXPECT_FALSE(stage.environment->visible);
    EXPECT_EQ(stage.camera.look_from, glm::vec3(1, 2, 3));
    EXPECT_EQ(stage.camera.focal_mm, 85.0f);
    EXPECT_EQ(stage.exposure.shutter_s, 0.008f);
    EXPECT_EQ(stage.exposure.compensation_ev, 1.0f);
}

}  // namespace
}  // namespace candela
