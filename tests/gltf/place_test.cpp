#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numeric>

#include "candela/io/gltf_origin.hpp"
#include "candela/io/gltf_write.hpp"
#include "candela/io/stage.hpp"
#include "common/files.hpp"
#include "gltf_samples.hpp"

using namespace candela;
using namespace candela::test;

// Where things stand: far from the origin, at extreme sizes, and many times over.
namespace {

const glm::dvec3 kUtm{500000.25, 12.5, 5000000.75};

GltfBuilder at(const glm::dvec3& place) {
    GltfBuilder b = triangle();
    b.doc["nodes"][0]["translation"] = {place.x, place.y, place.z};
    return b;
}

glm::dvec3 corner_in_world(const scene::Scene& s, std::size_t instance, std::size_t vertex) {
    const scene::Instance& i = s.instances.at(instance);
    const glm::vec3 x = s.meshes.at(i.mesh).primitives.at(0).positions.at(vertex);
    return s.frame.to_world(glm::vec3(i.world * glm::vec4(x, 1.0f)));
}

double off(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::length(a - b);
}

/// The triangle with instances; each row of `attributes` is one accessor.
GltfBuilder instanced(const json& attributes) {
    GltfBuilder b = triangle();
    b.doc["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
    b.doc["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    b.doc["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    return b;
}

}  // namespace

TEST(Place, NearTheOriginNothingMoves) {
    for (const glm::dvec3& place : {glm::dvec3(0.0), glm::dvec3(10, -3, 2), glm::dvec3(0, 0, 20)}) {
        const scene::Scene s = load(at(place));
        EXPECT_EQ(s.frame.origin_m, glm::dvec3(0.0));
        EXPECT_EQ(s.frame.unit_m, 1.0);
        EXPECT_EQ(glm::vec3(s.instances[0].world[3]), glm::vec3(place));
    }
}

TEST(Place, FarScenesKeepTheirDigits) {
    for (const glm::dvec3& place : {glm::dvec3(5e4, 0, 0), kUtm, glm::dvec3(1e7, 1e7, 1e7)}) {
        GltfBuilder b = at(place);
        b.push("nodes", {{"translation", {0.001, 0.002, 0.003}}, {"mesh", 0}});
        b.doc["nodes"][0]["children"] = {1};
        const scene::Scene s = load(b);
        const double largest = glm::length(glm::dvec3(s.instances[0].world[3]));
        EXPECT_LT(largest, 4.0);
        EXPECT_LT(off(corner_in_world(s, 0, 1), place + glm::dvec3(1, 0, 0)), 1e-6);
        EXPECT_LT(off(corner_in_world(s, 1, 1), place + glm::dvec3(1.001, 0.002, 0.003)), 1e-6);
    }
}

TEST(Place, VerticesInMapCoordinatesStandAboutTheirMeshsMiddle) {
    GltfBuilder b;
    const float x = 4000000.0f, y = 300.0f, z = 500000.0f;
    const int positions = b.accessor<float>({x, y, z, x + 4.0f, y, z, x, y + 4.0f, z}, "VEC3", 3);
    const int indices = b.accessor<std::uint16_t>({0, 1, 2}, "SCALAR", 1);
    b.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    // Turned a quarter about y, as exporters do whose z is up: in single precision that alone loses metres.
    b.doc["nodes"][0]["rotation"] = {0.0, std::sqrt(0.5), 0.0, std::sqrt(0.5)};
    const scene::Scene s = load(b);
    EXPECT_LT(glm::length(glm::vec3(s.instances[0].world[3])), 16.0f);
    EXPECT_LT(off(corner_in_world(s, 0, 1) - corner_in_world(s, 0, 0), {0, 0, -4}), 1e-6);
    EXPECT_LT(off(corner_in_world(s, 0, 0), {500000.0, 300.0, -4000000.0}), 1e-6);
}

TEST(Place, SkinsFarAwayKeepTheirDigits) {
    GltfBuilder b = skinned();
    b.doc["nodes"][1]["translation"] = {kUtm.x + 1.0, kUtm.y, kUtm.z};
    const scene::Scene s = load(b);
    EXPECT_EQ(s.frame.unit_m, 1.0);
    EXPECT_LT(off(corner_in_world(s, 0, 0), kUtm + glm::dvec3(1, 0, 0)), 1e-6);
    EXPECT_LT(off(corner_in_world(s, 0, 1), kUtm + glm::dvec3(2, 2, 0)), 1e-6);
}

TEST(Place, AWideSceneStandsAboutItsCamera) {
    GltfBuilder b = at(glm::dvec3(0.0));
    b.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}});
    b.push("nodes", {{"mesh", 0}, {"translation", {kUtm.x, kUtm.y, kUtm.z}}});
    b.push("nodes", {{"camera", 0}, {"translation", {kUtm.x, kUtm.y, kUtm.z + 3.0}}});
    b.doc["scenes"][0]["nodes"] = {0, 1, 2};
    const scene::Scene s = load(b);
    EXPECT_LT(glm::length(glm::vec3(s.cameras.at(0).world[3])), 4.0f);
    EXPECT_LT(off(corner_in_world(s, 1, 1), kUtm + glm::dvec3(1, 0, 0)), 1e-6);
}

