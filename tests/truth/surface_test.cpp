#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "trace.hpp"

using namespace candela;
using namespace candela::test;

namespace {

constexpr double kPi = 3.14159265358979;

scene::Material sheet(float alpha, scene::AlphaMode mode) {
    scene::Material m = grey(0.0f);
    m.base_color.a = alpha;
    m.alpha_mode = mode;
    m.double_sided = true;
    return m;
}

/// Luminance of a white Lambert floor under 1000 lx from above, through a sheet.
double below_a_sheet(const scene::Material& m) {
    scene::Scene s;
    place(s, flat_square(20.0f, glm::vec3(0.0f), true), grey(1.0f));
    place(s, flat_square(20.0f, {0, 1, 0}, true), m);
    scene::Light light = sun(1000.0f);
    light.direction = {0, -1, 0};
    s.lights.push_back(light);
    return mean_luminance(s, spot_meter({2.5f, 0.4f, 0}), path_options(true), 256).y;
}

}  // namespace

TEST(PathSurface, BlendedSheetsLetTheirPartOfTheLightThrough) {
    EXPECT_NEAR(below_a_sheet(sheet(0.25f, scene::AlphaMode::blend)), 750.0 / kPi, 0.5);
    EXPECT_NEAR(below_a_sheet(sheet(1.0f, scene::AlphaMode::blend)), 0.0, 1e-6);
}

TEST(PathSurface, MasksAreAllOrNothing) {
    EXPECT_NEAR(below_a_sheet(sheet(0.4f, scene::AlphaMode::mask)), 1000.0 / kPi, 0.5);
    EXPECT_NEAR(below_a_sheet(sheet(0.6f, scene::AlphaMode::mask)), 0.0, 1e-6);
}

TEST(PathSurface, TheCameraSeesThroughBlendedSheetsByChance) {
    scene::Scene s;
    scene::Material back = lamp(100.0f);
    place(s, flat_square(20.0f, glm::vec3(0.0f), true), back);
    scene::Material front = sheet(0.3f, scene::AlphaMode::blend);
    front.emissive_nit = glm::vec3(10.0f);
    place(s, flat_square(20.0f, {0, 1, 0}, true), front);
    EXPECT_NEAR(mean_luminance(s, spot_meter(), path_options(true), 4096).y, 0.3 * 10.0 + 0.7 * 100.0, 0.5);
}

TEST(PathSurface, CulledBacksAreNotThereForTheCameraButShutLightOut) {
    scene::Scene s;
    place(s, flat_square(20.0f, glm::vec3(0.0f), true), grey(1.0f));
    place(s, flat_square(20.0f, {0, 1, 0}, false), grey(1.0f));  // a ceiling that faces down
    scene::Light light = sun(1000.0f);
    light.direction = {0, -1, 0};
    s.lights.push_back(light);
    EXPECT_EQ(mean_luminance(s, spot_meter({0, 3, 0}), path_options(true), 16).y, 0.0);
    s.lights.clear();
    scene::Light inside;
    inside.position = {0.3f, 0.5f, 0};
    inside.intensity = 100.0f;
    s.lights.push_back(inside);
    EXPECT_GT(mean_luminance(s, spot_meter({0, 3, 0}), path_options(true), 16).y, 10.0);
}

