#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

#include "gltf_builder.hpp"

using namespace candela;
using namespace candela::test;

namespace {

/// The triangles as corner positions, each turned so that its smallest corner is first: winding is kept.
std::multiset<std::vector<float>> triangles(const scene::Primitive& p) {
    std::multiset<std::vector<float>> out;
    for (std::size_t i = 0; i < p.indices.size(); i += 3) {
        std::vector<std::vector<float>> corners;
        for (std::size_t c = 0; c < 3; ++c) {
            const glm::vec3 x = p.positions[p.indices[i + c]];
            corners.push_back({x.x, x.y, x.z});
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        std::vector<float> flat;
        for (const auto& c : corners) flat.insert(flat.end(), c.begin(), c.end());
        out.insert(flat);
    }
    return out;
}

GltfBuilder ribbon(int mode, const std::vector<std::uint16_t>& order) {
    GltfBuilder b;
    const int positions = b.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3", 3);
    const int indices = b.accessor<std::uint16_t>(order, "SCALAR", 1);
    b.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"mode", mode}});
    return b;
}

}  // namespace

TEST(Mesh, StripsAndFansAreTheSameTrianglesAsLists) {
    const auto list = triangles(only_primitive(load(ribbon(4, {0, 1, 2, 1, 3, 2, 2, 3, 4}))));
    ASSERT_EQ(list.size(), 3u);
    EXPECT_EQ(triangles(only_primitive(load(ribbon(5, {0, 1, 2, 3, 4})))), list);
    const auto fan_list = triangles(only_primitive(load(ribbon(4, {0, 1, 3, 0, 3, 2, 0, 2, 4}))));
    EXPECT_EQ(triangles(only_primitive(load(ribbon(6, {0, 1, 3, 2, 4})))), fan_list);
}

TEST(Mesh, PointsAndLinesAreStrokes) {
    const std::vector<std::pair<int, std::vector<std::uint32_t>>> expected{
        {0, {0, 1, 2, 3, 4}},
        {1, {0, 1, 2, 3}},  // the odd end has no partner
        {2, {0, 1, 1, 2, 2, 3, 3, 4, 4, 0}},
        {3, {0, 1, 1, 2, 2, 3, 3, 4}}};
    for (const auto& [mode, indices] : expected) {
        Diagnostics diagnostics;
        const scene::Scene s = load(ribbon(mode, {0, 1, 2, 3, 4}), diagnostics);
        EXPECT_TRUE(diagnostics.warnings().empty()) << mode;
        EXPECT_EQ(scene::triangle_count(s), 0u);
        ASSERT_EQ(s.meshes.at(0).strokes.size(), 1u) << mode;
        const scene::Stroke& stroke = s.meshes[0].strokes[0];
        EXPECT_EQ(stroke.geometry.indices, indices) << mode;
        EXPECT_EQ(stroke.kind, mode == 0 ? scene::StrokeKind::points : scene::StrokeKind::lines);
        EXPECT_EQ(stroke.geometry.bounds.max, glm::vec3(1, mode == 1 ? 1 : 2, 0)) << "of the vertices in use";
    }
}