TEST(Place, TinyMeshesHaveNormalsAndTangents) {
    GltfBuilder b = with_material({{"normalTexture", {{"index", 0}}}});
    add_texture(b, png_of_four_texels());
    b.doc["accessors"][0] =
        b.doc["accessors"]
             [static_cast<std::size_t>(b.accessor<float>({0, 0, 0, 1e-12f, 0, 0, 0, 1e-12f, 0}, "VEC3", 3))];
    primitive_of(b)["attributes"].erase("NORMAL");
    const scene::Scene s = load(b);
    const scene::Primitive& p = only_primitive(s);
    EXPECT_TRUE(near(p.normals.at(0), {0, 0, 1}));
    EXPECT_TRUE(near(glm::vec3(p.tangents.at(0)), {1, 0, 0}));
    EXPECT_LT(off(corner_in_world(s, 0, 1), {1e-12, 0, 0}), 1e-18);
}

TEST(Place, StagesAreInTheWorld) {
    const TemporaryFolder folder;
    spit(folder / "stage.json", R"({"lights": [
        {"name": "lamp", "type": "point", "power_lm": 800, "position": [500001.25, 13.5, 5000000.75],
         "look_at": [500001.25, 0, 5000000.75]}],
        "reflection_probes": [{"center": [500000.75, 12.5, 5000001.0], "size_m": [2, 2, 2]}],
        "camera": {"look_from": [500001.125, 13, 5000004], "look_at": [500000.25, 12.5, 5000000.75]}})");
    scene::Scene s = load(at(kUtm));
    const io::Stage stage = io::load_stage(folder / "stage.json");
    Diagnostics diagnostics;
    io::place_stage_lights(stage.lights, s, diagnostics);
    io::place_stage_probes(stage.probes, s);
    EXPECT_LT(off(s.frame.to_world(s.lights.at(0).position), {500001.25, 13.5, 5000000.75}), 1e-6);
    EXPECT_TRUE(near(s.lights[0].direction, {0, -1, 0}));
    EXPECT_LT(
        off(s.frame.to_world(glm::vec3(s.reflection_probes.at(0).world[3])), {500000.75, 12.5, 5000001.0}),
        1e-6);
    EXPECT_EQ(stage.camera.look_from->x, 500001.125);
}

TEST(Place, WrittenScenesStandWhereTheyStood) {
    const TemporaryFolder folder;
    GltfBuilder b = at(kUtm);
    b.doc["nodes"][0]["name"] = "here";
    b.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}});
    b.push("nodes", {{"camera", 0}, {"translation", {kUtm.x, kUtm.y, kUtm.z + 3.0}}});
    b.doc["scenes"][0]["nodes"] = {0, 1};
    const scene::Scene before = load(b);
    Diagnostics diagnostics;
    io::write_gltf(folder / "out.gltf", before, diagnostics);
    const json written = json::parse(slurp(folder / "out.gltf"));
    const glm::dvec3 corner = corner_in_world(before, 0, 0);
    EXPECT_LT(off(corner, kUtm), 1e-6);
    const scene::Scene after = io::load_gltf(folder / "out.gltf", {}, diagnostics);
    EXPECT_LT(off(corner_in_world(after, 0, 1), corner_in_world(before, 0, 1)), 1e-6);
    const auto eye = [](const scene::Scene& s) {
        return s.frame.to_world(glm::vec3(s.cameras.at(0).world[3]));
    };
    EXPECT_LT(off(eye(after), kUtm + glm::dvec3(0, 0, 3)), 1e-6);
    EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(SharedVertices, AreDecodedOnceAndEachPrimitiveKeepsItsOwn) {
    constexpr std::uint32_t vertices = 100000, primitives = 480;
    GltfBuilder b;
    std::vector<float> positions(3 * vertices);
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = static_cast<float>(i % 971);
    const int shared = b.accessor<float>(positions, "VEC3", 3);
    json list = json::array();
    for (std::uint32_t p = 0; p < primitives; ++p) {
        const std::uint32_t first = p * 200;
        const int indices = b.accessor<std::uint32_t>(
            {first + 2, first, first + 101, first, first + 2, first + 7}, "SCALAR", 1);
        list.push_back({{"attributes", {{"POSITION", shared}, {"NORMAL", shared}}}, {"indices", indices}});
    }
    b.push("meshes", {{"primitives", list}});
    b.push("nodes", {{"mesh", 0}});
    b.doc["scenes"] = {{{"nodes", {0}}}};
    // A copy of the list for each primitive would be 480 x 100,000 x 24 bytes: more than this file can need.
    const scene::Scene s = load(b);
    ASSERT_EQ(s.meshes[0].primitives.size(), primitives);
    const scene::Primitive& last = s.meshes[0].primitives.back();
    EXPECT_EQ(last.positions.size(), 4u);
    EXPECT_EQ(last.indices, (std::vector<std::uint32_t>{1, 0, 3, 0, 1, 2}));
    const std::size_t first = 3 * 200 * (primitives - 1);
    EXPECT_EQ(last.positions[0], glm::vec3(positions[first], positions[first + 1], positions[first + 2]));
    EXPECT_EQ(last.positions[3],
              glm::vec3(positions[first + 303], positions[first + 304], positions[first + 305]));
}

