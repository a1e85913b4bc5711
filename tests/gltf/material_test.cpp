#include <gtest/gtest.h>

#include <cstdio>
// After <cstdio>, which it needs.
#include <jpeglib.h>

#include <filesystem>
#include <fstream>

#include "cli/process.hpp"
#include "gltf_samples.hpp"

using namespace candela;
using namespace candela::test;

namespace {

scene::Material material(const json& m) {
    GltfBuilder b = with_material(m);
    add_texture(b, png_of_four_texels());
    return load(b).materials.at(0);
}

scene::Material extended(const std::string& extension, const json& content) {
    return material({{"extensions", {{extension, content}}}});
}

const json kTexture = {{"index", 0}};

std::vector<std::byte> grey_jpeg() {
    jpeg_compress_struct c{};
    jpeg_error_mgr errors{};
    c.err = jpeg_std_error(&errors);
    jpeg_create_compress(&c);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&c, &data, &size);
    c.image_width = c.image_height = 8;
    c.input_components = 1;
    c.in_color_space = JCS_GRAYSCALE;
    jpeg_set_defaults(&c);
    jpeg_start_compress(&c, TRUE);
    unsigned char row[8];
    std::fill(std::begin(row), std::end(row), static_cast<unsigned char>(128));
    JSAMPROW rows[] = {row};
    for (int y = 0; y < 8; ++y) jpeg_write_scanlines(&c, rows, 1);
    jpeg_finish_compress(&c);
    jpeg_destroy_compress(&c);
    const auto* first = reinterpret_cast<const std::byte*>(data);
    std::vector<std::byte> out(first, first + size);
    std::free(data);
    return out;
}

std::string base64(std::span<const std::byte> bytes) {
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
    return out;
}

}  // namespace

// Karis 2014: a flag of the material; extras of any other form are somebody else's.
TEST(Material, FullyRoughIsAnExtra) {
    EXPECT_TRUE(material({{"extras", {{"fullyRough", true}}}}).fully_rough);
    for (const json& extras : {json(true), json("fullyRough"), json(3), json(nullptr), json::array({true}),
                               json{{"fullyRough", 1}}, json{{"fullyRough", false}}, json{{"other", true}}})
        EXPECT_FALSE(material({{"extras", extras}}).fully_rough) << extras;
    EXPECT_FALSE(material(json::object()).fully_rough);
}

TEST(Material, TheDefaultIsOfTheSpecification) {
    const scene::Material m = load(triangle()).materials.at(0);
    EXPECT_EQ(m.base_color, glm::vec4(1));
    EXPECT_EQ(m.metallic, 1.0f);
    EXPECT_EQ(m.perceptual_roughness, 1.0f);
    EXPECT_EQ(m.ior, 1.5f);
    EXPECT_EQ(m.alpha_mode, scene::AlphaMode::opaque);
    EXPECT_FALSE(m.double_sided);
}

