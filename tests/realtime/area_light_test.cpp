#include <gtest/gtest.h>

#include "candela/realtime/emissive_lights.hpp"
#include "candela/realtime/light_list.hpp"
#include "render_scenes.hpp"
#include "shading/lights/intersect.glsl"
#include "shading/lights/punctual.glsl"
#include "shading/lights/sampling.glsl"

using namespace candela;
using namespace candela::test;

namespace {

constexpr float kPi = 3.14159265f;
constexpr float kNit = 1000.0f;

/// Odd, so that a pixel is in the middle. Validation is on and expected to be silent.
realtime::Still render(const scene::Scene& scene, const scene::Camera& camera, bool highlights = false,
                       bool aovs = false, float ev100 = 8.0f) {
    const gpu::Device device{validated()};
    realtime::RendererOptions o = options("best", 15);
    // Linearly transformed cosines take a software renderer seconds to compile.
    if (!highlights) o.profile.area_specular = realtime::AreaSpecularTechnique::representative_point;
    o.aovs = aovs;
    realtime::Still still;
    {
        realtime::Renderer renderer(device, scene, o);
        still = renderer.render_still(camera, fixed_ev(ev100));
    }
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    return still;
}

const scene::Camera kFront = scene::look_at({0, 0, 2}, {0, 0, 0}, 0.3f);

scene::Scene plane() {
    return scene_of(square(0.5f), grey(0.5f));
}

float plane_nit(const scene::Light& light) {
    scene::Scene s = plane();
    s.lights.push_back(light);
    return center(render(s, kFront)).x;
}

/// Beside the camera's way, over the origin of a plane that faces +Z, turned to it.
scene::Light shape(scene::LightType type) {
    scene::Light light;
    light.type = type;
    light.position = {0.6f, 0.3f, 0.8f};
    light.direction = glm::normalize(-light.position);
    light.right = glm::normalize(glm::cross(light.direction, glm::vec3(0, 1, 0)));
    light.intensity = kNit;
    light.radius_m = 0.35f;
    light.half_width_m = 0.5f;
    light.half_height_m = 0.25f;
    light.visible = false;
    return light;
}

float enter(const scene::Light& light, const glm::vec3& l) {
    using namespace shading;
    switch (light.type) {
        case scene::LightType::sphere:
            return enter_sphere(l, light.position, light.radius_m);
        case scene::LightType::disk:
            return enter_disk(l, light.position, light.direction, light.radius_m);
        case scene::LightType::rectangle:
            return enter_rectangle(l, light.position, light.right, light.up(), light.half_width_m,
                                   light.half_height_m);
        default:
            return enter_tube(l, light.position, light.right, light.half_width_m, light.radius_m);
    }
}

/// The integral of luminance times cosine over the hemisphere about +Z, by a grid on its projection.
float illuminance_lx(const scene::Light& light) {
    constexpr int side = 600;
    int met = 0;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const glm::vec2 p = (glm::vec2(x, y) + 0.5f) * (2.0f / side) - 1.0f;
            const float rest = 1.0f - glm::dot(p, p);
            if (rest > 0.0f && enter(light, glm::vec3(p, std::sqrt(rest))) > 0.0f) ++met;
        }
    }
    return light.intensity * 4.0f * static_cast<float>(met) / static_cast<float>(side * side);
}

scene::Scene lamp_only(const scene::Light& light) {
    scene::Scene s;
    s.lights.push_back(light);
    return s;
}

}  // namespace

TEST(AreaLight, APictureLightsWhatStandsBeforeItsPartsOnBothSides) {
    // Red on its left and green on its right, brighter above, close to the plane and parallel to it.
    scene::Scene s = plane();
    scene::Image image;
    image.width = image.height = 32;
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            const auto level = static_cast<std::uint8_t>(y < 16 ? 250 : 120);
            image.rgba.insert(image.rgba.end(), {x < 16 ? level : std::uint8_t{10},
                                                 x < 16 ? std::uint8_t{10} : level, 60, 255});
        }
    }
    s.images.push_back(image);
    scene::Light light = shape(scene::LightType::rectangle);
    light.position = {0.0f, 0.0f, 0.15f};
    light.half_width_m = 0.3f;
    light.half_height_m = 0.3f;
    light.image = 0;
    light.two_sided = true;
    for (const float side : {-1.0f, 1.0f}) {
        light.direction = {0.0f, 0.0f, side};
        light.right = {1.0f, 0.0f, 0.0f};
        s.lights = {light};
        const gpu::Device device{validated()};
        realtime::RendererOptions o = options("best", 15);
        o.profile.area_specular = realtime::AreaSpecularTechnique::representative_point;
        const auto nit = [&](const realtime::RendererOptions& how) {
            return realtime::Renderer(device, s, how).render_still(kFront, fixed_ev(8.0f)).planes.light_nit;
        };
        const auto found = nit(o);
        o.integrate.emplace();
        o.samples = 256;
        const auto truth = nit(o);
        glm::vec3 error(0.0f);
        glm::vec3 sum(0.0f);
        for (std::size_t i = 0; i < truth.size(); ++i) {
            error += glm::abs(glm::vec3(found[i]) - glm::vec3(truth[i]));
            sum += glm::vec3(truth[i]);
        }
        for (int c = 0; c < 3; ++c) EXPECT_LT(error[c], 0.13f * sum[c]) << side << ' ' << c;
        // The truth has the contrast that a mean colour would not.
        EXPECT_GT(std::abs(truth[15 * 7 + 2].x - truth[15 * 7 + 12].x), 0.3f * truth[15 * 7 + 7].x);
    }
}

