#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "candela/io/stage.hpp"
#include "candela/scene/error.hpp"
#include "common/files.hpp"

using namespace candela;
using namespace candela::test;
using scene::LightType;

namespace {

constexpr float kPi = 3.14159265f;

void place(const std::string& lights, scene::Scene& scene) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a.json") << R"({"lights": )" << lights << "}";
    Diagnostics diagnostics;
    io::place_stage_lights(io::load_stage(folder / "a.json").lights, scene, diagnostics);
}

scene::Light placed(const std::string& light) {
    scene::Scene scene;
    place("[" + light + "]", scene);
    return scene.lights.at(0);
}

std::string error_of(const std::string& lights, scene::Scene scene = {}) {
    try {
        place(lights, scene);
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input);
        return error.line();
    }
    return "no error";
}

void expect_near(const glm::vec3& a, const glm::vec3& b) {
    EXPECT_NEAR(glm::length(a - b), 0.0f, 1e-5f) << a.x << ' ' << a.y << ' ' << a.z;
}

scene::Scene with_lamp(LightType type) {
    scene::Scene scene;
    scene::Light lamp;
    lamp.name = "Lamp";
    lamp.type = type;
    lamp.intensity = 100.0f;
    lamp.position = {1, 2, 3};
    scene.lights = {lamp};
    return scene;
}

}  // namespace

// Frostbite listing 9: a disk has the cones of a spot, if it is given one of them or takes over from a spot.
TEST(StageLights, ADiskMayHaveTheConesOfASpot) {
    const scene::Light plain = placed(R"({"type": "disk", "power_lm": 800, "radius_m": 0.5})");
    EXPECT_FALSE(plain.cone);
    const scene::Light cone =
        placed(R"({"type": "disk", "power_lm": 800, "radius_m": 0.5, "outer_cone_deg": 30})");
    EXPECT_TRUE(cone.cone);
    EXPECT_NEAR(cone.outer_cone_rad, 0.5235988f, 1e-6f);
    EXPECT_EQ(cone.inner_cone_rad, 0.0f);
    EXPECT_EQ(cone.intensity, plain.intensity) << "they take light away, as Frostbite's do";
    EXPECT_NE(error_of(R"([{"type": "disk", "power_lm": 1, "radius_m": 1, "inner_cone_deg": 50}])")
                  .find("the inner cone is wider"),
              std::string::npos);

    scene::Scene scene = with_lamp(LightType::spot);
    place(R"([{"override": "Lamp", "radius_m": 0.05}])", scene);
    EXPECT_TRUE(scene.lights[0].cone);
    scene = with_lamp(LightType::spot);
    place(R"([{"override": "Lamp", "type": "disk", "radius_m": 0.05}])", scene);
    EXPECT_FALSE(scene.lights[0].cone) << "a disk was asked for";
}

TEST(StageLights, UnitsOfFrostbiteTables9And12) {
    EXPECT_NEAR(placed(R"({"type": "point", "power_lm": 800})").intensity, 800 / (4 * kPi), 1e-3f);
    EXPECT_NEAR(placed(R"({"type": "spot", "power_lm": 800})").intensity, 800 / kPi, 1e-3f);
    EXPECT_NEAR(
        placed(R"({"type": "spot", "power_lm": 800, "spot_power": "exact", "outer_cone_deg": 30})").intensity,
        800 / (2 * kPi * (1 - std::cos(kPi / 6))), 1e-2f);
    EXPECT_NEAR(
        placed(
            R"({"type": "frustum", "power_lm": 800, "horizontal_angle_deg": 90, "vertical_angle_deg": 90})")
            .intensity,
        800 * 6 / (4 * kPi), 1e-2f);
    EXPECT_NEAR(placed(R"({"type": "line", "power_lm": 800, "length_m": 1})").intensity, 800 / (kPi * kPi),
                1e-3f);
    // The example under Table 12: 15 cm, 1500 lm, 1688 cd/m^2.
    EXPECT_NEAR(placed(R"({"type": "sphere", "power_lm": 1500, "radius_m": 0.15})").intensity, 1688, 1);
    EXPECT_NEAR(placed(R"({"type": "disk", "power_lm": 800, "radius_m": 0.5})").intensity,
                800 / (0.25f * kPi * kPi), 1e-2f);
    EXPECT_NEAR(
        placed(R"({"type": "rectangle", "power_lm": 800, "width_m": 0.5, "height_m": 0.25})").intensity,
        800 / (0.125f * kPi), 1e-1f);
    EXPECT_NEAR(placed(R"({"type": "tube", "power_lm": 800, "radius_m": 0.1, "length_m": 2})").intensity,
                800 / ((2 * kPi * 0.1f * 2 + 4 * kPi * 0.01f) * kPi), 1e-2f);
    EXPECT_NEAR(placed(R"({"type": "sphere", "ev100": 10, "radius_m": 1})").intensity, 128, 1e-3f);
    EXPECT_NEAR(placed(R"({"type": "point", "power_w": 8, "efficacy_lm_per_w": 100})").intensity,
                800 / (4 * kPi), 1e-3f);
    // Footnote 29: 1.6e9 cd/m^2 over 0.533 degrees is 105,000 to 114,000 lx.
    const float sun_lx = placed(R"({"type": "sun", "luminance_nit": 1.6e9})").intensity;
    EXPECT_GT(sun_lx, 105e3f);
    EXPECT_LT(sun_lx, 114e3f);
}