TEST(Material, ExtensionsOfOneMaterialTogether) {
    const scene::Material m = load(everything_in_a_material()).materials.at(0);
    EXPECT_EQ(m.base_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(m.metallic, 0.25f);
    EXPECT_EQ(m.perceptual_roughness, 0.75f);
    EXPECT_EQ(m.normal_scale, 0.5f);
    EXPECT_EQ(m.emissive_nit, glm::vec3(100, 50, 0));
    EXPECT_EQ(m.alpha_mode, scene::AlphaMode::blend);
    EXPECT_TRUE(m.double_sided);
    EXPECT_EQ(m.ior, 1.33f);
    EXPECT_EQ(m.specular, 0.5f);
    EXPECT_EQ(m.specular_color, glm::vec3(1, 0.5f, 2));
    EXPECT_EQ(m.clearcoat.factor, 0.5f);
    EXPECT_EQ(m.clearcoat.perceptual_roughness, 0.25f);
    EXPECT_EQ(m.clearcoat.normal_scale, 2.0f);
    EXPECT_EQ(m.sheen.color, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(m.sheen.perceptual_roughness, 0.5f);
    EXPECT_EQ(m.anisotropy.strength, 0.5f);
    EXPECT_EQ(m.anisotropy.rotation_rad, 1.5f);
    // KHR_texture_transform, and its UV set over the one outside of it.
    const scene::TextureRef& t = m.base_color_texture;
    EXPECT_EQ(t.offset, glm::vec2(0.25f, 0.5f));
    EXPECT_EQ(t.scale, glm::vec2(2, 3));
    EXPECT_EQ(t.rotation_rad, 0.5f);
    EXPECT_EQ(t.uv_set, 0u);
}

TEST(Material, EveryTextureSlotIsItsOwn) {
    EXPECT_TRUE(material({{"pbrMetallicRoughness", {{"metallicRoughnessTexture", kTexture}}}})
                    .metallic_roughness_texture);
    const scene::Material occlusion =
        material({{"occlusionTexture", {{"index", 0}, {"texCoord", 1}, {"strength", 0.5}}}});
    EXPECT_EQ(occlusion.occlusion_texture.uv_set, 1u);
    EXPECT_EQ(occlusion.occlusion_strength, 0.5f);
    EXPECT_TRUE(material({{"emissiveTexture", kTexture}}).emissive_texture);
    EXPECT_TRUE(extended("KHR_materials_specular", {{"specularTexture", kTexture}}).specular_texture);
    EXPECT_TRUE(
        extended("KHR_materials_specular", {{"specularColorTexture", kTexture}}).specular_color_texture);
    EXPECT_TRUE(extended("KHR_materials_clearcoat", {{"clearcoatTexture", kTexture}}).clearcoat.texture);
    EXPECT_TRUE(extended("KHR_materials_clearcoat", {{"clearcoatRoughnessTexture", kTexture}})
                    .clearcoat.roughness_texture);
    EXPECT_TRUE(extended("KHR_materials_sheen", {{"sheenColorTexture", kTexture}}).sheen.color_texture);
    EXPECT_TRUE(
        extended("KHR_materials_sheen", {{"sheenRoughnessTexture", kTexture}}).sheen.roughness_texture);
    EXPECT_TRUE(extended("KHR_materials_anisotropy", {{"anisotropyTexture", kTexture}}).anisotropy.texture);
}

TEST(Material, UnlitAndSpecularGlossiness) {
    EXPECT_TRUE(extended("KHR_materials_unlit", json::object()).unlit);
    const scene::Material m =
        extended("KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {0.5, 0.25, 0, 1}},
                                                         {"specularFactor", {0.1, 0.2, 0.3}},
                                                         {"glossinessFactor", 0.75},
                                                         {"diffuseTexture", kTexture},
                                                         {"specularGlossinessTexture", kTexture}});
    EXPECT_EQ(m.workflow, scene::Workflow::specular_glossiness);
    EXPECT_EQ(m.base_color, glm::vec4(0.5f, 0.25f, 0, 1));
    EXPECT_EQ(m.specular_color, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(m.perceptual_roughness, 0.25f);
    EXPECT_TRUE(m.base_color_texture);
    EXPECT_TRUE(m.metallic_roughness_texture);
}

TEST(Material, AlphaModes) {
    const scene::Material mask = material({{"alphaMode", "MASK"}, {"alphaCutoff", 0.25}});
    EXPECT_EQ(mask.alpha_mode, scene::AlphaMode::mask);
    EXPECT_EQ(mask.alpha_cutoff, 0.25f);
    EXPECT_EQ(material({{"alphaMode", "MASK"}}).alpha_cutoff, 0.5f);
    EXPECT_EQ(material({{"alphaMode", "OPAQUE"}}).alpha_mode, scene::AlphaMode::opaque);
}

TEST(Material, AThirdUvSetInOneMaterialIsReplacedWithAWarning) {
    GltfBuilder b = with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                                   {"occlusionTexture", {{"index", 0}, {"texCoord", 1}}},
                                   {"emissiveTexture", {{"index", 0}, {"texCoord", 2}}}});
    add_texture(b, png_of_four_texels());
    Diagnostics diagnostics;
    EXPECT_EQ(load(b, diagnostics).materials[0].emissive_texture.uv_set, 0u);
    EXPECT_EQ(diagnostics.warnings().size(), 1u);
}