TEST(AreaLight, AGreyPlaneShowsTheIlluminanceOfEveryShape) {
    for (const scene::LightType type : {scene::LightType::sphere, scene::LightType::disk,
                                        scene::LightType::rectangle, scene::LightType::tube}) {
        const scene::Light light = shape(type);
        const float expected_nit = illuminance_lx(light) * 0.5f / kPi;
        EXPECT_NEAR(plane_nit(light), expected_nit, 0.004f * expected_nit) << scene::name_of(type);
    }
}

// Half of the shape is under the plane, or all of it.
TEST(AreaLight, TheHorizonCutsShapes) {
    scene::Light light = shape(scene::LightType::sphere);
    light.position = {0.7f, 0.0f, 0.1f};
    const float expected_nit = illuminance_lx(light) * 0.5f / kPi;
    EXPECT_NEAR(plane_nit(light), expected_nit, 0.006f * expected_nit);
    light.position.z = -0.4f;
    EXPECT_EQ(plane_nit(light), 0.0f);
}

TEST(AreaLight, OneSidedShapesAreDarkBehindAndTwoSidedOnesAreNot) {
    scene::Light light = shape(scene::LightType::rectangle);
    const float lit = plane_nit(light);
    light.direction = -light.direction;
    EXPECT_EQ(plane_nit(light), 0.0f);
    light.two_sided = true;
    EXPECT_NEAR(plane_nit(light), lit, 1e-3f * lit);
}

TEST(AreaLight, TheWindowIsAboutTheCentre) {
    scene::Light light = shape(scene::LightType::sphere);
    const float whole = plane_nit(light);
    const float distance_m = glm::length(light.position);
    light.range_m = 1.5f * distance_m;
    EXPECT_NEAR(plane_nit(light) / whole, shading::window_attenuation(distance_m, light.range_m), 2e-3f);
    light.range_m = distance_m;
    EXPECT_NEAR(plane_nit(light), 0.0f, 1e-6f * whole);
}

TEST(AreaLight, LineAndFrustumAndSunGiveWhatTheyState) {
    // Perpendicular to the middle of a short line the intensity is the stated one.
    scene::Light line = shape(scene::LightType::line);
    line.half_width_m = 0.01f;
    line.position = {0, 0, 1.5f};
    line.direction = {0, 0, -1};
    line.right = {1, 0, 0};
    const float expected_nit = kNit / 2.25f * 0.5f / kPi;
    EXPECT_NEAR(plane_nit(line), expected_nit, 2e-3f * expected_nit);

    scene::Light frustum = line;
    frustum.type = scene::LightType::frustum;
    frustum.horizontal_angle_rad = frustum.vertical_angle_rad = 0.2f;
    EXPECT_NEAR(plane_nit(frustum), expected_nit, 2e-3f * expected_nit);
    frustum.position.x = 0.3f;
    EXPECT_EQ(plane_nit(frustum), 0.0f) << "outside of the pyramid";

    scene::Light sun = test::sun(10000.0f);
    sun.type = scene::LightType::sun;
    sun.direction = glm::normalize(glm::vec3(0.6f, 0.0f, -0.8f));
    EXPECT_NEAR(plane_nit(sun), 8000.0f * 0.5f / kPi, 2e-3f * 4000.0f / kPi);
}

