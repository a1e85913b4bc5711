#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "gltf_samples.hpp"

using namespace candela;
using namespace candela::test;

namespace {

const float kHalf = std::sqrt(0.5f);

glm::vec3 moved(const scene::Scene& s, const glm::vec3& p) {
    return glm::vec3(s.instances.at(0).world * glm::vec4(p, 1.0f));
}

io::GltfOptions at(float time_s) {
    return {time_s, 1.0f};
}

}  // namespace

TEST(Nodes, TranslationAfterRotationAfterScaleAndParentsLast) {
    GltfBuilder b = triangle();
    b.doc["nodes"][0].update(
        {{"translation", {1, 2, 3}}, {"rotation", {0, 0, kHalf, kHalf}}, {"scale", {2, 3, 4}}});
    b.push("nodes", {{"children", {0}}, {"translation", {10, 0, 0}}, {"scale", {2, 2, 2}}});
    b.doc["scenes"][0]["nodes"] = {1};
    // (1, 1, 1) scaled is (2, 3, 4), turned a quarter about z (-3, 2, 4), moved (-2, 4, 7); then the parent.
    EXPECT_TRUE(near(moved(load(b), {1, 1, 1}), {6, 8, 14}));
}

TEST(Nodes, MatricesAreColumnMajorAndMayMirror) {
    GltfBuilder b = triangle();
    b.doc["nodes"][0]["matrix"] = {-1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 5, 6, 7, 1};
    EXPECT_TRUE(near(moved(load(b), {1, 2, 3}), {4, 9, 9}));
    b.doc["nodes"][0].erase("matrix");
    b.doc["nodes"][0]["scale"] = {-1, 1, 1};
    EXPECT_LT(glm::determinant(glm::mat3(load(b).instances[0].world)), 0.0f);
}

TEST(Nodes, OnlyTheChosenSceneIsShown) {
    GltfBuilder b = triangle();
    b.push("nodes", {{"mesh", 0}, {"name", "other"}});
    b.doc["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    b.doc["scene"] = 1;
    const scene::Scene s = load(b);
    ASSERT_EQ(s.instances.size(), 1u);
    EXPECT_EQ(s.instances[0].name, "other");
}

TEST(Nodes, CamerasLookAlongMinusZOfTheirNodes) {
    GltfBuilder b = triangle();
    b.push("cameras", {{"type", "perspective"},
                       {"perspective", {{"yfov", 0.9}, {"aspectRatio", 2}, {"znear", 0.1}, {"zfar", 50}}}});
    b.push("cameras", {{"type", "orthographic"},
                       {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 9}}}});
    b.doc["nodes"][0]["camera"] = 1;
    b.push("nodes", {{"camera", 0},
                     {"translation", {0, 0, 5}},
                     {"rotation", {0, kHalf, 0, kHalf}},
                     {"scale", {3, 3, 3}}});
    b.doc["scenes"][0]["nodes"] = {0, 1};
    const scene::Scene s = load(b);
    ASSERT_EQ(s.cameras.size(), 2u);
    EXPECT_EQ(s.cameras[0].projection, scene::Projection::orthographic);
    EXPECT_FLOAT_EQ(s.cameras[0].xmag_m, 3.0f);
    const scene::Camera& c = s.cameras[1];
    EXPECT_FLOAT_EQ(c.yfov_rad, 0.9f);
    EXPECT_FLOAT_EQ(c.zfar_m, 50.0f);
    EXPECT_TRUE(near(glm::vec3(c.world * glm::vec4(0, 0, -1, 0)), {-1, 0, 0}));
    EXPECT_TRUE(near(glm::vec3(c.world[3]), {0, 0, 5}));
}