// The normals of a coarse sphere promise a round one: no facet may shadow itself where the normals see the
// light.
TEST(PathSurface, CoarseMeshesHaveNoFacetedTerminator) {
    // The terminator lies just beyond the middle of a facet: half of that facet faces away although its
    // normals do not.
    const float turn = 0.21f;
    const glm::vec3 l(std::cos(turn), 0.0f, -std::sin(turn));
    const scene::Scene coarse = [&] {
        scene::Scene s = scene_of(sphere(1.0f, 0, 16, 8), grey(1.0f));
        scene::Light light = sun(1000.0f);
        light.direction = -l;
        s.lights.push_back(light);
        return s;
    }();
    const truth::PathIntegrator integrator(coarse, path_options(true));
    const truth::CameraRays rays(scene::look_at({0, 0, 5}, {0, 0, 0}, 0.4f), 128, 128);
    int checked = 0;
    for (std::uint32_t y = 0; y < 128; ++y) {
        for (std::uint32_t x = 0; x < 128; ++x) {
            const truth::PathSampler sampler({x, y}, 0, 0);
            const truth::Ray ray = rays.through(glm::vec2(x, y) + 0.5f, glm::vec2(0.5f));
            const truth::PathResult path = integrator.trace(ray, sampler);
            const float NoL = glm::dot(path.normal, l);
            // Normals that look away from the viewer are turned before they are lit.
            if (path.object_id == 0 || NoL < 0.12f || glm::dot(path.normal, ray.direction) > -1e-3f) continue;
            ++checked;
            EXPECT_NEAR(path.luminance_nit.y, 1000.0 * static_cast<double>(NoL) / kPi, 1.0) << x << ", " << y;
        }
    }
    EXPECT_GT(checked, 1000);
}

TEST(PathSurface, NormalMapsDoNotLeakLight) {
    // A map that tilts every normal by 35 degrees towards +X.
    scene::Material m = grey(1.0f);
    scene::Scene s;
    const float tilt = 0.61f;
    const auto byte = [](float x) {
        return static_cast<std::uint8_t>(std::lround(255.0f * (0.5f + 0.5f * x)));
    };
    s.images.push_back({"tilted", 1, 1, {byte(std::sin(tilt)), 128, byte(std::cos(tilt)), 255}});
    s.textures.push_back({0, {}});
    m.normal_texture.texture = 0;
    scene::Primitive plane = flat_square(20.0f, glm::vec3(0.0f), true);
    plane.tangents.assign(4, {1, 0, 0, 1});
    plane.uv[0].assign(4, {0.5f, 0.5f});
    place(s, plane, m);
    // The tilted normal sees a sun above the surface, and not one below it.
    scene::Light light = sun(1000.0f);
    light.direction = glm::normalize(glm::vec3(-1.0f, -0.3f, 0.0f));
    s.lights = {light};
    EXPECT_NEAR(mean_luminance(s, spot_meter(), path_options(true), 64).y,
                1000.0 / kPi *
                    (std::sin(static_cast<double>(tilt)) + 0.3 * std::cos(static_cast<double>(tilt))) /
                    std::sqrt(1.09),
                2.0);
    s.lights[0].direction = glm::normalize(glm::vec3(-1.0f, 0.1f, 0.0f));
    EXPECT_EQ(mean_luminance(s, spot_meter(), path_options(true), 64).y, 0.0);
}

TEST(PathSurface, UnlitColoursAreKeptApart) {
    scene::Material m = grey(1.0f);
    m.base_color = glm::vec4(0.2f, 0.4f, 0.6f, 1.0f);
    m.unlit = true;
    const scene::Scene s = scene_of(flat_square(1.0f, glm::vec3(0.0f), true), m);
    const truth::PathIntegrator integrator(s, path_options());
    const truth::PathResult path = integrator.trace(
        truth::CameraRays(spot_meter(), 1, 1).through({0.5f, 0.5f}, {0.5f, 0.5f}), {{0, 0}, 0, 0});
    EXPECT_EQ(path.luminance_nit, glm::vec3(0.0f));
    EXPECT_EQ(path.unlit, glm::vec3(0.2f, 0.4f, 0.6f));
}

TEST(PathSurface, TheLobesSumToTheLight) {
    scene::Material m;
    m.base_color = glm::vec4(0.6f, 0.3f, 0.2f, 1.0f);
    m.metallic = 0.3f;
    m.perceptual_roughness = 0.4f;
    scene::Scene s = scene_of(sphere(1.0f), m);
    place(s, flat_square(1.0f, {0, 2, 0}, false), lamp(50.0f));
    s.environment = constant(10.0f);
    s.lights.push_back(sun(100.0f));
    const truth::PathIntegrator integrator(s, path_options());
    const truth::CameraRays rays(scene::look_at({0, 0, 3}, {0, 0, 0}, 0.45f), 8, 8);
    for (std::uint32_t i = 0; i < 64; ++i) {
        const glm::uvec2 pixel(i % 8, i / 8);
        const truth::PathSampler sampler(pixel, i, 0);
        const truth::PathResult p =
            integrator.trace(rays.through(glm::vec2(pixel) + 0.5f, glm::vec2(0.5f)), sampler);
        if (p.object_id == 0) continue;
        const glm::vec3 sum =
            p.direct_diffuse + p.direct_specular + p.indirect_diffuse + p.indirect_specular + p.emissive;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sum[c], p.luminance_nit[c], 1e-4f * (1.0f + p.luminance_nit[c]));
    }
}