TEST(Instancing, TranslationRotationAndScaleOfEachInstance) {
    GltfBuilder b = triangle();
    b.doc["nodes"][0]["translation"] = {0, 0, 5};
    json& extension = b.doc["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"];
    extension["attributes"]["TRANSLATION"] = b.accessor<float>({1, 0, 0, 0, 2, 0}, "VEC3", 3);
    extension["attributes"]["SCALE"] = b.accessor<float>({1, 1, 1, 3, 3, 3}, "VEC3", 3);
    const std::vector<float> turns{0, 0, 0, 1, 0, 0, std::sqrt(0.5f), std::sqrt(0.5f)};
    const auto quantized = [&]<class T>(T largest) {
        std::vector<T> out;
        for (const float x : turns)
            out.push_back(static_cast<T>(std::lround(x * static_cast<float>(largest))));
        return out;
    };
    for (const int rotation : {b.accessor<float>(turns, "VEC4", 4),
                               b.accessor<std::int16_t>(quantized(std::int16_t{32767}), "VEC4", 4, true),
                               b.accessor<std::int8_t>(quantized(std::int8_t{127}), "VEC4", 4, true)}) {
        extension["attributes"]["ROTATION"] = rotation;
        const scene::Scene s = load(b);
        ASSERT_EQ(s.instances.size(), 2u);
        EXPECT_EQ(s.instances[0].mesh, s.instances[1].mesh);
        EXPECT_EQ(s.meshes.size(), 1u);
        EXPECT_LT(off(corner_in_world(s, 0, 1), {2, 0, 5}), 1e-5);
        // (1, 0, 0) scaled by 3, turned a quarter about z, moved.
        EXPECT_LT(off(corner_in_world(s, 1, 1), {0, 5, 5}), 1e-5);
    }
}

TEST(Instancing, RequiredIsReadAndOddOnesAreDrawnAsFarAsTheyGo) {
    GltfBuilder b = instanced(json::object());
    EXPECT_EQ(load(b).instances.size(), 1u);  // an extension without attributes is none
    json& attributes = b.doc["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    attributes["TRANSLATION"] = b.accessor<float>({0, 0, 0, 1, 0, 0, 2, 0, 0}, "VEC3", 3);
    attributes["_ID"] = b.accessor<float>({1, 2, 3}, "SCALAR", 1);
    EXPECT_EQ(load(b).instances.size(), 3u);
    attributes["SCALE"] = b.accessor<float>({1, 1, 1, 2, 2, 2}, "VEC3", 3);
    Diagnostics diagnostics;
    EXPECT_EQ(load(b, diagnostics).instances.size(), 2u);
    ASSERT_EQ(diagnostics.warnings().size(), 1u);
    EXPECT_NE(diagnostics.warnings()[0].text.find("differ in length"), std::string::npos);
}

TEST(Instancing, IsWrittenAsOneMeshOfManyNodes) {
    const TemporaryFolder folder;
    GltfBuilder b = instanced(json::object());
    b.doc["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        b.accessor<float>({0, 0, 0, 1, 0, 0, 2, 0, 0}, "VEC3", 3);
    Diagnostics diagnostics;
    io::write_gltf(folder / "out.glb", load(b), diagnostics);
    const scene::Scene s = io::load_gltf(folder / "out.glb", {}, diagnostics);
    EXPECT_EQ(s.meshes.size(), 1u);
    ASSERT_EQ(s.instances.size(), 3u);
    EXPECT_LT(off(corner_in_world(s, 2, 1), {3, 0, 0}), 1e-6);
}

TEST(Memory, DecodedImagesAreBoundedByTheBudgetAlone) {
    GltfBuilder b = with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    add_texture(b, png_of_four_texels());
    io::GltfOptions options;
    options.memory = scene::MemoryBudget{1 << 20, true};
    EXPECT_NO_THROW((void)load(b, options));
    // 2^26 texels are 256 MiB, whatever the bytes that follow: the header says enough.
    std::vector<std::byte> large = png_of_four_texels();
    for (const std::size_t at : {16u, 20u}) {
        large[at] = large[at + 1] = large[at + 3] = std::byte{0};
        large[at + 2] = std::byte{0x20};
    }
    b.doc["images"][0]["bufferView"] = b.view(large);
    try {
        (void)load(b, options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::machine);
        EXPECT_NE(error.line().find("--memory allows 1.0 MiB"), std::string::npos) << error.line();
        EXPECT_NE(error.line().find("256 MiB"), std::string::npos) << error.line();
    }
}