TEST(Nodes, LightsShineAlongMinusZInCandelaAndLux) {
    GltfBuilder b = triangle();
    b.doc["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 1000}},
        {{"type", "spot"},
         {"intensity", 50},
         {"color", {1, 0.5, 0}},
         {"range", 7},
         {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}},
        {{"type", "point"}}};
    for (int i = 0; i < 3; ++i) {
        b.push("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}},
                         {"rotation", {-kHalf, 0, 0, kHalf}},
                         {"translation", {i, 0, 0}}});
        b.doc["scenes"][0]["nodes"].push_back(i + 1);
    }
    const scene::Scene s = load(b, {0.0f, 2.0f});
    ASSERT_EQ(s.lights.size(), 3u);
    EXPECT_FLOAT_EQ(s.lights[0].intensity, 2000.0f);
    EXPECT_TRUE(near(s.lights[0].direction, {0, -1, 0}));
    EXPECT_EQ(s.lights[1].type, scene::LightType::spot);
    EXPECT_FLOAT_EQ(s.lights[1].intensity, 100.0f);
    EXPECT_FLOAT_EQ(s.lights[1].range_m, 7.0f);
    EXPECT_FLOAT_EQ(s.lights[1].outer_cone_rad, 0.5f);
    EXPECT_FLOAT_EQ(s.lights[1].color.y, 0.5f);
    EXPECT_FLOAT_EQ(s.lights[2].intensity, 2.0f);
    EXPECT_TRUE(std::isinf(s.lights[2].range_m));
}

TEST(Animation, LinearStepAndBeyondTheEnds) {
    for (const bool step : {false, true}) {
        GltfBuilder b = triangle();
        animate(b, "translation", step ? "STEP" : "LINEAR", {1, 3}, {0, 0, 0, 4, 8, 0}, "VEC3", 3);
        const auto x_at = [&](float t) { return moved(load(b, at(t)), {0, 0, 0}).x; };
        EXPECT_FLOAT_EQ(x_at(0.0f), 0.0f);
        EXPECT_FLOAT_EQ(x_at(1.5f), step ? 0.0f : 1.0f);
        EXPECT_FLOAT_EQ(x_at(3.0f), 4.0f);
        EXPECT_FLOAT_EQ(x_at(9.0f), 4.0f);
    }
}

TEST(Animation, RotationsTurnAtConstantSpeedTheShortWay) {
    GltfBuilder b = triangle();
    // A quarter turn about z, the second key as -q: the same rotation.
    animate(b, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0, -kHalf, -kHalf}, "VEC4", 4);
    const glm::vec3 x = moved(load(b, at(1.0f / 3.0f)), {1, 0, 0});
    EXPECT_TRUE(near(x, {std::cos(0.5235988f), std::sin(0.5235988f), 0.0f}));
}

TEST(Animation, CubicSplinesUseTangentsPerSecond) {
    GltfBuilder b = triangle();
    // Keys 2 s apart; leaving at 3 m/s, arriving at -1 m/s. At the middle: (0 + 8) / 2 + 2 (3 - (-1)) / 8
    // = 5.
    animate(b, "translation", "CUBICSPLINE", {0, 2}, {9, 9, 9, 0, 0, 0, 3, 0, 0, -1, 0, 0, 8, 0, 0, 9, 9, 9},
            "VEC3", 3);
    EXPECT_TRUE(near(moved(load(b, at(1.0f)), {0, 0, 0}), {5, 0, 0}));
    EXPECT_TRUE(near(moved(load(b, at(2.0f)), {0, 0, 0}), {8, 0, 0}));
}

TEST(Morph, WeightsOfMeshNodeAndAnimation) {
    GltfBuilder b = morphed();
    EXPECT_TRUE(near(only_primitive(load(b)).positions[0], {0, 0, 0.5}));
    b.doc["nodes"][0]["weights"] = {0, 0.25};
    EXPECT_TRUE(near(only_primitive(load(b)).positions[0], {1, 0, 0}));
    animate(b, "weights", "LINEAR", {0, 1}, {0, 0, 2, 1}, "SCALAR", 1);
    EXPECT_TRUE(near(only_primitive(load(b, at(0.5f))).positions[0], {2, 0, 1}));
}

TEST(Skin, VerticesFollowTheirJointsAndIgnoreTheMeshNode) {
    const scene::Scene s = load(skinned());
    const scene::Primitive& p = only_primitive(s);
    EXPECT_EQ(s.instances[0].world, glm::mat4(1.0f));
    std::vector<glm::vec3> corners;
    for (std::size_t c = 0; c < 3; ++c) corners.push_back(p.positions[p.indices[c]]);
    // Joint 0's node is at x = 1 with the identity as inverse bind matrix; joint 1 is at (2, 2, 0), bound at
    // x = 1.
    EXPECT_TRUE(near(corners[0], {1, 0, 0}));
    EXPECT_TRUE(near(corners[1], {2, 2, 0}));
    EXPECT_TRUE(near(corners[2], {1, 2, 0}));
}