TEST(Sampler, EveryWrapAndFilterMode) {
    const auto sampler = [](const json& s) {
        GltfBuilder b = with_material({{"emissiveTexture", kTexture}});
        add_texture(b, png_of_four_texels());
        b.doc["textures"][0]["sampler"] = b.push("samplers", s);
        return load(b).textures.at(0).sampler;
    };
    using namespace scene;
    EXPECT_EQ(sampler(json::object()), Sampler());
    const std::pair<int, Wrap> wraps[] = {
        {10497, Wrap::repeat}, {33648, Wrap::mirrored_repeat}, {33071, Wrap::clamp_to_edge}};
    for (const auto& [number, wrap] : wraps) {
        EXPECT_EQ(sampler({{"wrapS", number}}).wrap_s, wrap);
        EXPECT_EQ(sampler({{"wrapT", number}}).wrap_t, wrap);
    }
    EXPECT_EQ(sampler({{"magFilter", 9728}}).magnify, Filter::nearest);
    const std::tuple<int, Filter, MipFilter> minify[] = {
        {9728, Filter::nearest, MipFilter::none},    {9729, Filter::linear, MipFilter::none},
        {9984, Filter::nearest, MipFilter::nearest}, {9985, Filter::linear, MipFilter::nearest},
        {9986, Filter::nearest, MipFilter::linear},  {9987, Filter::linear, MipFilter::linear}};
    for (const auto& [number, filter, mip] : minify) {
        EXPECT_EQ(sampler({{"minFilter", number}}).minify, filter) << number;
        EXPECT_EQ(sampler({{"minFilter", number}}).mip, mip) << number;
    }
}

TEST(Texture, PngWebpAndJpegByContent) {
    for (const std::vector<std::byte>& picture : {png_of_four_texels(), webp_of_four_texels()}) {
        GltfBuilder b = with_material({{"emissiveTexture", kTexture}});
        add_texture(b, picture);
        const scene::Image image = load(b).images.at(0);
        const std::vector<unsigned char> expected = four_texels();
        EXPECT_EQ(image.rgba, std::vector<std::uint8_t>(expected.begin(), expected.end()));
    }
    GltfBuilder b = with_material({{"emissiveTexture", kTexture}});
    add_texture(b, grey_jpeg());
    const scene::Image image = load(b).images.at(0);
    EXPECT_EQ(image.width, 8u);
    EXPECT_NEAR(image.rgba.at(0), 128, 1);
}

