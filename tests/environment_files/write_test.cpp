#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "candela/io/environment_read.hpp"
#include "candela/io/environment_write.hpp"
#include "candela/io/image_read.hpp"
#include "candela/scene/error.hpp"
#include "common/files.hpp"
#include "filtered.hpp"
#include "shading/environment.glsl"
#include "texture_files.hpp"

namespace candela::test {
namespace {

using io::CubeFormat;
using io::EnvironmentPreset;
using nlohmann::json;
using scene::RoughnessMapping;

std::uint32_t word(const Text& bytes, std::size_t at) {
    std::uint32_t out = 0;
    for (std::size_t i = 0; i < 4; ++i)
        out |= std::uint32_t(static_cast<unsigned char>(bytes.at(at + i))) << 8 * i;
    return out;
}

void expect_near(const glm::vec3& value, const glm::vec3& expected, float relative, const std::string& what) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(value[c], expected[c], relative * std::abs(expected[c])) << what << ", channel " << c;
}

json metadata_of(const TemporaryFolder& folder) {
    return json::parse(slurp(folder / "environment.json"));
}

/// Texels of the tests' sizes are coarse: a direction inside a texel is off by half of it.
float coarse(std::uint32_t size) {
    return 3.0f / float(size);
}

// --- Filament: KTX 1 by its specification, and what Filament's shaders do with it.

struct Ktx1 {
    std::uint32_t size = 0;
    std::map<Text, Text> keys;
    std::vector<std::array<Text, 6>> levels;
};

Ktx1 parse_ktx1(const Text& bytes) {
    Ktx1 out;
    EXPECT_EQ(bytes.substr(0, 12), Text("\xabKTX 11\xbb\r\n\x1a\n", 12));
    EXPECT_EQ(word(bytes, 12), 0x04030201u);
    EXPECT_EQ(word(bytes, 16), 0x8c3bu) << "GL_UNSIGNED_INT_10F_11F_11F_REV";
    EXPECT_EQ(word(bytes, 28), 0x8c3au) << "GL_R11F_G11F_B10F";
    out.size = word(bytes, 36);
    EXPECT_EQ(word(bytes, 52), 6u) << "faces";
    const std::uint32_t levels = word(bytes, 56), key_bytes = word(bytes, 60);
    for (std::size_t at = 64; at < 64 + key_bytes;) {
        const Text entry = bytes.substr(at + 4, word(bytes, at));
        out.keys[entry.substr(0, entry.find('\0'))] = entry.substr(entry.find('\0') + 1);
        at += 4 + (entry.size() + 3) / 4 * 4;
    }
    std::size_t at = 64 + key_bytes;
    for (std::uint32_t level = 0; level < levels; ++level) {
        const std::uint32_t face_bytes = word(bytes, at);
        at += 4;
        out.levels.emplace_back();
        for (Text& face : out.levels.back()) {
            face = bytes.substr(at, face_bytes);
            at += face_bytes;
        }
    }
    EXPECT_EQ(at, bytes.size());
    return out;
}

glm::vec3 ktx1_texture(const Ktx1& file, const glm::vec3& direction, std::uint32_t level) {
    const std::uint32_t size = file.size >> level;
    const FacePoint p = gl_face(direction);
    const auto x = std::uint32_t(p.st.x * float(size)), y = std::uint32_t(p.st.y * float(size));
    return rgb_of_b10g11r11(word(file.levels.at(level)[p.face], 4 * (y * size + x)));
}

TEST(Filament, ItsShadersFindDirectionsScaleRoughnessAndHarmonics) {
    const TemporaryFolder folder;
    const auto files =
        io::write_filtered_environment(folder.path(), filtered(RoughnessMapping::filament, 32, 4),
                                       CubeFormat::ktx2, EnvironmentPreset::filament);
    EXPECT_EQ(files.back().filename(), "environment.json");
    const Ktx1 ibl = parse_ktx1(slurp(folder / "environment_ibl.ktx"));
    ASSERT_EQ(ibl.levels.size(), 4u);
    const json metadata = metadata_of(folder);
    const float intensity = metadata["units"]["nit_per_unit"];
    for (const glm::vec3& d : probes()) {
        for (std::uint32_t level = 0; level < 4; ++level)
            expect_near(intensity * ktx1_texture(ibl, d, level), specular_nit(d, level),
                        coarse(32 >> level) + 0.02f, "level");
    }
    // perceptualRoughnessToLod of its shaders.
    for (const json& level : metadata["specular"]["levels"]) {
        const float r = level["perceptual_roughness"];
        EXPECT_NEAR(3.0f * r * (2.0f - r), float(level["level"]), 1e-5f);
    }
    // Irradiance_SphericalHarmonics of its shaders.
    std::istringstream text(ibl.keys.at("sh"));
    std::array<glm::vec3, 9> sh;
    for (glm::vec3& c : sh) text >> c.x >> c.y >> c.z;
    ASSERT_TRUE(bool(text));
    for (const glm::vec3& n : probes()) {
        const glm::vec3 value = sh[0] + sh[1] * n.y + sh[2] * n.z + sh[3] * n.x + sh[4] * (n.y * n.x) +
                                sh[5] * (n.y * n.z) + sh[6] * (3.0f * n.z * n.z - 1.0f) +
                                sh[7] * (n.z * n.x) + sh[8] * (n.x * n.x - n.y * n.y);
        expect_near(intensity * value, irradiance_over_pi_nit(n), 1e-5f, "harmonics");
    }
    EXPECT_EQ(parse_ktx1(slurp(folder / "environment_skybox.ktx")).levels.size(), 1u);
}

TEST(Filament, OtherMappingsAndSizesAreRefused) {
    const TemporaryFolder folder;
    const auto write = [&](const scene::FilteredEnvironment& e) {
        (void)io::write_filtered_environment(folder / "new", e, CubeFormat::ktx2,
                                             EnvironmentPreset::filament);
    };
    EXPECT_THROW(write(filtered(RoughnessMapping::linear, 32, 4)), Error);
    EXPECT_THROW(write(filtered(RoughnessMapping::filament, 12, 2)), Error);
    EXPECT_FALSE(std::filesystem::exists(folder / "new"));
}

// --- three.js: equirectUv and shGetIrradianceAt of its shaders, LightProbe.fromJSON.

TEST(Threejs, ItsShadersFindDirectionsScaleAndHarmonics) {
    const TemporaryFolder folder;
    (void)io::write_filtered_environment(folder.path(), filtered(RoughnessMapping::linear, 32, 3),
                                         CubeFormat::ktx2, EnvironmentPreset::threejs);
    const io::FloatImage picture = io::read_exr(folder / "environment.exr");
    ASSERT_EQ(picture.width, 2 * picture.height);
    const float intensity = metadata_of(folder)["units"]["nit_per_unit"];
    const float pi = std::numbers::pi_v<float>;
    for (const glm::vec3& d : probes()) {
        const float u = std::atan2(d.z, d.x) / (2.0f * pi) + 0.5f, v = std::asin(d.y) / pi + 0.5f;
        const auto x = std::min(std::uint32_t(u * float(picture.width)), picture.width - 1);
        const auto y =
            std::min(std::uint32_t((1.0f - v) * float(picture.height)), picture.height - 1);  // flipY
        glm::vec3 value;
        for (int c = 0; c < 3; ++c)
            value[c] = (*picture.find(c == 0 ? "R" : c == 1 ? "G" : "B"))[y * picture.width + x];
        expect_near(intensity * value, specular_nit(d, 0), coarse(32), "picture");
    }
    const json probe = json::parse(slurp(folder / "light_probe.json"))["object"];
    EXPECT_EQ(probe["type"], "LightProbe");
    const std::vector<float> sh = probe["sh"];
    ASSERT_EQ(sh.size(), 27u);
    const auto k = [&](std::size_t i) { return glm::vec3(sh[3 * i], sh[3 * i + 1], sh[3 * i + 2]); };
    for (const glm::vec3& n : probes()) {
        const glm::vec3 irradiance =
            k(0) * 0.886227f + k(1) * 2.0f * 0.511664f * n.y + k(2) * 2.0f * 0.511664f * n.z +
            k(3) * 2.0f * 0.511664f * n.x + k(4) * 2.0f * 0.429043f * n.x * n.y +
            k(5) * 2.0f * 0.429043f * n.y * n.z + k(6) * (0.743125f * n.z * n.z - 0.247708f) +
            k(7) * 2.0f * 0.429043f * n.x * n.z + k(8) * 0.429043f * (n.x * n.x - n.y * n.y);
        expect_near(float(probe["intensity"]) / pi * irradiance, irradiance_over_pi_nit(n), 1e-4f,
                    "harmonics");
    }
}

// Each texel as it was, in the direction in which three.js looks for it; a peak beyond half floats by the
// unit.
TEST(Threejs, AnEquirectangularSourceIsOnlyTurned) {
    for (const float peak : {78848.0f, 40000.0f}) {
        for (const float rotation_deg : {0.0f, 90.0f, -33.75f, 725.625f}) {
            scene::Environment source;
            source.width = 64;
            source.height = 32;
            for (std::uint32_t i = 0; i < 64 * 32; ++i)
                source.luminance_nit.emplace_back(i % 61, i % 7, 1.0f);
            const std::size_t sun = 9 * 64 + 21;
            source.luminance_nit[sun] = glm::vec3(peak, 0.5f * peak, 0.0f);
            source.scale = 2.0f;
            source.rotation_rad = rotation_deg * std::numbers::pi_v<float> / 180.0f;
            const TemporaryFolder folder;
            (void)io::write_filtered_environment(folder.path(), filtered(RoughnessMapping::linear, 4, 1),
                                                 CubeFormat::ktx2, EnvironmentPreset::threejs, &source);
            const io::FloatImage picture = io::read_exr(folder / "environment.exr");
            ASSERT_EQ(picture.width, 64u);
            const float unit = metadata_of(folder)["units"]["nit_per_unit"];
            for (std::uint32_t i = 0; i < 64 * 32; ++i) {
                const glm::vec2 uv((float(i % 64) + 0.5f) / 64.0f, (float(i / 64) + 0.5f) / 32.0f);
                const glm::vec3 d =
                    shading::rotate_about_y(shading::equirect_direction(uv), source.rotation_rad);
                const float u = std::atan2(d.z, d.x) / (2.0f * std::numbers::pi_v<float>)+0.5f;
                const std::size_t at = i / 64 * 64 + std::size_t(u * 64.0f) % 64;
                const glm::vec3 value((*picture.find("R"))[at], (*picture.find("G"))[at],
                                      (*picture.find("B"))[at]);
                const glm::vec3 expected = 2.0f * source.luminance_nit[i];
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(value[c] * unit, expected[c], 1.0e-3f * expected[c] + 1.0e-4f) << i;
            }
            const json probe = json::parse(slurp(folder / "light_probe.json"))["object"];
            EXPECT_EQ(float(probe["intensity"]), unit);
            const glm::vec3 mean = kNitPerUnit * filtered(RoughnessMapping::linear, 4, 1).radiance_sh[0];
            EXPECT_NEAR(float(probe["sh"][0]) * unit, mean.x, 1.0e-4f * mean.x);
        }
    }
}

// --- glTF: EXT_lights_image_based by its text.

float linear_of_srgb(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

TEST(GltfLight, TheExtensionsTextFindsDirectionsScaleRoughnessAndHarmonics) {
    const TemporaryFolder folder;
    (void)io::write_filtered_environment(folder.path(), filtered(RoughnessMapping::linear, 64, 3),
                                         CubeFormat::ktx2, EnvironmentPreset::gltf);
    const json gltf = json::parse(slurp(folder / "environment.gltf"));
    EXPECT_EQ(gltf["extensionsUsed"][0], "EXT_lights_image_based");
    EXPECT_EQ(gltf["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"], 0);
    const json light = gltf["extensions"]["EXT_lights_image_based"]["lights"][0];
    EXPECT_EQ(light["specularImageSize"], 64);
    ASSERT_EQ(light["specularImages"].size(), 3u);
    const float intensity = light["intensity"];
    for (std::uint32_t level = 0; level < 3; ++level) {
        const std::uint32_t size = 64 >> level;
        std::vector<scene::Image> faces;
        for (const json& index : light["specularImages"][level]) {
            const std::string uri = gltf["images"][index.get<std::size_t>()]["uri"];
            faces.push_back(io::decode_image(io::read_file(folder / uri, 1 << 20), uri));
            ASSERT_EQ(faces.back().width, size);
        }
        ASSERT_EQ(faces.size(), 6u);
        for (const glm::vec3& d : probes()) {
            const FacePoint p = gl_face(d);
            // Flipped about its vertical axis.
            const auto x = std::uint32_t((1.0f - p.st.x) * float(size)),
                       y = std::uint32_t(p.st.y * float(size));
            const std::uint8_t* texel = &faces[p.face].rgba[4 * (y * size + x)];
            glm::vec3 value;
            for (int c = 0; c < 3; ++c)
                value[c] = linear_of_srgb(float(texel[c]) / 255.0f) / (float(texel[3]) / 255.0f);
            expect_near(intensity * value, specular_nit(d, level), coarse(size) + 0.03f,
                        "level " + std::to_string(level));
        }
        const float roughness = metadata_of(folder)["specular"]["levels"][level]["perceptual_roughness"];
        EXPECT_FLOAT_EQ(roughness, float(level) / 2.0f) << "mips map evenly to roughness from 0 to 1";
    }
    const std::vector<std::array<float, 3>> sh = light["irradianceCoefficients"];
    ASSERT_EQ(sh.size(), 9u);
    const float k[9] = {0.282095f, 0.488603f, 0.488603f, 0.488603f, 1.092548f,
                        1.092548f, 0.315392f, 1.092548f, 0.546274f};
    for (const glm::vec3& n : probes()) {
        const float terms[9] = {
            1, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3 * n.z * n.z - 1, n.x * n.z, n.x * n.x - n.y * n.y};
        glm::vec3 irradiance(0.0f);
        for (std::size_t i = 0; i < 9; ++i)
            irradiance += glm::vec3(sh[i][0], sh[i][1], sh[i][2]) * (k[i] * terms[i]);
        expect_near(intensity * irradiance / std::numbers::pi_v<float>, irradiance_over_pi_nit(n), 1e-4f,
                    "harmonics");
    }
}

TEST(GltfLight, WhatIsBrighterThanRgbdReachesIsScaledAndNotClipped) {
    const TemporaryFolder folder;
    scene::FilteredEnvironment e = filtered(RoughnessMapping::linear, 4, 1);
    e.specular[0].texels[5] = glm::vec3(5100.0f, 2550.0f, 5100.0f);
    (void)io::write_filtered_environment(folder.path(), e, CubeFormat::ktx2, EnvironmentPreset::gltf);
    const json gltf = json::parse(slurp(folder / "environment.gltf"));
    const float intensity = gltf["extensions"]["EXT_lights_image_based"]["lights"][0]["intensity"];
    const scene::Image face = io::decode_image(io::read_file(folder / "specular_0_px.png", 1 << 20), "px");
    const std::uint8_t* texel = &face.rgba[4 * (1 * 4 + (3 - 1))];
    EXPECT_NEAR(intensity * linear_of_srgb(float(texel[0]) / 255.0f) * 255.0f / float(texel[3]),
                5100.0f * kNitPerUnit, 0.01f * 5100.0f * kNitPerUnit);
    EXPECT_NEAR(intensity * linear_of_srgb(float(texel[1]) / 255.0f) * 255.0f / float(texel[3]),
                2550.0f * kNitPerUnit, 0.01f * 2550.0f * kNitPerUnit);
}

// --- Candela's own.

TEST(Candela, Ktx2HoldsEveryLevelWhereItsSpecificationSaysIt) {
    for (const CubeFormat format : {CubeFormat::ktx2, CubeFormat::ktx2_rgb9e5}) {
        const TemporaryFolder folder;
        (void)io::write_filtered_environment(folder.path(), filtered(RoughnessMapping::frostbite, 16, 3),
                                             format, EnvironmentPreset::candela);
        const Text bytes = slurp(folder / "specular.ktx2");
        const bool half = format == CubeFormat::ktx2;
        EXPECT_EQ(word(bytes, 12), half ? 97u : 123u);
        EXPECT_EQ(word(bytes, 16), half ? 2u : 4u);
        EXPECT_EQ(word(bytes, 36), 6u);
        EXPECT_EQ(word(bytes, 40), 3u);
        // The descriptor: its own size, one block, and as many bits a texel as the format has.
        const std::uint32_t descriptor = word(bytes, 48);
        EXPECT_EQ(word(bytes, descriptor), word(bytes, 52));
        EXPECT_EQ(word(bytes, descriptor + 8) >> 16, word(bytes, 52) - 4);
        EXPECT_EQ(word(bytes, descriptor + 20), half ? 8u : 4u);
        // Every bit of a texel is some sample's; the exponent of E5B9G9R9 is shared by three.
        std::uint64_t bits = 0;
        std::set<std::uint32_t> channels;
        for (std::uint32_t at = descriptor + 28; at < descriptor + word(bytes, descriptor); at += 16) {
            const std::uint32_t sample = word(bytes, at);
            const std::uint32_t length = (sample >> 16 & 0xff) + 1, offset = sample & 0xffff;
            bits |= (length == 64 ? 0 : (std::uint64_t{1} << length) - 1) << offset;
            channels.insert(sample >> 24 & 15);
        }
        EXPECT_EQ(bits, half ? ~std::uint64_t{0} : 0xffffffffu);
        EXPECT_EQ(channels, (half ? std::set<std::uint32_t>{0, 1, 2, 15} : std::set<std::uint32_t>{0, 1, 2}));
        for (std::uint32_t level = 0; level < 3; ++level) {
            const std::uint32_t size = 16 >> level, texel = half ? 8 : 4;
            const std::size_t at = word(bytes, 80 + 24 * level);
            EXPECT_EQ(at % texel, 0u);
            ASSERT_EQ(word(bytes, 80 + 24 * level + 8), 6 * size * size * texel);
            for (const glm::vec3& d : probes()) {
                const FacePoint p = gl_face(d);
                const std::size_t where =
                    at + texel * ((p.face * size + std::size_t(p.st.y * float(size))) * size +
                                  std::size_t(p.st.x * float(size)));
                const glm::vec3 value = half ? glm::vec3(float_of_half(word(bytes, where) & 0xffff),
                                                         float_of_half(word(bytes, where) >> 16),
                                                         float_of_half(word(bytes, where + 4) & 0xffff))
                                             : rgb_of_e5b9g9r9(word(bytes, where));
                expect_near(kNitPerUnit * value, specular_nit(d, level), coarse(size) + 0.005f,
                            "level " + std::to_string(level));
            }
        }
        const json metadata = metadata_of(folder);
        EXPECT_EQ(metadata["specular"]["roughness_mapping"], "frostbite");
        EXPECT_FLOAT_EQ(metadata["specular"]["levels"][1]["perceptual_roughness"], 0.25f);
    }
}

TEST(Candela, WhatItWritesItReadsAsTheSameLight) {
    for (const CubeFormat format : {CubeFormat::ktx2, CubeFormat::ktx2_rgb9e5, CubeFormat::dds,
                                    CubeFormat::exr, CubeFormat::exr_faces}) {
        const TemporaryFolder folder;
        (void)io::write_filtered_environment(folder.path(), filtered(RoughnessMapping::linear, 32, 2), format,
                                             EnvironmentPreset::candela);
        Diagnostics diagnostics;
        io::EnvironmentOptions options;
        float unit = 1.0f;
        std::string file = "specular.ktx2";
        if (format == CubeFormat::dds)
            file = "specular.dds", unit = kNitPerUnit, options.cube_space = scene::CubeSpace::direct;
        if (format == CubeFormat::exr) file = "specular_0.exr";
        if (format == CubeFormat::exr_faces)
            file = "specular_0_{face}.exr", options.cube_space = scene::CubeSpace::direct;
        const scene::Environment e = io::read_environment(folder / file, diagnostics, options);
        for (const glm::vec3& d : probes())
            expect_near(unit * seen(e, d), specular_nit(d, 0), coarse(32),
                        std::string("format ") + io::name_of(format));
    }
}

TEST(Candela, HarmonicsAsJsonCAndGlslAreTheSameNumbers) {
    const TemporaryFolder folder;
    (void)io::write_filtered_environment(folder.path(), filtered(RoughnessMapping::linear, 4, 1),
                                         CubeFormat::dds, EnvironmentPreset::candela);
    const json sh = json::parse(slurp(folder / "irradiance_sh.json"));
    const std::vector<std::array<float, 3>> terms = sh["coefficients_of_terms"];
    for (const char* name : {"irradiance_sh.h", "irradiance_sh.glsl"}) {
        const Text source = slurp(folder / name);
        std::vector<float> numbers;
        for (std::size_t at = source.find("environment_sh["), end = source.find(';', at); at < end; ++at) {
            if (source[at] != '{' && source[at] != '(' && source[at] != ' ') continue;
            char* stop = nullptr;
            const float value = std::strtof(source.c_str() + at + 1, &stop);
            if (stop != source.c_str() + at + 1 && *stop == 'f') numbers.push_back(value);
        }
        ASSERT_EQ(numbers.size(), 27u) << name;
        for (std::size_t i = 0; i < 27; ++i) EXPECT_EQ(numbers[i], terms[i / 3][i % 3]) << name;
    }
    EXPECT_FLOAT_EQ(terms[3][2], kNitPerUnit);
}

TEST(Writing, AFailureLeavesNothingBehind) {
    const TemporaryFolder folder;
    const auto write = [&](const std::string& to) {
        (void)io::write_filtered_environment(to, filtered(RoughnessMapping::linear, 4, 1), CubeFormat::ktx2,
                                             EnvironmentPreset::candela);
    };
    spit(folder / "file", "");
    EXPECT_THROW(write(folder / "file"), Error);
    // The last file cannot take its place.
    std::filesystem::create_directories(folder / "out/environment.json/in the way");
    EXPECT_THROW(write(folder / "out"), Error);
    const auto left = std::distance(std::filesystem::directory_iterator(folder / "out"), {});
    EXPECT_EQ(left, 1) << "only what was in the way";
    write(folder / "new");
    EXPECT_TRUE(std::filesystem::exists(folder / "new/environment.json"));
    write(folder / "new/");
    // The last folder is made, no other.
    EXPECT_THROW(write(folder / "a/new/folder"), Error);
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
}

}  // namespace
}  // namespace candela::test
