#include "slips.hpp"

using namespace candela;
using namespace candela::test;

namespace {

namespace fs = std::filesystem;

/// PNG specification, annex D.
std::uint32_t png_crc(std::span<const std::byte> bytes) {
    std::uint32_t crc = 0xffffffffu;
    for (const std::byte b : bytes) {
        crc ^= std::to_integer<std::uint32_t>(b);
        for (int k = 0; k < 8; ++k) crc = (crc & 1) != 0 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
    return ~crc;
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

class TextureSlips : public testing::TestWithParam<Slip> {};
class MaterialSlips : public testing::TestWithParam<Slip> {};

}  // namespace

TEST_P(TextureSlips, AreDrawnWithAWarning) {
    expect_drawn_with_a_warning(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Gltf, TextureSlips, testing::ValuesIn(textures()), name_of_slip);

TEST_P(MaterialSlips, AreDrawnWithAWarning) {
    expect_drawn_with_a_warning(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Gltf, MaterialSlips, testing::ValuesIn(materials()), name_of_slip);
