#include <gtest/gtest.h>

#include "gltf_samples.hpp"

using namespace candela;
using namespace candela::test;

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
