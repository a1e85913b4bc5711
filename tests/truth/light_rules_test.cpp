#include <gtest/gtest.h>

#include <cmath>

#include "lights.hpp"
#include "shading/lights/punctual.glsl"

using namespace candela;
using namespace candela::test;
using scene::LightType;
using truth::Draws;

namespace {

constexpr double kPi = 3.14159265358979;
constexpr std::array kShapes{LightType::sphere, LightType::disk, LightType::rectangle, LightType::tube};

/// What a narrow camera sees of one light in an empty scene.
double seen_nit(const scene::Scene& s, const glm::vec3& from, const glm::vec3& at) {
    return mean_luminance(s, spot_meter(from, at), path_options(), 4).y;
}
double seen_nit(const scene::Light& light, const glm::vec3& from) {
    scene::Scene s;
    s.lights = {light};
    return seen_nit(s, from, light.position);
}

scene::Material metal(float perceptual_roughness) {
    scene::Material m;
    m.base_color = glm::vec4(0.5f, 0.7f, 0.9f, 1.0f);
    m.metallic = 1.0f;
    m.perceptual_roughness = perceptual_roughness;
    return m;
}

}  // namespace

TEST(LightRules, BothWaysOfDrawingAreRightAlone) {
    for (const LightType type : kShapes) {
        scene::Light l = light_of(type, {-1.0f, 1.0f, 0.2f}, {0.7f, -1.0f, 0.0f});
        scene::Material glossy = metal(0.4f);
        glossy.metallic = 0.5f;
        const scene::Scene s = floor_under({l}, glossy);
        const auto nit = [&](Draws draws) {
            truth::PathOptions o = path_options(true);
            o.draws = draws;
            return mean_luminance(s, spot_meter({1.5f, 1.4f, 0.0f}), o, 2048).y;
        };
        const double both = nit(Draws::all);
        EXPECT_GT(both, 1.0);
        EXPECT_NEAR(nit(Draws::lights) / both, 1.0, 0.01) << scene::name_of(type);
        EXPECT_NEAR(nit(Draws::material) / both, 1.0, 0.01) << scene::name_of(type);
    }
}

TEST(LightRules, BothWaysOfDrawingASunAreRightAloneBesideAnEnvironment) {
    scene::Light l = light_of(LightType::sun, {}, {0.3f, -1.0f, 0.1f});
    l.angular_diameter_rad = 0.3f;
    l.limb_darkening = true;
    scene::Scene s = floor_under({l});
    s.environment = constant(100.0f);
    const double expected = 1000.0 / std::sqrt(1.1) + kPi * 100.0;
    for (const Draws draws : {Draws::all, Draws::lights, Draws::material})
        EXPECT_NEAR(floor_lx(s, draws, 4096) / expected, 1.0, 0.01);
}

TEST(LightRules, AMirrorShowsAShapeWithItsLuminanceWhetherTheCameraSeesItOrNot) {
    for (const LightType type : kShapes) {
        // The spot of the mirror at the origin reflects (-0.5, 1, 0).
        scene::Light l = light_of(type, {-1.0f, 2.0f, 0.0f}, {0.5f, -1.0f, 0.0f});
        const scene::Scene s = floor_under({l}, metal(0.0f));
        const glm::dvec3 seen = mean_luminance(s, spot_meter({0.5f, 1.0f, 0}), path_options(true), 256);
        const double rise = std::pow(1.0 - 1.0 / std::sqrt(1.25), 5.0);
        const glm::dvec3 f0(0.5, 0.7, 0.9);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(seen[c] / (1000.0 * (f0[c] + (1.0 - f0[c]) * rise)), 1.0, 0.003)
                << scene::name_of(type);
        }
    }
}

