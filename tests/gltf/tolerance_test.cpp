#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "cli/process.hpp"
#include "gltf_samples.hpp"

using namespace candela;
using namespace candela::test;

/// Slips that other viewers draw are drawn, each with one warning that names the place and the repair; what
/// cannot be drawn safely is one error.
namespace {

namespace fs = std::filesystem;

struct Slip {
    const char* name;
    const char* warning;  ///< a fragment; empty: nothing is said
    std::function<void(const fs::path& folder)> write_files;
    std::function<void(const scene::Scene&)> check = [](const scene::Scene&) {};
};
void PrintTo(const Slip& s, std::ostream* out) {
    *out << s.name;
}

constexpr const char* kScene = "slip.gltf";

void put(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

std::string text_of(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// One textured triangle with normals and two sets of UV.
GltfBuilder textured() {
    GltfBuilder b = with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    add_texture(b, png_of_four_texels());
    return b;
}

/// PNG specification, annex D.
std::uint32_t png_crc(std::span<const std::byte> bytes) {
    std::uint32_t crc = 0xffffffffu;
    for (const std::byte b : bytes) {
        crc ^= std::to_integer<std::uint32_t>(b);
        for (int k = 0; k < 8; ++k) crc = (crc & 1) != 0 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
    return ~crc;
}

using Damage = std::function<void(GltfBuilder&)>;
using Check = std::function<void(const scene::Scene&)>;

Slip damaged(
    const char* name, const char* warning, const Damage& damage,
    const Check& check = [](const scene::Scene&) {}) {
    return {name, warning,
            [=](const fs::path& folder) {
                GltfBuilder b = textured();
                damage(b);
                put(folder / kScene, b.glb());
            },
            check};
}
Slip patched(
    const char* name, const char* pointer, const json& value, const char* warning,
    const Check& check = [](const scene::Scene&) {}) {
    return damaged(
        name, warning, [=](GltfBuilder& b) { b.doc[json::json_pointer(pointer)] = value; }, check);
}

/// The texture in a file of its own, named so in the scene.
Slip picture_at(const char* name, const char* warning, const std::string& uri, const char* file,
                bool drawn = true) {
    return {name, warning,
            [=](const fs::path& folder) {
                GltfBuilder b = textured();
                b.doc["images"][0] = {{"uri", uri}};
                fs::create_directories((folder / file).parent_path());
                put(folder / file, text_of(png_of_four_texels()));
                put(folder / kScene, b.glb());
            },
            [=](const scene::Scene& s) {
                EXPECT_EQ(static_cast<bool>(s.materials.at(0).base_color_texture), drawn);
                EXPECT_EQ(s.images.at(0).width, drawn ? 2u : 0u);
            }};
}

const Check kWithoutTexture = [](const scene::Scene& s) {
    EXPECT_FALSE(s.materials.at(0).base_color_texture);
};

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

const Check kFirstDefault = [](const scene::Scene& s) { EXPECT_EQ(s.materials.back().name, "glTF default"); };

std::vector<Slip> textures() {
    return {
        picture_at("MissingTexture", "/images/0: ", "gone.png", "other/there.png", false),
        patched("BrokenTexture", "/bufferViews/5/byteLength", 40, "/images/0", kWithoutTexture),
        damaged(
            "OversizedTexture", "too large: 100000 x 100000: drawn without this texture",
            [](GltfBuilder& b) {
                const auto at = b.doc["bufferViews"].back()["byteOffset"].get<std::size_t>();
                for (const std::size_t i : {16u, 20u}) {
                    b.binary[at + i] = std::byte{0}, b.binary[at + i + 1] = std::byte{1};
                    b.binary[at + i + 2] = std::byte{0x86}, b.binary[at + i + 3] = std::byte{0xa0};
                }
                const std::uint32_t crc = png_crc(std::span(b.binary).subspan(at + 12, 17));
                for (std::size_t i = 0; i < 4; ++i)
                    b.binary[at + 29 + i] = static_cast<std::byte>(crc >> (24 - 8 * i));
            },
            kWithoutTexture),
        patched("UnknownPicture", "/images/0", {{"uri", "data:image/gif;base64,R0lGODlh"}},
                "drawn without this texture", kWithoutTexture),
        patched("WebPicture", "/images/0", {{"uri", "https://example.org/a.png"}},
                "drawn without this texture", kWithoutTexture),
        picture_at("Backslash", "backslashes in a URI: read as slashes", "textures\\chk.png",
                   "textures/chk.png"),
        picture_at("EncodedBackslash", "backslashes in a URI", "textures%5Cchk.png", "textures/chk.png"),
        picture_at("Query", "a query or fragment", "chk.png?v=3", "chk.png"),
        picture_at("Fragment", "a query or fragment", "chk.png#top", "chk.png"),
        picture_at("BackslashAndQuery", "a query or fragment", "a\\chk.png?v=3", "a/chk.png"),
        picture_at("PercentInName", "part of the file's name", "a%20b.png", "a%20b.png"),
        picture_at("PercentEncoded", "", "a%20b.png", "a b.png"),
        picture_at("BlankNotEncoded", "", "a b.png", "a b.png"),
        picture_at("OtherCase", "upper and lower case", "Textures/CHK.PNG", "textures/chk.png"),
        picture_at("Latin1FileName", "Latin-1", "caf\xc3\xa9.png", "caf\xe9.png"),
        patched("WrapClamp", "/samplers", {{{"wrapS", 10496}}}, ""),  // of no texture: not read
        damaged(
            "WrapUnknown", "/samplers/0/wrapS = 10496",
            [](GltfBuilder& b) {
                b.doc["samplers"] = {{{"wrapS", 10496}}};
                b.doc["textures"][0]["sampler"] = 0;
            },
            [](const scene::Scene& s) {
                EXPECT_EQ(s.textures.at(0).sampler.wrap_s, scene::Wrap::clamp_to_edge);
            }),
        damaged("FilterUnknown", "/samplers/0/minFilter = -1",
                [](GltfBuilder& b) {
                    b.doc["samplers"] = {{{"minFilter", -1}}};
                    b.doc["textures"][0]["sampler"] = 0;
                }),
        damaged("MagnifyWithMipmaps", "/samplers/0/magFilter = 9987",
                [](GltfBuilder& b) {
                    b.doc["samplers"] = {{{"magFilter", 9987}}};
                    b.doc["textures"][0]["sampler"] = 0;
                }),
        patched("SamplerMinusOne", "/textures/0/sampler", -1, "/textures/0/sampler = -1"),
        patched("TextureOutOfRange", "/materials/0/pbrMetallicRoughness/baseColorTexture/index", 7,
                "baseColorTexture/index = 7", kWithoutTexture),
        patched("ImageOutOfRange", "/textures/0/source", 9, "/textures/0", kWithoutTexture),
        patched("OnlyBasisTexture", "/textures/0",
                {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}, "has no image that can be read",
                kWithoutTexture),
    };
}

std::vector<Slip> materials() {
    return {
        patched("MaterialMinusOne", "/meshes/0/primitives/0/material", -1, "material = -1", kFirstDefault),
        patched("MaterialOutOfRange", "/meshes/0/primitives/0/material", 4, "material = 4", kFirstDefault),
        patched(
            "AlphaModeInSmallLetters", "/materials/0/alphaMode", "blend", "written BLEND",
            [](const scene::Scene& s) { EXPECT_EQ(s.materials.at(0).alpha_mode, scene::AlphaMode::blend); }),
        patched("AlphaModeUnknown", "/materials/0/alphaMode", "GLASS", "read as OPAQUE"),
        patched("IorBelowOne", "/materials/0/extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}},
                "ior = 0.5", [](const scene::Scene& s) { EXPECT_EQ(s.materials.at(0).ior, 1.0f); }),
        patched("MetallicTwo", "/materials/0/pbrMetallicRoughness/metallicFactor", 2, "metallicFactor = 2",
                [](const scene::Scene& s) { EXPECT_EQ(s.materials.at(0).metallic, 1.0f); }),
        patched("ColourOfThree", "/materials/0/pbrMetallicRoughness/baseColorFactor", {0.5, 0.25, 0.125},
                "baseColorFactor",
                [](const scene::Scene& s) {
                    EXPECT_EQ(s.materials.at(0).base_color, glm::vec4(0.5f, 0.25f, 0.125f, 1.0f));
                }),
        patched("DoubleSidedIsANumber", "/materials/0/doubleSided", 1, "doubleSided = 1",
                [](const scene::Scene& s) { EXPECT_TRUE(s.materials.at(0).double_sided); }),
        patched("RoughnessIsAString", "/materials/0/pbrMetallicRoughness/roughnessFactor", "0.5",
                "roughnessFactor"),
        patched("ExtensionsNull", "/materials/0/extensions", nullptr, "/materials/0/extensions: is null"),
        patched("ExtensionsIsAnArray", "/nodes/0/extensions", json::array(), "/nodes/0/extensions"),
        patched("NameIsANumber", "/materials/0/name", 5, "/materials/0/name = 5"),
        patched("RequiresVariants", "/extensionsRequired", {"KHR_materials_variants"},
                "requires KHR_materials_variants"),
        patched("RequiresXmp", "/extensionsRequired", {"KHR_xmp_json_ld"}, "requires KHR_xmp_json_ld"),
        patched("RequiresLights", "/extensionsRequired", {"KHR_lights_punctual"}, ""),
        damaged(
            "UnusedPartsBroken", "",
            [](GltfBuilder& b) {
                b.push("materials", {{"alphaMode", "GLASS"}, {"emissiveFactor", {1, 2}}});
                b.push("accessors", {{"bufferView", 99}, {"componentType", 1}, {"count", -4}, {"type", "?"}});
                b.push("meshes", {{"primitives", {{{"attributes", {{"POSITION", 77}}}}}}});
                b.push("images", {{"uri", "gone.png"}});
                b.push("textures", {{"source", 55}});
                b.push("bufferViews", {{"buffer", 12}, {"byteLength", 4}});
                b.doc["buffers"] = {{{"byteLength", b.binary.size()}},
                                    {{"byteLength", 9}, {"uri", "gone.bin"}}};
            }),
    };
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

std::vector<Slip> all() {
    std::vector<Slip> out;
    for (auto* list : {textures, materials, nodes, files}) {
        const std::vector<Slip> some = list();
        out.insert(out.end(), some.begin(), some.end());
    }
    return out;
}

class DrawnWithAWarning : public testing::TestWithParam<Slip> {};

}  // namespace

TEST_P(DrawnWithAWarning, NamesPlaceAndRepair) {
    const TemporaryFolder folder;
    GetParam().write_files(folder.path());
    Diagnostics diagnostics;
    io::GltfOptions options;
    options.time_s = 0.5f;
    const scene::Scene s = io::load_gltf(folder / kScene, options, diagnostics);
    EXPECT_EQ(scene::triangle_count(s), 1u);
    const std::string no_animation = "the time has no effect: the scene has no animation";
    GetParam().check(s);
    std::string said;
    for (const Diagnostics::Warning& w : diagnostics.warnings())
        if (w.text != no_animation) said += w.text + "\n";
    const std::string expected = GetParam().warning;
    if (expected.empty()) {
        EXPECT_EQ(said, "");
    } else {
        EXPECT_NE(said.find(expected), std::string::npos) << said;
        EXPECT_NE(said.find(kScene), std::string::npos) << said;
    }
}

INSTANTIATE_TEST_SUITE_P(Gltf, DrawnWithAWarning, testing::ValuesIn(all()),
                         [](const auto& test) { return std::string(test.param.name); });

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
        EXPECT_FALSE(fs::exists(folder / "a.png"));
        EXPECT_FALSE(fs::exists(folder / "b.glb"));
    }
    EXPECT_EQ(run_candela("info " + (folder / "slip.glb")).exit_code, 0);
    EXPECT_EQ(run_candela("info " + (folder / "good.glb") + " --strict").exit_code, 0);
}

namespace {

/// Three clips that move node 0: "walk" to x 1, one without a name to x 2, "run" to x 3.
GltfBuilder three_clips() {
    GltfBuilder b = triangle();
    for (const float x : {1.0f, 2.0f, 3.0f})
        animate(b, "translation", "LINEAR", {0, 1}, {0, 0, 0, x, 0, 0}, "VEC3", 3);
    b.doc["animations"][0]["name"] = "walk";
    b.doc["animations"][2]["name"] = "run";
    return b;
}

float x_of_clip(const std::string& animation) {
    io::GltfOptions options;
    options.time_s = 1.0f;
    options.animation = animation;
    return load(three_clips(), options).instances.at(0).world[3].x;
}

}  // namespace

TEST(Animations, OnePlaysTheFirstUnlessNamed) {
    EXPECT_EQ(x_of_clip(""), 1.0f);
    EXPECT_EQ(x_of_clip("walk"), 1.0f);
    EXPECT_EQ(x_of_clip("1"), 2.0f);
    EXPECT_EQ(x_of_clip("run"), 3.0f);
    try {
        (void)x_of_clip("fly");
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(error.line().find("it has walk, 1, run"), std::string::npos) << error.line();
    }
}

TEST(Skins, EverySetOfJointsMovesItsVertices) {
    GltfBuilder b = skinned();
    json& attributes = primitive_of(b)["attributes"];
    // Vertex 0 hangs half on joint 0 (of set 0) and half on joint 1 (of set 2).
    attributes["WEIGHTS_0"] = b.accessor<float>({0.5, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0}, "VEC4", 4);
    for (const char* set : {"1", "2"}) {
        const float w = *set == '2' ? 0.5f : 0.0f;
        attributes[std::string("JOINTS_") + set] =
            b.accessor<std::uint8_t>({1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4", 4);
        attributes[std::string("WEIGHTS_") + set] =
            b.accessor<float>({w, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4", 4);
    }
    GltfBuilder four = skinned();
    primitive_of(four)["attributes"]["WEIGHTS_0"] =
        four.accessor<float>({0.5, 0.5, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0}, "VEC4", 4);
    Diagnostics diagnostics;
    const scene::Scene eight = load(b, diagnostics), expected = load(four);
    EXPECT_TRUE(diagnostics.warnings().empty());
    const glm::mat4 a = eight.instances.at(0).world, e = expected.instances.at(0).world;
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_TRUE(near(glm::vec3(a * glm::vec4(only_primitive(eight).positions[i], 1.0f)),
                         glm::vec3(e * glm::vec4(only_primitive(expected).positions[i], 1.0f))));
    }
}

TEST(Textures, ReadTheSetThatTheMaterialNames) {
    GltfBuilder b = textured();
    primitive_of(b)["attributes"]["TEXCOORD_5"] = b.accessor<float>({0.1f, 0, 0.2f, 0, 0, 0.3f}, "VEC2", 2);
    b.doc["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 5;
    b.doc["materials"][0]["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
    Diagnostics diagnostics;
    const scene::Scene s = load(b, diagnostics);
    EXPECT_TRUE(diagnostics.warnings().empty());
    const scene::Material& m = s.materials.at(0);
    const scene::Primitive& p = only_primitive(s);
    EXPECT_FLOAT_EQ(p.uv.at(m.base_color_texture.uv_set).at(1).x, 0.2f);
    EXPECT_FLOAT_EQ(p.uv.at(m.emissive_texture.uv_set).at(1).x, 0.5f);
}
