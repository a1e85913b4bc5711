#include <gtest/gtest.h>

#include "gltf_builder.hpp"

using namespace candela;
using namespace candela::test;

namespace {

scene::Primitive with_positions(GltfBuilder b, int positions) {
    b.show({{"attributes", {{"POSITION", positions}}}});
    return only_primitive(load(b));
}

const std::vector<glm::vec3> kCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

}  // namespace

TEST(Accessor, EveryComponentTypeOfQuantizedPositions) {
    const auto check = [](auto zero, double one, bool normalized) {
        using T = decltype(zero);
        const T o = static_cast<T>(one);
        GltfBuilder b;
        const auto p = with_positions(b, b.accessor<T>({0, 0, 0, o, 0, 0, 0, o, 0}, "VEC3", 3, normalized));
        (void)p;
        GltfBuilder c;
        const int index = c.accessor<T>({0, 0, 0, o, 0, 0, 0, o, 0}, "VEC3", 3, normalized);
        EXPECT_EQ(with_positions(c, index).positions, kCorners) << ComponentType<T>::value;
    };
    check(std::int8_t{}, 127, true);
    check(std::uint8_t{}, 255, true);
    check(std::int16_t{}, 32767, true);
    check(std::uint16_t{}, 65535, true);
    check(std::int8_t{}, 1, false);
    check(std::uint8_t{}, 1, false);
    check(std::int16_t{}, 1, false);
    check(std::uint16_t{}, 1, false);
    check(float{}, 1, false);
}

TEST(Accessor, TheMostNegativeNumberIsMinusOne) {
    GltfBuilder b;
    const int p = b.accessor<std::int8_t>({-128, -127, 0, 0, 0, 0, 0, 1, 0}, "VEC3", 3, true);
    const scene::Primitive primitive = with_positions(b, p);
    EXPECT_EQ(primitive.positions[0], glm::vec3(-1, -1, 0));
}

TEST(Accessor, InterleavedAttributesShareAView) {
    GltfBuilder b;
    std::vector<float> rows;
    for (const glm::vec3& c : kCorners) rows.insert(rows.end(), {c.x, c.y, c.z, 0, 0, 1, c.x, c.y});
    const int view = b.view(std::as_bytes(std::span(rows)), 32);
    const auto attribute = [&](int offset, const char* type) {
        return b.push("accessors", {{"bufferView", view},
                                    {"byteOffset", offset},
                                    {"componentType", 5126},
                                    {"count", 3},
                                    {"type", type}});
    };
    const int position = attribute(0, "VEC3"), normal = attribute(12, "VEC3"), uv = attribute(24, "VEC2");
    b.show({{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}}}});
    const scene::Scene s = load(b);
    const scene::Primitive& p = only_primitive(s);
    EXPECT_EQ(p.positions, kCorners);
    EXPECT_EQ(p.normals, std::vector<glm::vec3>(3, {0, 0, 1}));
    EXPECT_EQ(p.uv[0][2], glm::vec2(0, 1));
}

TEST(Accessor, SparseReplacesSomeOfABaseOrOfZeros) {
    for (const bool has_base : {true, false}) {
        GltfBuilder b;
        const int base = b.accessor<float>({9, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
        const std::vector<std::uint16_t> which{0, 2};
        const std::vector<float> values{5, 6, 7, 0, 2, 0};
        json sparse = {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
        if (has_base) sparse["bufferView"] = b.doc["accessors"][base]["bufferView"];
        const int indices_view = b.view(std::as_bytes(std::span(which)));
        const int values_view = b.view(std::as_bytes(std::span(values)));
        sparse["sparse"] = {{"count", 2},
                            {"indices", {{"bufferView", indices_view}, {"componentType", 5123}}},
                            {"values", {{"bufferView", values_view}}}};
        const int index = b.push("accessors", sparse);
        const scene::Primitive p = with_positions(b, index);
        EXPECT_EQ(p.positions[0], glm::vec3(5, 6, 7));
        EXPECT_EQ(p.positions[1], has_base ? glm::vec3(1, 0, 0) : glm::vec3(0));
        EXPECT_EQ(p.positions[2], glm::vec3(0, 2, 0));
    }
}

TEST(Accessor, IndicesOfEverySize) {
    const auto check = [](auto zero) {
        using T = decltype(zero);
        GltfBuilder b;
        const int positions = b.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3", 3);
        const int indices = b.accessor<T>({0, 1, 2, 2, 1, 3}, "SCALAR", 1);
        b.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
        const scene::Scene s = load(b);
        // Flat normals split the vertices: look through the indices.
        const scene::Primitive& p = only_primitive(s);
        ASSERT_EQ(p.indices.size(), 6u);
        EXPECT_EQ(p.positions[p.indices[5]], glm::vec3(1, 1, 0));
    };
    check(std::uint8_t{});
    check(std::uint16_t{});
    check(std::uint32_t{});
}

TEST(Accessor, ByteColumnsOfMatricesStartOnFourBytes) {
    // A 3 x 3 byte matrix takes 12 bytes, not 9 (glTF 2.0, 3.6.2.4); seen through a skin it would need MAT4,
    // so an error that counts bytes shows it: two of them need 24 bytes.
    GltfBuilder b = triangle();
    const std::vector<std::uint8_t> bytes(23, 0);
    const int view = b.view(std::as_bytes(std::span(bytes)));
    const int index =
        b.push("accessors", {{"bufferView", view}, {"componentType", 5121}, {"count", 2}, {"type", "MAT3"}});
    b.doc["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = index;
    EXPECT_NE(error_of(b).find("needs 24 bytes of 23"), std::string::npos) << error_of(b);
}

TEST(Accessor, ColoursComeAsFloatByteOrShortWithOrWithoutAlpha) {
    GltfBuilder b = triangle();
    json& attributes = b.doc["meshes"][0]["primitives"][0]["attributes"];
    attributes["COLOR_0"] = b.accessor<std::uint8_t>({255, 0, 51, 255, 0, 51, 255, 0, 51}, "VEC3", 3, true);
    // Three byte components lie 4 bytes apart in files that keep to the alignment rules; here tightly packed.
    EXPECT_EQ(only_primitive(load(b)).colors[1], glm::vec4(1, 0, 0.2f, 1));
    attributes["COLOR_0"] = b.accessor<std::uint16_t>(
        {0, 65535, 0, 32768, 0, 65535, 0, 32768, 0, 65535, 0, 32768}, "VEC4", 4, true);
    EXPECT_NEAR(only_primitive(load(b)).colors[2].a, 0.5f, 1e-4f);
}
