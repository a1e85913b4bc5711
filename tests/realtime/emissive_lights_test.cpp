// What real time makes of emissive surfaces: which of them are lights at all, and how many are put together.
#include "candela/realtime/emissive_lights.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "candela/realtime/emissive_cut.hpp"
#include "candela/realtime/light_list.hpp"
#include "common/contact_scenes.hpp"
#include "common/scenes.hpp"

using namespace candela;
using namespace candela::test;

namespace {

constexpr float kPi = 3.14159265f;
constexpr float kSky_nit = 1000.0f;
constexpr float kSky_lx = kPi * kSky_nit;

scene::Material emissive(float nit) {
    scene::Material m = grey(0.0f);
    m.emissive_nit = glm::vec3(nit);
    return m;
}

void add(scene::Scene& s, scene::Primitive primitive, const glm::mat4& world) {
    s.meshes.push_back({"mesh", {std::move(primitive)}});
    s.instances.push_back({"instance", static_cast<std::uint32_t>(s.meshes.size() - 1), world});
}

/// A sphere whose equator is emissive: a convex body cannot light itself.
scene::Scene body_with_emissive_belt(float nit) {
    scene::Scene s;
    s.materials = {grey(0.5f), emissive(nit)};
    scene::Primitive body = sphere(1.0f, 0);
    scene::Primitive belt = body;
    belt.material = 1;
    belt.indices.clear();
    std::vector<std::uint32_t> rest;
    for (std::size_t i = 0; i + 2 < body.indices.size(); i += 3) {
        const bool near_equator = std::abs(body.positions[body.indices[i]].y) < 0.3f;
        auto& into = near_equator ? belt.indices : rest;
        into.insert(into.end(), body.indices.begin() + static_cast<std::ptrdiff_t>(i),
                    body.indices.begin() + static_cast<std::ptrdiff_t>(i) + 3);
    }
    body.indices = rest;
    add(s, body, glm::mat4(1.0f));
    add(s, belt, glm::mat4(1.0f));
    return s;
}

/// A ball of radius r over a large floor of two triangles, which its nearest point is not a corner of.
scene::Scene ball_over_floor(float radius_m, float height_m, float nit) {
    scene::Scene s;
    s.materials = {grey(0.5f), emissive(nit)};
    add(s, square(10.0f, 0), glm::mat4(1.0f));
    add(s, sphere(radius_m, 1), glm::translate(glm::mat4(1.0f), {3.0f, -2.0f, height_m}));
    return s;
}

/// Two facades that face one another across 12 m with windows of 1 m x 1.5 m in each, an instance a window.
scene::Scene street(int windows_a_side) {
    scene::Scene s;
    s.materials = {grey(0.5f), emissive(100.0f)};
    s.meshes.push_back({"window", {square(0.5f, 1)}});
    for (const float side : {-1.0f, 1.0f}) {
        for (int i = 0; i < windows_a_side; ++i) {
            glm::mat4 world = glm::translate(glm::mat4(1.0f),
                                             {6.0f * side, 2.0f + 3.0f * float(i % 3), -3.0f * float(i / 3)});
            world = glm::rotate(world, -0.5f * kPi * side, {0, 1, 0});
            s.instances.push_back({"window", 0, glm::scale(world, {1.0f, 1.5f, 1.0f})});
        }
    }
    return s;
}

float power_lm(const realtime::EmissiveLight& light) {
    const auto type = static_cast<scene::LightType>(light.block.color_type.w);
    const float nit = light.block.color_type.x;
    const float r = light.block.right_b.w;
    if (type == scene::LightType::sphere) return nit * 4.0f * kPi * kPi * r * r;
    if (type == scene::LightType::disk) return nit * kPi * kPi * r * r;
    return nit * kPi * 4.0f * light.block.direction_a.w * r;
}

}  // namespace

TEST(EmissiveCut, AConvexBodyIsNotLitByItsOwnEmission) {
    scene::Scene s = body_with_emissive_belt(10.0f * kSky_nit);
    EXPECT_FALSE(realtime::emissive_lights(s).empty()) << "without an environment nothing is negligible";
    s.environment = constant(kSky_nit);
    EXPECT_TRUE(realtime::emissive_lights(s).empty()) << "however bright it is";
    // Irradiance volumes keep the sky out of rooms, where little light is all there is.
    s.irradiance_volumes.emplace_back();
    EXPECT_FALSE(realtime::emissive_lights(s).empty());
}

TEST(EmissiveCut, AFloorNearbyMakesTheSameBodyALight) {
    scene::Scene s = body_with_emissive_belt(10.0f * kSky_nit);
    scene::Primitive floor = square(3.0f, 0);
    add(s, floor, glm::rotate(glm::translate(glm::mat4(1.0f), {0, -1, 0}), -0.5f * kPi, {1, 0, 0}));
    s.environment = constant(kSky_nit);
    EXPECT_FALSE(realtime::emissive_lights(s).empty());
}

// The largest illuminance of a ball on the floor below it is pi L (r/h)^2; the bound lies at 1/128 of the
// sky's.
TEST(EmissiveCut, TheBoundIsAFractionOfTheSkysIlluminance) {
    const float radius_m = 0.1f;
    const float height_m = 1.0f;
    const float at_bound_nit = realtime::kCutFraction * kSky_lx / (kPi * 0.01f);
    for (const float factor : {0.1f, 0.7f}) {
        scene::Scene s = ball_over_floor(radius_m, height_m, factor * at_bound_nit);
        s.environment = constant(kSky_nit);
        EXPECT_TRUE(realtime::emissive_lights(s).empty()) << factor;
    }
    for (const float factor : {1.4f, 20.0f}) {
        scene::Scene s = ball_over_floor(radius_m, height_m, factor * at_bound_nit);
        s.environment = constant(kSky_nit);
        EXPECT_FALSE(realtime::emissive_lights(s).empty()) << factor;
    }
}

