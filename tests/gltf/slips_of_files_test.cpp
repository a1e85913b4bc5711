#include <cmath>

#include "slips.hpp"

using namespace candela;
using namespace candela::test;

namespace {

namespace fs = std::filesystem;

/// The vertex data as base64 in a buffer's URI.
std::string base64(std::span<const std::byte> bytes, const char* last_two) {
    const std::string letters =
        std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789") + last_two;
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t w = 0;
        for (std::size_t k = 0; k < 3; ++k)
            w = w << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k <= bytes.size() ? letters[w >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

Slip embedded(const char* name, const char* warning, const std::function<std::string(std::string)>& write,
              const char* last_two = "+/") {
    return {name, warning, [=](const fs::path& folder) {
                GltfBuilder b = triangle();
                // 0.49607843, 0.99: bytes that need the last two letters of the alphabet.
                b.doc["nodes"][0]["name"] = "n";
                const std::vector<float> odd{std::nextafter(-0.9999f, -2.0f), -3.9999f, -0.98437f};
                b.accessor<float>(odd, "VEC3", 3);
                const std::vector<std::uint8_t> all{0xfb, 0xff, 0xfe, 0xfb, 0xff, 0xfe};
                b.view(std::as_bytes(std::span(all)));
                b.doc["buffers"] = {
                    {{"byteLength", b.binary.size()},
                     {"uri", "data:application/octet-stream;base64," + write(base64(b.binary, last_two))}}};
                put(folder / kScene, b.doc.dump());
            }};
}

std::vector<Slip> nodes() {
    const auto camera = [](const char* name, const json& perspective, const char* warning) {
        return damaged(
            name, warning,
            [=](GltfBuilder& b) {
                b.push("cameras", {{"type", "perspective"}, {"perspective", perspective}});
                b.doc["nodes"][0]["camera"] = 0;
            },
            [](const scene::Scene& s) {
                ASSERT_EQ(s.cameras.size(), 1u);
                EXPECT_GT(s.cameras[0].znear_m, 0.0f);
                EXPECT_GT(s.cameras[0].zfar_m, s.cameras[0].znear_m);
                EXPECT_GT(s.cameras[0].yfov_rad, 0.0f);
            });
    };
    const auto keys = [](const char* name, const std::vector<float>& times, const char* warning, float x) {
        return damaged(
            name, warning,
            [=](GltfBuilder& b) {
                std::vector<float> values;
                for (const float t : times) values.insert(values.end(), {10.0f * t, 0.0f, 0.0f});
                animate(b, "translation", "LINEAR", times, values, "VEC3", 3);
            },
            [=](const scene::Scene& s) { EXPECT_NEAR(s.instances.at(0).world[3].x, x, 1e-5f); });
    };
    return {
        camera("ZnearZero", {{"yfov", 0.7}, {"znear", 0}, {"zfar", 100}}, "/znear = 0"),
        camera("ZfarBeforeZnear", {{"yfov", 0.7}, {"znear", 5}, {"zfar", 1}}, "/zfar = 1"),
        camera("YfovOfHalfATurn", {{"yfov", 3.2}, {"znear", 1}}, "/yfov = 3.2"),
        damaged("CameraTypeUnknown", "/cameras/0/type",
                [](GltfBuilder& b) {
                    b.push("cameras", {{"type", "fisheye"}});
                    b.doc["nodes"][0]["camera"] = 0;
                }),
        patched("CameraOutOfRange", "/nodes/0/camera", 3, "/nodes/0/camera = 3"),
        keys("KeysUnsorted", {2, 0, 1}, "the keys are sorted", 5.0f),
        keys("KeysTwice", {0, 0, 1}, "", 5.0f),
        keys("KeyTimeNotANumber", {0, NAN}, "does not move its node", 0.0f),
        damaged(
            "TwoParents", "more than once",
            [](GltfBuilder& b) {
                b.push("nodes", {{"children", {0}}});
                b.push("nodes", {{"children", {0}}, {"translation", {3, 0, 0}}});
                b.doc["scenes"][0]["nodes"] = {1, 2};
            },
            [](const scene::Scene& s) { EXPECT_EQ(s.instances.at(0).world[3].x, 3.0f); }),
        damaged(
            "SceneListsAChild", "has a parent",
            [](GltfBuilder& b) {
                b.push("nodes", {{"children", {0}}, {"translation", {3, 0, 0}}});
                b.doc["scenes"][0]["nodes"] = {1, 0};
            },
            [](const scene::Scene& s) { EXPECT_EQ(s.instances.at(0).world[3].x, 3.0f); }),
        patched("SceneListsANodeTwice", "/scenes/0/nodes", {0, 0}, "twice"),
        patched("RootOutOfRange", "/scenes/0/nodes", {0, 8}, "/scenes/0/nodes/1 = 8"),
        patched("SceneOutOfRange", "/scene", 7, "/scene = 7"),
        patched("ChildOutOfRange", "/nodes/0/children", {42}, "/nodes/0/children/0 = 42"),
        patched("SkinMinusOne", "/nodes/0/skin", -1, "/nodes/0/skin = -1"),
        patched("LightWithoutList", "/nodes/0/extensions", {{"KHR_lights_punctual", {{"light", 0}}}},
                "/light = 0"),
        damaged("LightTypeUnknown", "/lights/0/type",
                [](GltfBuilder& b) {
                    b.doc["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "moon"}}};
                    b.doc["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
                }),
        damaged(
            "LightNegative", "/lights/0/intensity = -5: is negative: read as 0",
            [](GltfBuilder& b) {
                b.doc["extensions"]["KHR_lights_punctual"]["lights"] = {
                    {{"type", "point"}, {"intensity", -5}}};
                b.doc["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
            },
            [](const scene::Scene& s) { EXPECT_EQ(s.lights.at(0).intensity, 0.0f); }),
        damaged("IesFileMissing", "the light is drawn without it",
                [](GltfBuilder& b) {
                    b.doc["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "point"}}}}}},
                                           {"EXT_lights_ies", {{"lights", {{{"uri", "gone.ies"}}}}}}};
                    b.doc["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}},
                                                       {"EXT_lights_ies", {{"light", 0}}}};
                }),
        patched("RotationOfThree", "/nodes/0/rotation", {0, 0, 1}, "/nodes/0/rotation"),
    };
}

/// A buffer in a file of its own that is longer than the buffer says.
Slip short_byte_length() {
    return {"BufferLongerThanItSays", "passes its buffer's byteLength of 10", [](const fs::path& folder) {
                GltfBuilder b = triangle();
                put(folder / "data.bin", text_of(b.binary));
                b.doc["buffers"] = {{{"byteLength", 10}, {"uri", "data.bin"}}};
                put(folder / kScene, b.doc.dump());
            }};
}

std::vector<Slip> files() {
    const auto vertices = [](const char* name, const std::string& attribute, const json& value,
                             const char* warning) {
        return damaged(name, warning,
                       [=](GltfBuilder& b) { primitive_of(b)["attributes"][attribute] = value; });
    };
    const auto container = [](const char* name, const char* warning,
                              const std::function<std::string(std::string)>& damage) {
        return Slip{name, warning,
                    [=](const fs::path& folder) { put(folder / kScene, damage(textured().glb())); }};
    };
    const auto word = [](std::size_t value) {
        const auto narrow = static_cast<std::uint32_t>(value);
        return std::string(reinterpret_cast<const char*>(&narrow), 4);
    };
    const auto document = [](const char* name, const char* warning, const std::string& from,
                             const std::string& to) {
        return Slip{name, warning, [=](const fs::path& folder) {
                        GltfBuilder b = triangle();
                        b.doc["nodes"][0]["name"] = "NAME";
                        b.doc["buffers"] = {
                            {{"byteLength", b.binary.size()},
                             {"uri", "data:application/octet-stream;base64," + base64(b.binary, "+/")}}};
                        std::string text = b.doc.dump();
                        text.replace(text.find(from), from.size(), to);
                        put(folder / kScene, text);
                    }};
    };
    return {
        short_byte_length(),
        vertices("NormalsOutOfRange", "NORMAL", 50, "/NORMAL: index 50 is out of range"),
        vertices("CoordinatesOfThree", "TEXCOORD_0", 0, "/TEXCOORD_0"),
        damaged("NormalsFewerThanVertices", "has 1 elements for 3 vertices",
                [](GltfBuilder& b) {
                    primitive_of(b)["attributes"]["NORMAL"] = b.accessor<float>({0, 0, 1}, "VEC3", 3);
                }),
        damaged("IndexBeyondVertices", "vertices that are not there",
                [](GltfBuilder& b) {
                    primitive_of(b)["indices"] = b.accessor<std::uint32_t>({0, 1, 2, 0, 1, 77}, "SCALAR", 1);
                }),
        patched("IndicesMinusOne", "/meshes/0/primitives/0/indices", -1, "/indices = -1"),
        patched("BufferLengthTooLong", "/buffers", {{{"byteLength", 100000}}}, "/buffers/0/byteLength"),
        patched("ViewPastItsBuffer", "/bufferViews/5/byteLength", 1000000, "/bufferViews/5"),
        damaged("MeshoptFallbackWithoutFlag", "",
                [](GltfBuilder& b) {
                    b = meshopt_triangle();
                    b.doc["buffers"] = {{{"byteLength", b.binary.size()}}, {{"byteLength", 36}}};
                    b.doc["bufferViews"][0]["buffer"] = 1;
                }),
        container("ChunkNotPadded", "not padded to 4 bytes",
                  [=](const std::string& whole) {
                      const std::uint32_t n = *reinterpret_cast<const std::uint32_t*>(whole.data() + 12);
                      std::string json_text = whole.substr(20, n);
                      while (json_text.back() == ' ') json_text.pop_back();
                      while (json_text.size() % 4 != 1) json_text.insert(1, " ");
                      const std::string rest = whole.substr(20 + n);
                      return "glTF" + word(2) + word(20 + json_text.size() + rest.size()) +
                             word(json_text.size()) + "JSON" + json_text + rest;
                  }),
        container("HeaderLengthTooLong", "header states",
                  [=](std::string whole) { return whole.replace(8, 4, word(whole.size() + 100)); }),
        container("HeaderLengthTooShort", "header states",
                  [=](std::string whole) { return whole.replace(8, 4, word(20)); }),
        container("BytesBehindTheEnd", "", [](const std::string& whole) { return whole + "trailing bytes"; }),
        document("Latin1Name", "read as Latin-1", "NAME",
                 "K\xfc"
                 "che"),
        document("KeyTwice", "appears twice", "\"scenes\"", "\"asset\":{\"version\":\"2.0\"},\"scenes\""),
        document("VersionIsANumber", "/asset/version", "\"2.0\"", "2.0"),
        document("VersionTwoPointOne", "is 2.1", "\"2.0\"", "\"2.1\",\"minVersion\":\"2.0\""),
        embedded("Base64WithLineBreaks", "line breaks or blanks",
                 [](std::string text) {
                     for (std::size_t at = 16; at < text.size(); at += 17) text.insert(at, "\n");
                     return text;
                 }),
        embedded(
            "Base64UrlSafe", "URL-safe", [](const std::string& text) { return text; }, "-_"),
        embedded("Base64WithoutPadding", "",
                 [](std::string text) {
                     while (text.back() == '=') text.pop_back();
                     return text;
                 }),
    };
}

class NodeSlips : public testing::TestWithParam<Slip> {};
class FileSlips : public testing::TestWithParam<Slip> {};

}  // namespace

TEST_P(NodeSlips, AreDrawnWithAWarning) {
    expect_drawn_with_a_warning(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Gltf, NodeSlips, testing::ValuesIn(nodes()), name_of_slip);

TEST_P(FileSlips, AreDrawnWithAWarning) {
    expect_drawn_with_a_warning(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Gltf, FileSlips, testing::ValuesIn(files()), name_of_slip);
