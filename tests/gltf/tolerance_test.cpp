#include "cli/process.hpp"
#include "slips.hpp"

using namespace candela;
using namespace candela::test;

// What cannot be drawn safely is one error; warnings are few, and errors under --strict.

TEST(Refused, WhatCannotBeDrawnSafely) {
    const std::pair<const char*, Damage> cases[] = {
        {"path leaves the folder",
         [](GltfBuilder& b) {
             b.doc["images"][0] = {{"uri", "../../etc/passwd"}};
         }},
        {"path leaves the folder",
         [](GltfBuilder& b) {
             b.doc["images"][0] = {{"uri", "..\\..\\etc\\passwd"}};
         }},
        {"absolute path",
         [](GltfBuilder& b) {
             b.doc["images"][0] = {{"uri", "/etc/passwd"}};
         }},
        {"cycle",
         [](GltfBuilder& b) {
             b.push("nodes", {{"children", {2}}});
             b.push("nodes", {{"children", {1}}});
         }},
        {"its own ancestor", [](GltfBuilder& b) { b.doc["nodes"][0]["children"] = {0}; }},
        {"too large", [](GltfBuilder& b) { b.doc["accessors"][0]["count"] = 1000000000; }},
        {"out of range", [](GltfBuilder& b) { primitive_of(b)["attributes"]["POSITION"] = 99; }},
        {"VENDOR_geometry", [](GltfBuilder& b) { b.doc["extensionsRequired"] = {"VENDOR_geometry"}; }},
        {"KHR_meshopt_compression",
         [](GltfBuilder& b) { b.doc["extensionsRequired"] = {"KHR_meshopt_compression"}; }},
        {"/asset/minVersion: the file needs glTF 2.1",
         [](GltfBuilder& b) {
             b.doc["asset"] = {{"version", "2.1"}, {"minVersion", "2.1"}};
         }},
        {"it says 20.0",
         [](GltfBuilder& b) {
             b.doc["asset"] = {{"version", "20.0"}};
         }},
        {"it says 3.0",
         [](GltfBuilder& b) {
             b.doc["asset"] = {{"version", "3.0"}};
         }},
    };
    for (const auto& [mentions, damage] : cases) {
        SCOPED_TRACE(mentions);
        const TemporaryFolder folder;
        GltfBuilder b = textured();
        damage(b);
        put(folder / kScene, b.glb());
        Diagnostics diagnostics;
        try {
            (void)io::load_gltf(folder / kScene, {}, diagnostics);
            ADD_FAILURE() << "no error";
        } catch (const Error& error) {
            EXPECT_NE(error.line().find(mentions), std::string::npos) << error.line();
            EXPECT_EQ(error.fault(), Fault::input);
        }
    }
}

TEST(Warnings, OfOneKindAreOneWithTheirNumber) {
    GltfBuilder b = textured();
    const json primitive = primitive_of(b);
    for (int i = 0; i < 3; ++i) b.doc["meshes"][0]["primitives"].push_back(primitive);
    for (json& p : b.doc["meshes"][0]["primitives"]) p["material"] = -1;
    Diagnostics diagnostics;
    (void)load(b, diagnostics);
    ASSERT_EQ(diagnostics.warnings().size(), 1u);
    EXPECT_EQ(diagnostics.warnings()[0].count, 4u);
    EXPECT_NE(diagnostics.warnings()[0].text.find("/meshes/0/primitives/0/material = -1"), std::string::npos);
}

TEST(Warnings, OfAHostileFileAreBounded) {
    GltfBuilder b = textured();
    for (int i = 0; i < 5000; ++i) b.push("nodes", {{"mesh", 0}, {"camera", 1000 + i}, {"name", i}});
    for (int i = 0; i < 5000; ++i)
        b.doc["nodes"][0]["children"].push_back(i + 1), b.doc["nodes"][0]["children"].push_back(i + 1);
    Diagnostics diagnostics;
    (void)load(b, diagnostics);
    EXPECT_LE(diagnostics.warnings().size(), 110u);
}

TEST(Strict, TurnsWarningsIntoErrors) {
    const TemporaryFolder folder;
    GltfBuilder b = textured();
    put(folder / "good.glb", b.glb());
    b.doc["materials"][0]["alphaMode"] = "blend";
    put(folder / "slip.glb", b.glb());
    const std::vector<std::string> commands{"info ", "render -o " + (folder / "a.png") + " ",
                                            "convert -o " + (folder / "b.glb") + " ", "meter "};
    for (const std::string& command : commands) {
        SCOPED_TRACE(command);
        const std::string at = command == "meter " ? " --at 0,0,1" : "";
        expect_one_line(run_candela(command + (folder / "slip.glb") + " --strict" + at), 1, "--strict");
        EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
        EXPECT_FALSE(std::filesystem::exists(folder / "b.glb"));
    }
    EXPECT_EQ(run_candela("info " + (folder / "slip.glb")).exit_code, 0);
    EXPECT_EQ(run_candela("info " + (folder / "good.glb") + " --strict").exit_code, 0);
}
