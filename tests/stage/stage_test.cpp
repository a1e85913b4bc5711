#include "candela/io/stage.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "candela/scene/error.hpp"
#include "common/files.hpp"
#include "demo_scenes.hpp"
#include "source_folder.hpp"

using namespace candela;
using namespace candela::test;
using nlohmann::json;

namespace {

json parse_file(const std::string& file) {
    return json::parse(slurp(file));
}

const json kDocuments = parse_file(std::string(CANDELA_SOURCE_DIR) + "/tests/stage/documents.json");

/// The error line, or nothing.
std::string error_of(const std::string& text) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a.stage.json") << text;
    try {
        (void)io::load_stage(folder / "a.stage.json");
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input);
        return error.line();
    }
    return {};
}

/// Every key that the schema knows, as pointers; "*" stands for the elements of a list.
void collect_keys(const json& schema, const std::string& at, std::set<std::string>& out) {
    if (schema.contains("items")) collect_keys(schema["items"], at + "/*", out);
    if (!schema.contains("properties")) return;
    for (const auto& [key, value] : schema["properties"].items()) {
        out.insert(at + "/" + key);
        collect_keys(value, at + "/" + key, out);
    }
}

}  // namespace

TEST(Stage, GoodDocumentsAreRead) {
    for (const json& d : kDocuments["good"]) EXPECT_EQ(error_of(d.dump()), "") << d;
}

TEST(Stage, BadDocumentsNameTheirPointer) {
    for (const json& entry : kDocuments["bad"]) {
        const std::string pointer = entry[0];
        const std::string line = error_of(entry[1].dump());
        EXPECT_NE(std::regex_replace(line, std::regex("(a\\.stage\\.json):\\d+:\\d+"), "$1")
                      .find("a.stage.json: " + pointer + ": "),
                  std::string::npos)
            << entry << " gave: " << line;
    }
}

TEST(Stage, EveryKeyOfTheSchemaIsTriedByAGoodDocument) {
    std::set<std::string> keys;
    collect_keys(parse_file(std::string(CANDELA_SOURCE_DIR) + "/docs/stage.schema.json"), "", keys);
    EXPECT_GT(keys.size(), 45u);
    for (const json& d : kDocuments["good"]) {
        const json flat = d.flatten();
        for (const auto& [pointer, value] : flat.items()) {
            std::string key = std::regex_replace(pointer, std::regex("^/([a-z_]+)/[0-9]+"), "/$1/*");
            while (!key.empty()) {
                keys.erase(key);
                key.resize(key.rfind('/'));
            }
        }
    }
    keys.erase("/environment");
    EXPECT_TRUE(keys.empty()) << *keys.begin() << " is in the schema and in no good document";
}

TEST(Stage, MisspeltKeysGetAHint) {
    EXPECT_NE(error_of(R"({"exposure": {"apeture_f": 8}})").find("did you mean aperture_f?"),
              std::string::npos);
}

TEST(Stage, CommentsAreAllowedAndBrokenJsonNamesItsLine) {
    EXPECT_EQ(error_of("{ // light\n \"environment\": {\"studio\": true} /* soft boxes */ }"), "");
    EXPECT_NE(error_of("{\n\"camera\": {,}\n}").find("a.stage.json:2:12: not valid JSON"), std::string::npos);
}

TEST(Stage, FilesOutsideOfTheFolderAreRefused) {
    for (const char* file :
         {"../sky.exr", "/etc/passwd", "a/../../sky.exr", "%2e%2e/sky.exr", "file:///sky.exr"}) {
        const std::string line = error_of(json{{"environment", {{"file", file}}}}.dump());
        EXPECT_NE(line.find("/environment/file"), std::string::npos) << file << " gave: " << line;
    }
}

TEST(Stage, ValuesArriveInTheirUnits) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a.json")
        << R"({"environment": {"studio": true, "rotation_deg": 180, "illuminance_lx": 500},
        "camera": {"look_from": [1, 2, 3], "focal_mm": 85}, "exposure": {"aperture_f": 8, "shutter_s": 0.01, "iso": 200}})";
    const io::Stage stage = io::load_stage(folder / "a.json");
    EXPECT_NEAR(stage.environment->rotation_rad, 3.14159265f, 1e-6f);
    EXPECT_EQ(stage.environment->illuminance_lx, 500.0f);
    EXPECT_EQ(*stage.camera.look_from, glm::dvec3(1, 2, 3));
    EXPECT_EQ(stage.exposure.iso, 200.0f);
    EXPECT_FALSE(stage.exposure.automatic());
}

TEST(Stage, TheDemoScenesStagesAreGood) {
    const TemporaryFolder folder;
    scenes::write_room(folder.path());
    scenes::write_sphere_grid(folder.path());
    EXPECT_TRUE(io::load_stage(folder / "cornell_room.stage.json").environment->none);
    EXPECT_FALSE(io::load_stage(folder / "sphere_grid.stage.json").environment->file.empty());
}
