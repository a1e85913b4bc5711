#include "gltf_builder.hpp"
#include "limited_run.hpp"

using namespace candela::test;

namespace {

Outcome render_with(const std::string& option, const std::string& file_name, const std::string& content) {
    const TemporaryFolder folder;
    write(folder / "scene.glb", triangle().glb());
    write(folder / file_name, content);
    return run_candela("render " + (folder / "scene.glb") + " " + option + " " + (folder / file_name) +
                       " -o " + (folder / "never.png"));
}

}  // namespace

TEST(MalformedStage, NamesTheJsonPointer) {
    const std::pair<const char*, const char*> cases[] = {
        {"[]", "object"},
        {"", "JSON"},
        {R"({"camera": 3})", "/camera"},
        {R"({"camera": {"look_from": [1, 2]}})", "/camera/look_from"},
        {R"({"camera": {"look_from": [1, 2, "3"]}})", "/camera/look_from/2"},
        {R"({"camera": {"focal_mm": -35}})", "/camera/focal_mm"},
        {R"({"exposure": {"ev100": "bright"}})", "/exposure/ev100"},
        {R"({"exposure": {"ev100": 1e999}})", "JSON"},
        {R"({"exposure": {"aperture_f": 8}})", "/exposure"},
        {R"({"environment": "sky.exr"})", "/environment"},
        {R"({"environment": {"file": "../../etc/passwd"}})", "/environment/file"},
        {R"({"environment": {"file": "%2Fetc/passwd"}})", "/environment/file"},
        {R"({"environment": {"studio": 1}})", "/environment/studio"},
        {R"({"environmant": {}})", "environment"},
        {R"({"camera": {}, "camera": {}})", "camera"}};
    for (const auto& [content, mentions] : cases) {
        SCOPED_TRACE(content);
        expect_one_clear_line(render_with("--stage", "bad.stage.json", content), mentions);
    }
}

TEST(MalformedEnvironment, HeadersThatClaimTenBillionTexels) {
    expect_one_clear_line(
        render_with("--env", "huge.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 100000\n"),
        "huge.hdr");
    const auto word = [](std::uint32_t v) { return std::string(reinterpret_cast<const char*>(&v), 4); };
    const auto attribute = [&](const std::string& name, const std::string& type, const std::string& value) {
        return name + '\0' + type + '\0' + word(static_cast<std::uint32_t>(value.size())) + value;
    };
    const std::string window = word(0) + word(0) + word(99999) + word(99999);
    std::string channels;
    for (const char* name : {"B", "G", "R"})
        channels += std::string(name) + '\0' + word(1) + word(0) + word(1) + word(1);
    const std::string exr = word(20000630) + word(2) + attribute("channels", "chlist", channels + '\0') +
                            attribute("compression", "compression", std::string(1, '\3')) +
                            attribute("dataWindow", "box2i", window) +
                            attribute("displayWindow", "box2i", window) +
                            attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
                            attribute("pixelAspectRatio", "float", word(0x3f800000)) +
                            attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
                            attribute("screenWindowWidth", "float", word(0x3f800000)) + '\0';
    expect_one_clear_line(render_with("--env", "huge.exr", exr), "huge.exr");
    expect_one_clear_line(render_with("--env", "huge.exr", exr.substr(0, 40)), "huge.exr");
    expect_one_clear_line(render_with("--env", "empty.hdr", ""), "empty.hdr");
}