TEST(StageLights, TwoSidesNeedHalfTheLuminanceForTheSamePower) {
    const std::string shape = R"("type": "rectangle", "power_lm": 800, "width_m": 0.5, "height_m": 0.25)";
    EXPECT_FLOAT_EQ(placed("{" + shape + R"(, "two_sided": true})").intensity,
                    0.5f * placed("{" + shape + "}").intensity);
}

TEST(StageLights, StandAndShineAsTheySay) {
    const scene::Light down = placed(
        R"({"type": "rectangle", "power_lm": 1, "width_m": 0.6, "height_m": 0.3, "position": [1, 2, 3], "look_at": [1, 0, 3]})");
    expect_near(down.position, {1, 2, 3});
    expect_near(down.direction, {0, -1, 0});
    expect_near(down.right, {1, 0, 0});
    EXPECT_FLOAT_EQ(down.half_width_m, 0.3f);
    EXPECT_FLOAT_EQ(down.half_height_m, 0.15f);

    const scene::Light plain = placed(R"({"type": "spot", "power_lm": 1})");
    expect_near(plain.direction, {0, 0, -1});
    expect_near(plain.right, {1, 0, 0});
    expect_near(plain.up(), {0, 1, 0});

    // As a rotation of a glTF node about its +Z by 90 degrees: +X goes to +Y.
    expect_near(placed(R"({"type": "spot", "power_lm": 1, "roll_deg": 90})").right, {0, 1, 0});

    const scene::Light tube =
        placed(R"({"type": "tube", "power_lm": 1, "radius_m": 0.1, "length_m": 2, "right": [0, 0, 5]})");
    expect_near(tube.right, {0, 0, 1});
    EXPECT_NEAR(glm::dot(tube.right, tube.direction), 0.0f, 1e-6f);
    EXPECT_FLOAT_EQ(tube.half_width_m, 1.0f);

    const scene::Light turned = placed(
        R"({"type": "rectangle", "power_lm": 1, "width_m": 1, "height_m": 1, "direction": [0, -1, 0], "right": [0, -1, 1]})");
    expect_near(turned.right, {0, 0, 1});
    EXPECT_NE(
        error_of(
            R"([{"type": "disk", "radius_m": 1, "power_lm": 1, "direction": [0, 1, 0], "right": [0, 2, 0]}])")
            .find("/lights/0/right: is parallel"),
        std::string::npos);
}

TEST(StageLights, StandInTheFrameOfANode) {
    scene::Scene scene;
    // A quarter turn about +Y (X to -Z), twice as large, at x = 10.
    scene.nodes.push_back({"Table", glm::translate(glm::mat4(1.0f), {10, 0, 0}) *
                                        glm::rotate(glm::mat4(1.0f), 0.5f * kPi, {0, 1, 0}) *
                                        glm::scale(glm::mat4(1.0f), glm::vec3(2.0f))});
    place(R"([{"type": "sphere", "radius_m": 0.1, "power_lm": 1, "node": "Table", "position": [1, 1, 0]}])",
          scene);
    expect_near(scene.lights[0].position, {10, 2, -2});
    expect_near(scene.lights[0].direction, {-1, 0, 0});
    expect_near(scene.lights[0].right, {0, 0, -1});
    EXPECT_FLOAT_EQ(scene.lights[0].radius_m, 0.1f);
    EXPECT_NE(error_of(R"([{"type": "point", "power_lm": 1, "node": "Chair"}])", scene)
                  .find("/lights/0/node: the scene has no node of this name: Chair"),
              std::string::npos);
}