TEST(EmissiveCut, ManyNegligibleEmittersTogetherAreNot) {
    const float at_bound_nit = realtime::kCutFraction * kSky_lx / (kPi * 0.01f);
    scene::Scene s;
    s.materials = {grey(0.5f), emissive(0.3f * at_bound_nit)};
    add(s, square(10.0f, 0), glm::mat4(1.0f));
    for (int i = 0; i < 12; ++i)
        add(s, sphere(0.1f, 1), glm::translate(glm::mat4(1.0f), {1.6f * float(i) - 8.8f, 0.0f, 1.0f}));
    s.environment = constant(kSky_nit);
    const std::size_t lights = realtime::emissive_lights(s).size();
    EXPECT_GE(lights, 8u) << "at most three of 0.3 of the bound fit below it";
    EXPECT_LE(lights, 11u);
}

TEST(EmissiveGroups, WindowsOfAStreetShineFromTheirFacades) {
    const int a_side = 60;
    const std::vector<realtime::EmissiveLight> lights = realtime::emissive_lights(street(a_side));
    ASSERT_FALSE(lights.empty());
    EXPECT_LE(lights.size(), realtime::kMaxEmissiveGroups);
    float left_lm = 0.0f;
    float right_lm = 0.0f;
    for (const realtime::EmissiveLight& light : lights) {
        EXPECT_EQ(light.block.color_type.w, float(scene::LightType::rectangle)) << "a spot in the street";
        const float x = light.block.position_range.x;
        EXPECT_NEAR(std::abs(x), 6.0f, 1e-3f);
        EXPECT_NEAR(light.block.direction_a.x, x < 0.0f ? 1.0f : -1.0f, 1e-3f);
        EXPECT_TRUE(light.shape.has_value()) << "it casts shadows";
        (x < 0.0f ? left_lm : right_lm) += power_lm(light);
    }
    const float expected_lm = 100.0f * kPi * 1.5f * float(a_side);
    EXPECT_NEAR(left_lm, expected_lm, 1e-3f * expected_lm);
    EXPECT_NEAR(right_lm, expected_lm, 1e-3f * expected_lm);
}

// Closed boxes, 6 cm deep: no sphere stands before the wall, which would show as a spot.
TEST(EmissiveGroups, WindowsThatAreBoxesDoToo) {
    for (const int a_side : {8, 60}) {
        scene::Scene s = street(a_side);
        s.meshes[0].primitives[0] = box(glm::vec3(0.5f, 0.5f, 0.03f), 1);
        float lm = 0.0f;
        for (const realtime::EmissiveLight& light : realtime::emissive_lights(s)) {
            EXPECT_EQ(light.block.color_type.w, float(scene::LightType::rectangle)) << a_side;
            EXPECT_NEAR(std::abs(light.block.direction_a.x), 1.0f, 1e-3f) << "along the street";
            lm += power_lm(light);
        }
        const float side_m2 = 1.5f + 0.06f * 2.5f;
        EXPECT_NEAR(lm, 100.0f * kPi * 2.0f * side_m2 * 2.0f * float(a_side), 1e-3f * lm);
    }
}

TEST(EmissiveGroups, ATessellatedPanelIsItsRectangleAndATessellatedDiskADisk) {
    scene::Primitive panel;
    panel.material = 0;
    const int n = 12;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x)
            panel.positions.emplace_back(0.2f * float(x) / n - 0.1f, 0.6f * float(y) / n - 0.3f, 0.0f);
    for (std::uint32_t y = 0; y < n; ++y) {
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x;
            for (const std::uint32_t i : {a, a + 1, a + n + 2, a, a + n + 2, a + n + 1})
                panel.indices.push_back(i);
        }
    }
    const glm::mat4 tilted = glm::rotate(glm::mat4(1.0f), 0.7f, glm::normalize(glm::vec3(1, 2, 3)));
    scene::Scene s = scene_of(panel, emissive(50.0f));
    s.instances[0].world = tilted;
    std::vector<realtime::EmissiveLight> lights = realtime::emissive_lights(s);
    float lm = 0.0f;
    for (const realtime::EmissiveLight& light : lights) {
        EXPECT_EQ(light.block.color_type.w, float(scene::LightType::rectangle));
        EXPECT_NEAR(light.block.color_type.x, 50.0f, 0.1f);
        EXPECT_NEAR(glm::dot(glm::vec3(light.block.direction_a), glm::vec3(tilted[2])), 1.0f, 1e-4f);
        lm += power_lm(light);
    }
    EXPECT_NEAR(lm, 50.0f * kPi * 0.12f, 0.01f);

    scene::Primitive disk;
    disk.material = 0;
    disk.positions.emplace_back(0.0f);
    for (int i = 0; i < 96; ++i) {
        const float angle = 2.0f * kPi * float(i) / 96.0f;
        disk.positions.emplace_back(0.3f * std::cos(angle), 0.3f * std::sin(angle), 0.0f);
        for (const int corner : {0, i + 1, (i + 1) % 96 + 1}) disk.indices.push_back(std::uint32_t(corner));
    }
    lights = realtime::emissive_lights(scene_of(disk, emissive(50.0f)));
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_EQ(lights[0].block.color_type.w, float(scene::LightType::disk));
    EXPECT_NEAR(lights[0].block.right_b.w, 0.3f, 1e-3f);
}
