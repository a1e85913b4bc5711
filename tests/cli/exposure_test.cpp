// Exposure, units of emission and unlit colours as the command line gives them, the same in every mode.
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "candela/io/image_read.hpp"
#include "process.hpp"

namespace candela::test {
namespace {

using nlohmann::json;

/// A rectangle of 2 m x 2 m, facing +Z, of one material at each place; further top level keys in `more`.
std::string cards(const std::vector<std::string>& materials, const std::string& more = "",
                  const std::string& nodes = "") {
    std::string meshes, places, list, ids;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const std::string comma = i > 0 ? "," : "";
        const std::string n = std::to_string(i);
        list += comma + materials[i];
        meshes += comma + R"({"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": )" +
                  n + "}]}";
        places += comma + R"({"mesh": )" + n + R"(, "translation": [)" + std::to_string(3.0 * double(i)) +
                  ", 0, 0]}";
        ids += comma + n;
    }
    const std::size_t extra = nodes.empty() ? 0 : 1;
    if (extra > 0) {
        places += "," + nodes;
        ids += "," + std::to_string(materials.size());
    }
    // Corners at +-1 and the indices 0 1 2, 0 2 3.
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [)" + ids +
           R"(]}], "nodes": [)" + places + R"(], "meshes": [)" + meshes + R"(], "materials": [)" + list +
           R"(], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
           "min": [-1, -1, 0], "max": [1, 1, 0]}, {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
           "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
           "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,)"
           "AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAABAAIAAAACAAMA"
           R"("}])" +
           more + "}";
}

const std::string kWhite =
    R"({"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.8, 0.8, 1], "metallicFactor": 0}})";
const std::string kEmissive =
    R"({"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0}, "emissiveFactor": [1, 1, 1]})";
/// sRGB (255, 128, 0).
const std::string kUnlit =
    R"({"pbrMetallicRoughness": {"baseColorFactor": [1, 0.2158605, 0, 1]}, "extensions": {"KHR_materials_unlit": {}}})";

struct Shown {
    json result;
    scene::Image image;
    /// RGB at fractions of the picture.
    [[nodiscard]] std::array<int, 3> at(double x, double y) const {
        const auto px = static_cast<std::size_t>(x * image.width);
        const auto py = static_cast<std::size_t>(y * image.height);
        const std::size_t i = 4 * (py * image.width + px);
        return {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]};
    }
};

Shown render(const TemporaryFolder& folder, const std::string& scene, const std::string& options) {
    spit(folder / "scene.gltf", scene);
    const Outcome o = run_candela("render " + (folder / "scene.gltf") + " --size 64x32 --spp 16 --json " +
                                  options + " -o " + (folder / "a.png"));
    EXPECT_EQ(o.exit_code, 0) << o.err;
    return {json::parse(o.out),
            io::decode_image(io::read_file(folder / "a.png", std::size_t{1} << 24), "a.png")};
}

std::string warnings(const Shown& s) {
    return s.result["warnings"].dump();
}

const std::string kView = " --look-from 1.5,0,4 --look-at 1.5,0,0";

TEST(ExposureCli, UnlitColoursAreExactInEveryModeAndDoNotMoveTheExposure) {
    const TemporaryFolder folder;
    const std::string scene = cards({kWhite, kUnlit}, R"(, "extensionsUsed": ["KHR_materials_unlit"])");
    const float alone = render(folder, cards({kWhite}), kView + " --env-hidden").result["ev100"];
    for (const char* mode : {"realtime", "integrate", "path"}) {
        const Shown s = render(folder, scene, kView + " --env-hidden --mode " + mode);
        EXPECT_EQ(s.at(0.68, 0.5), (std::array<int, 3>{255, 128, 0})) << mode;
        EXPECT_NEAR(s.result["ev100"], alone, 0.1) << mode;
    }
}

TEST(ExposureCli, EmissionOfAFileWithoutLightsIsRelativeToTheStudio) {
    const TemporaryFolder folder;
    const std::string scene = cards({kWhite, kEmissive});
    for (const char* mode : {"realtime", "integrate", "path"}) {
        const Shown s = render(folder, scene, kView + std::string(" --mode ") + mode);
        EXPECT_GT(s.at(0.68, 0.5)[1], s.at(0.32, 0.5)[1] - 40)
            << mode << ": about as white as a white surface";
        EXPECT_EQ(s.result["units"]["emission"], "relative") << mode;
        EXPECT_GT(s.result["units"]["nit_per_unit"], 100.0) << mode;
        EXPECT_NE(warnings(s).find("emission is relative"), std::string::npos) << warnings(s);
    }
    const Shown absolute = render(folder, scene, kView + " --units absolute");
    EXPECT_LT(absolute.at(0.68, 0.5)[1], 60) << "1 cd/m2 beside a studio, and its reflection";
    EXPECT_EQ(absolute.result["units"]["nit_per_unit"], 1.0);
    const Shown half = render(folder, scene, kView + " --emissive-scale 0.5");
    const Shown whole = render(folder, scene, kView);
    EXPECT_FLOAT_EQ(half.result["units"]["nit_per_unit"].get<float>() * 2.0f,
                    whole.result["units"]["nit_per_unit"].get<float>());
}

TEST(ExposureCli, EmissionIsInCandelasWhereTheFileHasLightsOrPhysicalNumbers) {
    const TemporaryFolder folder;
    const std::string strong = R"({"emissiveFactor": [1, 1, 1], "extensions":
        {"KHR_materials_emissive_strength": {"emissiveStrength": 2000}}})";
    const Shown physical = render(
        folder, cards({kWhite, strong}, R"(, "extensionsUsed": ["KHR_materials_emissive_strength"])"), kView);
    EXPECT_EQ(physical.result["units"]["emission"], "absolute");
    const Shown sky = render(folder, cards({kWhite, kEmissive}), kView + " --env studio");
    EXPECT_EQ(sky.result["units"]["emission"], "absolute");
}

TEST(ExposureCli, AFileWithOneDimLightIsExposedForIt) {
    const TemporaryFolder folder;
    const std::string light =
        R"(, "extensionsUsed": ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual":
        {"lights": [{"type": "directional", "intensity": 3}]}})";
    const std::string node = R"({"extensions": {"KHR_lights_punctual": {"light": 0}}})";
    for (const char* mode : {"realtime", "path"}) {
        const Shown s = render(folder, cards({kWhite}, light, node), kView + std::string(" --mode ") + mode);
        EXPECT_NEAR(s.at(0.32, 0.5)[1], 118, 12) << mode;
    }
}

TEST(ExposureCli, AManualExposureThatMissesIsSaidOnceWithTheRightOne) {
    const TemporaryFolder folder;
    const Shown dark =
        render(folder, cards({kWhite}), "--aperture 16 --shutter 1/125 --iso 100 --env-scale 0.01");
    EXPECT_NE(warnings(dark).find("stops too dark"), std::string::npos) << warnings(dark);
    const Shown bright = render(folder, cards({kWhite}), "--ev100 0");
    EXPECT_NE(warnings(bright).find("stops too bright"), std::string::npos) << warnings(bright);
    const double right = render(folder, cards({kWhite}), "").result["ev100"];
    char wanted[32];
    std::snprintf(wanted, sizeof(wanted), "EV100 %.1f would be right", right);
    EXPECT_NE(warnings(bright).find(wanted), std::string::npos) << warnings(bright) << wanted;
    const Shown good = render(folder, cards({kWhite}), "--ev100 9");
    EXPECT_EQ(warnings(good).find("stops too"), std::string::npos) << warnings(good);
}

}  // namespace
}  // namespace candela::test