TEST(StageLights, ARadiusMakesAShapeOfTheSamePower) {
    scene::Scene scene = with_lamp(LightType::point);
    place(R"([{"override": "Lamp", "radius_m": 0.05, "casts_shadow": false}])", scene);
    ASSERT_EQ(scene.lights.size(), 1u);
    const scene::Light& sphere = scene.lights[0];
    EXPECT_EQ(sphere.type, LightType::sphere);
    EXPECT_FALSE(sphere.casts_shadow);
    expect_near(sphere.position, {1, 2, 3});
    // From afar it is as bright as the point was.
    EXPECT_NEAR(sphere.intensity * kPi * 0.05f * 0.05f, 100.0f, 1e-3f);

    scene = with_lamp(LightType::spot);
    place(R"([{"override": "Lamp", "radius_m": 0.05}])", scene);
    EXPECT_EQ(scene.lights[0].type, LightType::disk);
    EXPECT_NEAR(scene.lights[0].intensity * kPi * 0.05f * 0.05f, 100.0f, 1e-3f);

    scene = with_lamp(LightType::directional);
    place(R"([{"override": "Lamp", "angular_diameter_deg": 0.5}])", scene);
    EXPECT_EQ(scene.lights[0].type, LightType::sun);
    EXPECT_FLOAT_EQ(scene.lights[0].intensity, 100.0f);
}

TEST(StageLights, OverridesChangeWhatTheySayAndNothingElse) {
    scene::Scene scene = with_lamp(LightType::spot);
    scene.lights.push_back(scene.lights[0]);
    scene.lights[1].name = "Other";
    place(R"([{"override": "Lamp", "intensity_cd": 7}])", scene);
    EXPECT_FLOAT_EQ(scene.lights[0].intensity, 7.0f);
    expect_near(scene.lights[0].position, {1, 2, 3});
    EXPECT_FLOAT_EQ(scene.lights[1].intensity, 100.0f);
    place(R"([{"override": "Lamp", "off": true}])", scene);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].name, "Other");
}

TEST(StageLights, WhatDoesNotFitTheSceneIsOneClearLine) {
    const scene::Scene scene = with_lamp(LightType::point);
    EXPECT_NE(error_of(R"([{"override": "Lump", "radius_m": 1}])", scene).find("it has Lamp"),
              std::string::npos);
    EXPECT_NE(error_of(R"([{"override": "Lamp", "outer_cone_deg": 20}])", scene)
                  .find("/lights/0/outer_cone_deg: a point light has no outer_cone_deg"),
              std::string::npos);
    EXPECT_NE(error_of(R"([{"override": "Lamp", "type": "rectangle", "width_m": 1}])", scene)
                  .find("/lights/0: a rectangle light needs its size"),
              std::string::npos);
    EXPECT_NE(error_of(R"([{"override": "Lamp", "type": "sun"}])", scene).find("needs a new strength"),
              std::string::npos);
    EXPECT_NE(error_of(R"([{"type": "spot", "power_lm": 1, "inner_cone_deg": 50}])")
                  .find("/lights/0: the inner cone is wider"),
              std::string::npos);
    EXPECT_NE(error_of(R"([{"type": "point", "luminance_nit": 1000}])").find("a sphere with"),
              std::string::npos);
}

TEST(StageLights, TemperaturesGiveAColourOfLuminanceOne) {
    const glm::vec3 c = placed(R"({"type": "point", "power_lm": 1, "temperature_k": 2700})").color;
    EXPECT_NEAR(glm::dot(c, glm::vec3(0.2126f, 0.7152f, 0.0722f)), 1.0f, 1e-4f);
    EXPECT_GT(c.x, c.z);
}