// A smooth metal that is turned to mirror the middle of a large lamp shows the lamp.
TEST(AreaLight, ASmoothMirrorShowsTheLuminanceOfTheShape) {
    scene::Material mirror = grey(1.0f);
    mirror.metallic = 1.0f;
    mirror.perceptual_roughness = 0.2f;
    scene::Scene s = scene_of(square(0.5f), mirror);
    scene::Light light = shape(scene::LightType::rectangle);
    light.position = {2.0f, 0.0f, 2.0f};
    light.direction = glm::normalize(glm::vec3(-1, 0, -1));
    light.right = {0, 1, 0};
    light.half_width_m = light.half_height_m = 1.5f;
    s.lights.push_back(light);
    const scene::Camera from_aside = scene::look_at({-1.5f, 0, 1.5f}, {0, 0, 0}, 0.1f);
    EXPECT_NEAR(center(render(s, from_aside, true)).x, kNit, 0.05f * kNit);
}

TEST(AreaLight, VisibleShapesShowTheirLuminanceInFrontOfAndBehindSurfaces) {
    scene::Scene s = plane();
    const std::array types{scene::LightType::sphere, scene::LightType::disk, scene::LightType::rectangle,
                           scene::LightType::tube};
    for (std::size_t i = 0; i < types.size(); ++i) {
        scene::Light light = shape(types[i]);
        light.visible = true;
        light.intensity = 1.0e6f;
        light.direction = {0, 0, 1};
        light.right = {1, 0, 0};
        light.radius_m = light.half_width_m = light.half_height_m = 0.04f;
        light.position = {i % 2 == 0 ? -0.075f : 0.075f, i < 2 ? 0.075f : -0.075f, 1.0f};
        s.lights.push_back(light);
    }
    const auto pixel = [](std::size_t i) { return (i < 2 ? 3 : 11) * 15 + (i % 2 == 0 ? 3 : 11); };
    const realtime::Still front = render(s, kFront, false, true);
    const auto& emissive = front.planes.aovs[static_cast<std::size_t>(realtime::Aov::emissive)];
    for (scene::Light& light : s.lights) light.position.z = -1.0f;
    const realtime::Still behind = render(s, kFront);
    for (std::size_t i = 0; i < types.size(); ++i) {
        const auto at = static_cast<std::size_t>(pixel(i));
        EXPECT_NEAR(front.planes.light_nit[at].x / 1.0e6f, 1.0f, 1e-3f) << scene::name_of(types[i]);
        EXPECT_NEAR(emissive[at].x / 1.0e6f, 1.0f, 1e-3f) << scene::name_of(types[i]);
        EXPECT_LT(behind.planes.light_nit[at].x, 1.0e5f) << scene::name_of(types[i]) << " behind the plane";
    }
}

TEST(AreaLight, TheDarkSideOfAShapeIsNotThere) {
    scene::Light light = shape(scene::LightType::disk);
    light.visible = true;
    light.position = {0, 0, 1.0f};
    light.direction = {0, 0, -1};
    const float through = center(render(lamp_only(light), kFront)).x;
    EXPECT_EQ(through, 0.0f);
    light.two_sided = true;
    EXPECT_NEAR(center(render(lamp_only(light), kFront)).x, kNit, 1e-3f * kNit);
}

TEST(AreaLight, TheSunsDiscShowsWhatItsIlluminanceMakesOfIt) {
    scene::Light sun = test::sun(100000.0f);
    sun.type = scene::LightType::sun;
    sun.direction = {0, 0, 1};  // the camera looks into it
    const float radius = 0.5f * sun.angular_diameter_rad;
    const float expected_nit = 100000.0f / (kPi * std::sin(radius) * std::sin(radius));
    const scene::Camera narrow = scene::look_at({0, 0, 2}, {0, 0, 0}, 0.02f);
    for (const float ev100 : {15.0f, 8.0f, -6.0f}) {
        const realtime::Still still = render(lamp_only(sun), narrow, false, false, ev100);
        EXPECT_NEAR(center(still).x / expected_nit, 1.0f, 1e-3f) << ev100;
        EXPECT_EQ(still.planes.light_nit.front().x, 0.0f) << "beside the disc";
    }
}

TEST(EmissiveLights, TwoTrianglesAreTheirRectangle) {
    scene::Material glowing = grey(0.0f);
    glowing.emissive_nit = glm::vec3(kNit);
    const std::vector<realtime::EmissiveLight> lights =
        realtime::emissive_lights(scene_of(square(0.4f), glowing));
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_EQ(lights[0].block.color_type, glm::vec4(kNit, kNit, kNit, float(scene::LightType::rectangle)));
    EXPECT_NEAR(glm::length(glm::vec3(lights[0].block.position_range)), 0.0f, 1e-6f);
    EXPECT_NEAR(lights[0].block.direction_a.z, 1.0f, 1e-6f);
    EXPECT_NEAR(lights[0].block.direction_a.w * lights[0].block.right_b.w, 0.16f, 1e-6f);
}