TEST(LightRules, TheCameraSeesVisibleShapesWithTheirLuminance) {
    for (const LightType type : kShapes) {
        scene::Light l = light_of(type, {0, 2, 0});
        l.range_m = 0.5f;  // of what it lights, not of what is seen
        EXPECT_EQ(seen_nit(l, {0.1f, 0, 0}), 0.0) << "invisible";
        l.visible = true;
        EXPECT_NEAR(seen_nit(l, {0.1f, 0, 0}), 1000.0, 0.1) << scene::name_of(type);
        const bool flat = type == LightType::disk || type == LightType::rectangle;
        EXPECT_NEAR(seen_nit(l, {0.1f, 4, 0}), flat ? 0.0 : 1000.0, 0.1) << "from behind";
        l.two_sided = true;
        EXPECT_NEAR(seen_nit(l, {0.1f, 4, 0}), 1000.0, 0.1);
        // Nearer than a surface it hides it, farther it is hidden.
        scene::Scene s = floor_under({l});
        EXPECT_NEAR(seen_nit(s, {0, 4, 0}, {0, 0, 0}), 1000.0, 0.1);
        s.lights[0].position.y = -2.0f;
        EXPECT_NEAR(seen_nit(s, {0, 4, 0}, {0, 0, 0}), 0.0, 0.1);
    }
}

TEST(LightRules, TheCameraSeesTheSunBeforeTheEnvironment) {
    scene::Light l = light_of(LightType::sun, {}, {0, -1, 0});
    scene::Scene s;
    s.lights = {l};
    s.environment = constant(50.0f);
    const double radius = 0.5 * 0.0093;
    const double nit = 1000.0 / (kPi * std::sin(radius) * std::sin(radius));
    EXPECT_NEAR(seen_nit(s, {0, 0, 0}, {0.0f, 1, 0}), 50.0, 0.1) << "invisible";
    s.lights[0].visible = true;
    EXPECT_NEAR(seen_nit(s, {0, 0, 0}, {0.0f, 1, 0}) / (nit + 50.0), 1.0, 1e-3);
    EXPECT_NEAR(seen_nit(s, {0, 0, 0}, {0.01f, 1, 0}), 50.0, 0.1) << "beside it";
    s.lights[0].limb_darkening = true;
    EXPECT_NEAR(seen_nit(s, {0, 0, 0}, {0.0f, 1, 0}) / (nit / 0.805 + 50.0), 1.0, 0.01);
}

TEST(LightRules, FlatLightsShineOneWayOrBoth) {
    for (const LightType type : {LightType::disk, LightType::rectangle}) {
        scene::Light l = light_of(type, {0.2f, 1.2f, 0});
        const double front = floor_lx(l);
        l.direction = -l.direction;
        EXPECT_EQ(floor_lx(l), 0.0) << "from behind";
        EXPECT_EQ(floor_lx(floor_under({l}), Draws::material), 0.0) << "from behind";
        l.two_sided = true;
        EXPECT_NEAR(floor_lx(l) / front, 1.0, 0.003);
        EXPECT_NEAR(floor_lx(floor_under({l}), Draws::material, 4096) / front, 1.0, 0.01);
    }
}

TEST(LightRules, TheRangeIsThatOfTheCentre) {
    for (const LightType type : kShapes) {
        scene::Light l = light_of(type, {0, 1.2f, 0});
        const double endless = floor_lx(l);
        l.range_m = 2.0f;
        const double window = static_cast<double>(shading::window_attenuation(1.2f, 2.0f));
        EXPECT_NEAR(floor_lx(l) / (endless * window), 1.0, 0.003);
        EXPECT_NEAR(floor_lx(floor_under({l}), Draws::material, 4096) / (endless * window), 1.0, 0.01);
        l.range_m = 1.1f;
        EXPECT_EQ(floor_lx(l), 0.0);
    }
}

TEST(LightRules, ShapesBlockNothing) {
    for (const LightType type : kShapes) {
        const scene::Light near = light_of(type, {0, 1, 0});
        const scene::Light far = light_of(LightType::sphere, {0, 2, 0});
        const double sum = floor_lx(near) + floor_lx(far);
        EXPECT_NEAR(floor_lx(floor_under({near, far}), Draws::lights) / sum, 1.0, 0.01);
        EXPECT_NEAR(floor_lx(floor_under({near, far}), Draws::material, 2048) / sum, 1.0, 0.015);
    }
}

