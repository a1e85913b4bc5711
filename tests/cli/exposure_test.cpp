// Exposure, units of emission and unlit colours as the command line gives them, the same in every mode.
#include <algorithm>
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

TEST(ExposureCli, AStageSaysWhatEmissionIsInAndTheCommandLineWins) {
    const TemporaryFolder folder;
    const std::string scene = cards({kWhite, kEmissive});
    const auto nit_per_unit = [&](const std::string& stage, const std::string& options) {
        spit(folder / "a.stage.json", stage);
        const Shown s =
            render(folder, scene, kView + " --stage " + (folder / "a.stage.json") + " " + options);
        return s.result["units"]["nit_per_unit"].get<float>();
    };
    const float studio = nit_per_unit("{}", "");
    EXPECT_GT(studio, 100.0f);
    EXPECT_EQ(nit_per_unit(R"({"units": "absolute"})", ""), 1.0f);
    EXPECT_EQ(nit_per_unit(R"({"units": "absolute", "emissive_scale": 7})", ""), 7.0f);
    EXPECT_EQ(nit_per_unit(R"({"units": "absolute"})", "--units relative"), studio);
    EXPECT_EQ(nit_per_unit(R"({"emissive_scale": 0.5})", "--emissive-scale 2"), 2.0f * studio);
    // A stage with light of its own: absolute, unless it says otherwise.
    const std::string light =
        R"("lights": [{"type": "directional", "illuminance_lx": 3.1415927, "direction": [0, 0, -1]}])";
    EXPECT_EQ(nit_per_unit("{" + light + "}", ""), 1.0f);
    EXPECT_NEAR(nit_per_unit("{" + light + R"(, "units": "relative"})", ""), 1.0f, 1e-3f)
        << "1 cd/m2 is white here";
    EXPECT_NEAR(nit_per_unit("{" + light + R"(, "units": "relative", "emissive_scale": 3})", ""), 3.0f,
                3e-3f);
}

// Of the kinds of files that other viewers show bright without a unit: nine forms of emission, by themselves
// and beside one light of 3 lx.
TEST(ExposureCli, FilesWithoutPhysicalUnitsAreNotBlackInAnyMode) {
    const TemporaryFolder folder;
    const std::string png =
        "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4//8/"
        "AAX+Av4N70a4AAAAAElFTkSuQmCC";
    const auto emissive = [](const std::string& base, const std::string& factor,
                             const std::string& more = "") {
        return R"({"pbrMetallicRoughness": {)" + base + R"(}, "emissiveFactor": )" + factor + more + "}";
    };
    const std::string black = R"("baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0)";
    std::vector<std::string> materials{
        emissive(black, "[1, 1, 1]"),
        emissive(black, "[1, 0.5, 0.1]"),
        emissive(black, "[0.3, 0.3, 0.3]"),
        emissive(R"("baseColorFactor": [0.8, 0.8, 0.8, 1], "metallicFactor": 0)", "[1, 1, 1]"),
        emissive(R"("baseColorFactor": [0.1, 0.1, 0.1, 1], "roughnessFactor": 0.2)", "[0, 0.8, 1]"),
        emissive(black, "[1, 1, 1]", R"(, "emissiveTexture": {"index": 0})"),
        emissive(black, "[1, 1, 1]",
                 R"(, "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 1}})"),
        emissive(black, "[1, 1, 1]", R"(, "alphaMode": "MASK", "doubleSided": true)"),
        emissive(black, "[1, 1, 1]", R"(, "alphaMode": "BLEND")")};
    const std::string textures = R"(, "textures": [{"source": 0}], "images": [{"uri": ")" + png + R"("}],
           "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_emissive_strength"])";
    const std::string light =
        R"(, "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 3}]}})";
    const std::string node = R"({"extensions": {"KHR_lights_punctual": {"light": 0}}})";
    // All of them in one picture, after a white one.
    materials.insert(materials.begin(), kWhite);
    const auto count = static_cast<double>(materials.size());
    const std::string view = " --look-from " + std::to_string(1.5 * (count - 1.0)) + ",0,48 --look-at " +
                             std::to_string(1.5 * (count - 1.0)) + ",0,0 --focal-mm 55 --env-hidden";
    for (const char* mode : {"realtime", "integrate", "path"}) {
        const std::string how = " --mode " + std::string(mode);
        const Shown alone = render(folder, cards(materials, textures), view + how);
        const Shown lit = render(folder, cards(materials, textures + light, node),
                                 view.substr(0, view.find(" --env")) + how);
        for (const Shown* shown : {&alone, &lit}) {
            for (std::size_t i = 0; i < materials.size(); ++i) {
                // Cards 3 m apart; the picture is twice as wide as the 24 mm that the lens throws on 48 m /
                // 55 mm.
                const double x = 0.5 + 3.0 * (double(i) - 0.5 * (count - 1.0)) / (2.0 * 48.0 * 24.0 / 55.0);
                const auto color = shown->at(x, 0.5);
                EXPECT_GT(std::max({color[0], color[1], color[2]}), 35)
                    << "material " << i << ", " << mode << (shown == &lit ? ", lit" : "");
            }
        }
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