// Beside a wall that hides half of a white sky, an irradiance of half of it (1 cd/m2 times albedo times 1/2),
// and what the wall reflects. The same sample with and without bounces has the same light straight from the
// sky.
TEST(PathSurface, LightStraightFromTheEnvironmentIsToldFromWhatSurfacesReflect) {
    scene::Material white;
    white.base_color = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
    white.metallic = 0.0f;
    white.specular = 0.0f;
    scene::Scene s = scene_of(flat_square(100.0f, glm::vec3(0.0f), true), white);
    // A wall 5 cm behind the point that is seen, far larger than that.
    place(s, square(1000.0f), white, glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 0.0f, -0.05f)));
    s.environment = constant(1.0f);
    const truth::PathIntegrator all(s, path_options());
    const truth::PathIntegrator direct(s, path_options(true));
    const truth::CameraRays rays(spot_meter(), 1, 1);
    glm::vec3 environment(0.0f), indirect(0.0f), direct_indirect(0.0f);
    constexpr std::uint32_t kSamples = 4096;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const truth::PathSampler sampler({0, 0}, i, 0);
        const truth::PathResult a = all.trace(rays.through({0.5f, 0.5f}, {0.5f, 0.5f}), sampler);
        const truth::PathResult d = direct.trace(rays.through({0.5f, 0.5f}, {0.5f, 0.5f}), sampler);
        EXPECT_EQ(a.environment, d.environment);
        environment += a.environment / float(kSamples);
        indirect += (a.indirect_diffuse + a.indirect_specular) / float(kSamples);
        direct_indirect += (d.indirect_diffuse + d.indirect_specular) / float(kSamples);
    }
    EXPECT_NEAR(environment.y, direct_indirect.y, 1e-4f);
    EXPECT_NEAR(environment.y, 0.4f, 0.02f);
    EXPECT_GT(indirect.y, 1.2f * environment.y);
}

TEST(Lens, ThingsOutOfFocusBlurAndThingsInFocusDoNot) {
    // An edge of light at 2 m: sharp when focused there, spread over the circle of confusion when focused at
    // 1 m.
    scene::Scene s;
    scene::Primitive half = square(10.0f);
    for (glm::vec3& p : half.positions) p.x += 10.0f;
    place(s, half, lamp(1.0f), glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, -2)));
    const truth::PathIntegrator integrator(s, path_options(true));
    const scene::Camera camera = scene::look_at({0, 0, 0}, {0, 0, -1}, 0.5f);
    const auto lit = [&](float focus_m, const glm::vec2& pixel) {
        const truth::CameraRays rays(camera, 100, 100, {0.05f, focus_m});
        double sum = 0.0;
        for (std::uint32_t i = 0; i < 256; ++i) {
            const truth::PathSampler sampler({0, 0}, i, 0);
            sum += static_cast<double>(
                integrator.trace(rays.through(pixel, sampler.lens()), sampler).luminance_nit.y);
        }
        return sum / 256.0;
    };
    EXPECT_NEAR(lit(2.0f, {49.0f, 50.0f}), 0.0, 1e-6);
    EXPECT_NEAR(lit(2.0f, {51.0f, 50.0f}), 1.0, 1e-6);
    EXPECT_GT(lit(1.0f, {49.0f, 50.0f}), 0.2);
    EXPECT_LT(lit(1.0f, {51.0f, 50.0f}), 0.8);
    EXPECT_NEAR(truth::lens_radius_m(scene::yfov_from_focal_mm(50.0f), 2.0f), 0.0125f, 1e-5f);
}