TEST(LightRules, OnlyLightsThatCastShadowsAreHiddenBySurfaces) {
    constexpr std::array all{LightType::point, LightType::line,      LightType::sun, LightType::sphere,
                             LightType::disk,  LightType::rectangle, LightType::tube};
    for (const LightType type : all) {
        scene::Light l = light_of(type, {0, 1.5f, 0});
        const double open = floor_lx(l);
        scene::Scene s = floor_under({l});
        scene::Material black = grey(0.0f);
        black.double_sided = true;
        place(s, flat_square(1.2f, {0, 0.8f, 0}, true), black);
        EXPECT_EQ(floor_lx(s), 0.0) << scene::name_of(type);
        s.lights[0].casts_shadow = false;
        EXPECT_NEAR(floor_lx(s) / open, 1.0, 0.003) << scene::name_of(type);
        if (scene::is_shape(type)) {
            EXPECT_NEAR(floor_lx(s, Draws::lights) / open, 1.0, 0.003) << scene::name_of(type);
            EXPECT_NEAR(floor_lx(s, Draws::material, 2048) / open, 1.0, 0.015) << scene::name_of(type);
        }
        // Without shadows at all no light asks.
        s.lights[0].casts_shadow = true;
        truth::PathOptions o = path_options();
        o.shadows = false;
        const double lx = mean_luminance(s, spot_meter({2.5f, 0.4f, 0.0f}), o, 512).y * kPi / 0.5;
        EXPECT_NEAR(lx / open, 1.0, 0.003) << scene::name_of(type);
    }
}

TEST(LightRules, ALightOnASurfaceIsNotHiddenByIt) {
    scene::Light l = light_of(LightType::rectangle, {0, 2, 0});
    const double open = floor_lx(l);
    scene::Scene s = floor_under({l});
    place(s, flat_square(5.0f, {0, 2, 0}, false), grey(0.0f));
    EXPECT_NEAR(floor_lx(s) / open, 1.0, 0.003);
    EXPECT_NEAR(floor_lx(s, Draws::material, 4096) / open, 1.0, 0.01);
}

TEST(LightRules, AnImageIsUprightForWhoStandsInItsLight) {
    scene::Light l = light_of(LightType::rectangle, {0, 1, 0}, {0, 0, 1});  // shines towards +Z
    l.right = {-1, 0, 0};  // of the light's own frame: the viewer's left
    ASSERT_NEAR(l.up().y, 1.0f, 1e-6f);
    l.visible = true;
    l.image = 0;
    scene::Scene s;
    scene::Image image;
    image.width = image.height = 2;
    for (const int level : {255, 188, 0, 0})  // bright upper left, half of it upper right, dark below
        image.rgba.insert(image.rgba.end(), 4, static_cast<std::uint8_t>(level));
    s.images = {image};
    s.lights = {l};
    const auto at = [&](float x, float y) { return seen_nit(s, {x, y, 5}, {x, y, 0}); };
    EXPECT_NEAR(at(-0.5f, 1.3f), 1000.0, 1.0);
    EXPECT_NEAR(at(0.5f, 1.3f), 1000.0 * 0.5029, 1.0);
    EXPECT_NEAR(at(-0.5f, 0.7f), 0.0, 1.0);
}

TEST(LightRules, AnImageMultipliesTheLight) {
    scene::Light l = light_of(LightType::rectangle, {0, 1, 0});
    const double plain = floor_lx(l);
    l.image = 0;
    scene::Scene s = floor_under({l});
    scene::Image image;
    image.width = image.height = 1;
    image.rgba = {188, 188, 188, 255};
    s.images = {image};
    for (const Draws draws : {Draws::all, Draws::lights, Draws::material})
        EXPECT_NEAR(floor_lx(s, draws, 4096) / (plain * 0.5029), 1.0, 0.01);
}

TEST(LightRules, FromWithinAShapeThereIsNoLight) {
    for (const LightType type : {LightType::sphere, LightType::tube}) {
        scene::Light l = light_of(type, {0, 0.1f, 0});
        EXPECT_EQ(floor_lx(l), 0.0);
        l.visible = true;
        scene::Scene s;
        s.lights = {l};
        EXPECT_EQ(seen_nit(s, {0, 0.1f, 0}, {0.1f, 0.3f, 0}), 0.0);
    }
}