// glTF 2.0, "Point and line materials": without normals they are the sum of base colour and emission, unlit.
TEST(Mesh, LinesWithoutNormalsAreUnlitAndLinesWithNormalsAreLit) {
    for (const bool normals : {false, true}) {
        GltfBuilder b = ribbon(3, {0, 1, 2, 3, 4});
        json& primitive = b.doc["meshes"][0]["primitives"][0];
        if (normals)
            primitive["attributes"]["NORMAL"] =
                b.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
        primitive["material"] =
            b.push("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0.25, 0.5, 0.5, 1}}}}});
        const scene::Scene s = load(b);
        const scene::Stroke& stroke = s.meshes.at(0).strokes.at(0);
        EXPECT_EQ(s.materials.at(stroke.geometry.material).unlit, !normals);
        EXPECT_EQ(s.materials.at(stroke.geometry.material).base_color.x, 0.25f);
        EXPECT_EQ(stroke.geometry.normals.empty(), !normals);
        EXPECT_FALSE(s.materials.at(0).unlit) << "triangles may use the material too";
    }
}

TEST(Mesh, LinesOfMaterialsWithoutNamesKeepTheirColours) {
    GltfBuilder b = ribbon(3, {0, 1, 2, 3, 4});
    json& primitives = b.doc["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    for (int i = 0; i < 2; ++i)
        primitives[std::size_t(i)]["material"] = b.push(
            "materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0.25 + 0.5 * i, 0.5, 0.5, 1}}}}});
    const scene::Scene s = load(b);
    ASSERT_EQ(s.meshes.at(0).strokes.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_EQ(s.materials.at(s.meshes[0].strokes[i].geometry.material).base_color.x,
                  0.25f + 0.5f * float(i));
}

TEST(Mesh, WithoutNormalsFacesAreFlat) {
    const scene::Scene s = load(ribbon(4, {0, 1, 2}));
    for (const glm::vec3& n : only_primitive(s).normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
}

TEST(Mesh, GeneratedTangentsFollowUAndKnowMirroredUvs) {
    for (const bool mirrored : {false, true}) {
        GltfBuilder b = triangle();
        json& primitive = b.doc["meshes"][0]["primitives"][0];
        primitive["attributes"]["NORMAL"] = b.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
        // u along +y and v along +x: an upright picture, turned; or v along -x: mirrored.
        const float m = mirrored ? -1.0f : 1.0f;
        primitive["attributes"]["TEXCOORD_0"] = b.accessor<float>({0, 0, 0, m, 1, 0}, "VEC2", 2);
        primitive["material"] = b.push("materials", {{"normalTexture", {{"index", 0}}}});
        b.push("textures", json::object());
        const scene::Scene s = load(b);
        const scene::Primitive& p = only_primitive(s);
        ASSERT_EQ(p.tangents.size(), p.positions.size());
        for (const glm::vec4& t : p.tangents) {
            EXPECT_TRUE(near(glm::vec3(t), {0, 1, 0}));
            // Green of a normal map is up in the picture (glTF 2.0, 3.9.3), where v decreases: the bitangent
            // w * cross(n, t) = w * -x has to be -dp/dv = -x, or +x when mirrored.
            EXPECT_EQ(t.w, mirrored ? -1.0f : 1.0f);
        }
    }
}

TEST(Mesh, TangentsOfTheFileAreKept) {
    GltfBuilder b = triangle();
    json& attributes = b.doc["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] = b.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    attributes["TANGENT"] = b.accessor<float>({0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1}, "VEC4", 4);
    EXPECT_EQ(only_primitive(load(b)).tangents[0], glm::vec4(0, 1, 0, -1));
}

TEST(Mesh, MeshoptCompressionGivesTheSameGeometry) {
    const GltfBuilder plain = ribbon(4, {0, 1, 2, 1, 3, 2, 2, 3, 4});
    GltfBuilder b = plain;
    const auto* positions = reinterpret_cast<const float*>(plain.binary.data());
    std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(5, 12));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), positions, 5, 12));
    const std::vector<unsigned int> order{0, 1, 2, 1, 3, 2, 2, 3, 4};
    std::vector<unsigned char> packed_indices(meshopt_encodeIndexBufferBound(order.size(), 5));
    packed_indices.resize(
        meshopt_encodeIndexBuffer(packed_indices.data(), packed_indices.size(), order.data(), order.size()));
    const auto compress = [&](std::size_t view, const std::vector<unsigned char>& bytes, int stride,
                              std::size_t count, const char* mode) {
        const int holder = b.view(std::as_bytes(std::span(bytes)));
        b.doc["bufferViews"][view]["extensions"]["EXT_meshopt_compression"] = {
            {"buffer", 0},
            {"byteOffset", b.doc["bufferViews"][static_cast<std::size_t>(holder)]["byteOffset"]},
            {"byteLength", bytes.size()},
            {"byteStride", stride},
            {"count", count},
            {"mode", mode}};
        b.doc["bufferViews"][view]["byteLength"] = static_cast<std::size_t>(stride) * count;
    };
    compress(0, packed, 12, 5, "ATTRIBUTES");
    compress(1, packed_indices, 2, order.size(), "TRIANGLES");
    // The uncompressed bytes are gone, so that reading them instead would show.
    std::fill(b.binary.begin(), b.binary.begin() + 60 + 18, std::byte{0xee});
    EXPECT_EQ(triangles(only_primitive(load(b))), triangles(only_primitive(load(plain))));
}

TEST(Mesh, NodesOfTheSameMeshShareItsGeometry) {
    GltfBuilder b = triangle();
    b.push("nodes", {{"mesh", 0}, {"translation", {5, 0, 0}}});
    b.doc["scenes"][0]["nodes"] = {0, 1};
    const scene::Scene s = load(b);
    EXPECT_EQ(s.meshes.size(), 1u);
    EXPECT_EQ(s.instances.size(), 2u);
    EXPECT_EQ(scene::triangle_count(s), 2u);
}