TEST(Texture, WebpOfTheExtensionComesBeforeTheFallback) {
    GltfBuilder b = with_material({{"emissiveTexture", kTexture}});
    add_texture(b, grey_jpeg());
    const int webp = b.push("images", {{"bufferView", b.view(webp_of_four_texels())}});
    b.doc["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = webp;
    b.doc["extensionsRequired"] = {"EXT_texture_webp"};
    const scene::Scene s = load(b);
    EXPECT_EQ(s.textures.at(0).image, 1u);
    EXPECT_EQ(s.images.at(1).width, 2u);
    EXPECT_EQ(s.images.at(0).width, 0u) << "what no material uses is not decoded";
}

TEST(Extension, UsedAndUnknownIsOneWarningRequiredAndUnknownAnErrorThatNamesIt) {
    GltfBuilder b = triangle();
    b.doc["extensionsUsed"] = {"VENDOR_a", "VENDOR_a", "KHR_materials_ior"};
    Diagnostics diagnostics;
    (void)load(b, diagnostics);
    ASSERT_EQ(diagnostics.warnings().size(), 1u);
    EXPECT_NE(diagnostics.warnings()[0].text.find("VENDOR_a"), std::string::npos);
    b.doc["extensionsRequired"] = {"KHR_mesh_quantization", "VENDOR_b"};
    EXPECT_NE(error_of(b).find("/extensionsRequired/1"), std::string::npos) << error_of(b);
    EXPECT_NE(error_of(b).find("VENDOR_b"), std::string::npos);
}

TEST(Container, TextWithBase64AndWithExternalFilesIsTheSameScene) {
    GltfBuilder b = with_material({{"emissiveTexture", kTexture}});
    const std::vector<std::byte> png = png_of_four_texels();
    const auto check = [&](const json& doc, const TemporaryFolder& folder) {
        std::ofstream(folder / "a.gltf") << doc.dump();
        Diagnostics diagnostics;
        const scene::Scene s = io::load_gltf(folder / "a.gltf", {}, diagnostics);
        EXPECT_EQ(only_primitive(s).positions, only_primitive(load(triangle())).positions);
        EXPECT_EQ(s.images.at(0).rgba.size(), 16u);
    };
    const auto put = [](const std::string& file, std::span<const std::byte> bytes) {
        std::filesystem::create_directories(std::filesystem::path(file).parent_path());
        std::ofstream(file, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    };
    const TemporaryFolder folder;
    json doc = b.doc;
    doc["textures"] = {{{"source", 0}}};
    doc["images"] = {{{"uri", "data:image/png;base64," + base64(png)}}};
    doc["buffers"] = {{{"byteLength", b.binary.size()},
                       {"uri", "data:application/octet-stream;base64," + base64(b.binary)}}};
    check(doc, folder);
    put(folder / "the data/b.bin", b.binary);
    put(folder / "c.png", png);
    doc["images"][0]["uri"] = "./c.png";
    doc["buffers"][0]["uri"] = "the%20data/b.bin";
    check(doc, folder);
}

TEST(Draco, TrianglesComeFromTheCompressedData) {
    Diagnostics diagnostics;
    const scene::Scene s = load(draco_strip(40), diagnostics);
    EXPECT_EQ(scene::triangle_count(s), 80u);
    EXPECT_TRUE(diagnostics.warnings().empty());
    const scene::Aabb bounds = scene::world_bounds(s);
    EXPECT_TRUE(near(bounds.max, {40, 1, 0}, 1e-3f));
}

TEST(Quantization, NormalsUvsAndPositionsOfBytesAndShorts) {
    GltfBuilder b = with_material({{"emissiveTexture", kTexture}});
    add_texture(b, png_of_four_texels());
    json& attributes = primitive_of(b)["attributes"];
    attributes["POSITION"] = b.accessor<std::int16_t>({-100, 0, 0, 100, 0, 0, 0, 300, 0}, "VEC3", 3);
    attributes["NORMAL"] = b.accessor<std::int8_t>({0, 0, 127, 0, 0, 127, 0, 0, 127}, "VEC3", 3, true);
    attributes["TEXCOORD_0"] = b.accessor<std::uint16_t>({0, 0, 65535, 0, 0, 65535}, "VEC2", 2, true);
    b.doc["extensionsRequired"] = {"KHR_mesh_quantization"};
    const scene::Scene s = load(b);
    const scene::Primitive& p = only_primitive(s);
    EXPECT_EQ(p.positions[2], glm::vec3(0, 300, 0));
    EXPECT_EQ(p.normals[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(p.uv[0][1], glm::vec2(1, 0));
}

TEST(Textures, ReadTheSetThatTheMaterialNames) {
    GltfBuilder b = with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    add_texture(b, png_of_four_texels());
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