TEST(EmissiveLights, ASphereOfManyTrianglesIsASphere) {
    scene::Material glowing = grey(0.0f);
    glowing.emissive_nit = glm::vec3(kNit);
    const std::vector<realtime::EmissiveLight> lights =
        realtime::emissive_lights(scene_of(test::sphere(0.3f), glowing));
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_EQ(lights[0].block.color_type.w, float(scene::LightType::sphere));
    EXPECT_NEAR(lights[0].block.right_b.w, 0.3f, 0.002f);
}

TEST(EmissiveLights, APanelThatGlowsLightsThePlaneAsTheRectangleDoes) {
    scene::Light light = shape(scene::LightType::rectangle);
    const float expected_nit = plane_nit(light);
    scene::Scene s = plane();
    scene::Material glowing = grey(0.0f);
    glowing.emissive_nit = glm::vec3(kNit);
    s.materials.push_back(glowing);
    scene::Primitive panel = square(1.0f, 1);
    for (glm::vec3& p : panel.positions) {
        p = light.position + p.x * light.half_width_m * light.right - p.y * light.half_height_m * light.up();
    }
    panel.bounds = {};
    for (const glm::vec3& p : panel.positions) panel.bounds.extend(p);
    s.meshes.push_back({"panel", {panel}});
    s.instances.push_back({"panel", 1, glm::mat4(1.0f)});
    EXPECT_NEAR(center(render(s, kFront)).x, expected_nit, 2e-3f * expected_nit);
    // One triangle of it, as a triangle: less light, and the two together are the panel.
    s.meshes.back().primitives[0].indices = {0, 1, 2};
    const float first = center(render(s, kFront)).x;
    s.meshes.back().primitives[0].indices = {0, 2, 3};
    const float second = center(render(s, kFront)).x;
    EXPECT_GT(first, 0.0f);
    EXPECT_NEAR(first + second, expected_nit, 2e-3f * expected_nit);
}

// Every pixel of an emissive surface is a receiver on a light, on whichever side of it the depth buffer's
// rounding says.
TEST(EmissiveLights, ASurfaceThatShinesBothWaysDoesNotLightItself) {
    scene::Material glowing = grey(0.5f);
    glowing.emissive_nit = glm::vec3(kNit);
    glowing.double_sided = true;
    const scene::Camera aside = scene::look_at({1.3f, 0.7f, 1.9f}, {0.1f, 0.05f, 0}, 0.05f);
    const realtime::Still still = render(scene_of(square(0.4f), glowing), aside);
    for (const auto& nit : still.planes.light_nit) EXPECT_NEAR(nit.x, kNit, 2e-3f * kNit);
}

TEST(EmissiveLights, WhatStandsBetweenKeepsTheirLightAway) {
    scene::Scene s = plane();
    scene::Material glowing = grey(0.0f);
    glowing.emissive_nit = glm::vec3(kNit);
    s.materials.push_back(glowing);
    s.meshes.push_back({"lamp", {test::sphere(0.1f, 1)}});
    glm::mat4 above(1.0f);
    above[3] = glm::vec4(0.0f, 0.5f, 0.8f, 1.0f);
    s.instances.push_back({"lamp", 1, above});
    const float lit = center(render(s, kFront)).x;
    // Of the lamp's own size in cd, at its distance and angle: pi r^2 L cos / d^2, times 0.5 / pi.
    const float d2 = 0.25f + 0.64f;
    EXPECT_NEAR(lit, 0.5f * 0.01f * kNit * 0.8f / std::pow(d2, 1.5f), 0.02f * lit);
    s.meshes.push_back({"card", {square(0.25f)}});
    glm::mat4 between(1.0f);
    between[3] = glm::vec4(0.0f, 0.25f, 0.4f, 1.0f);
    s.instances.push_back({"card", 2, between});
    // From the side, past the card.
    const scene::Camera aside = scene::look_at({1.5f, 0.0f, 1.0f}, {0, 0, 0}, 0.1f);
    EXPECT_LT(center(render(s, aside)).x, 1e-3f * lit);
}

TEST(AreaLight, FromAfarAPictureOnARectangleGivesItsMean) {
    scene::Light light = shape(scene::LightType::rectangle);
    light.position *= 10.0f;
    const float white_nit = plane_nit(light);
    scene::Scene s = plane();
    scene::Image half;
    half.name = "half black";
    half.width = 2;
    half.height = 1;
    half.rgba = {255, 255, 255, 255, 0, 0, 0, 255};
    s.images.push_back(half);
    light.image = 0;
    s.lights.push_back(light);
    EXPECT_NEAR(center(render(s, kFront)).x, 0.5f * white_nit, 0.01f * white_nit);
}
