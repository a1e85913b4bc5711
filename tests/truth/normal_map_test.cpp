#include <gtest/gtest.h>

#include <cmath>

#include "trace.hpp"

using namespace candela;
using namespace candela::test;

namespace {

constexpr double kPi = 3.14159265358979;

double radians(double degrees) {
    return degrees * kPi / 180.0;
}

/// A floor whose map turns every normal towards +X.
scene::Scene mapped_floor(double tilt_degrees, scene::Material m) {
    const auto byte = [](double x) {
        return static_cast<std::uint8_t>(std::lround(255.0 * (0.5 + 0.5 * x)));
    };
    const double tilt = radians(tilt_degrees);
    scene::Scene s;
    s.images.push_back({"tilted", 1, 1, {byte(std::sin(tilt)), 128, byte(std::cos(tilt)), 255}});
    s.textures.push_back({0, {}});
    m.normal_texture.texture = 0;
    scene::Primitive plane = flat_square(20.0f, glm::vec3(0.0f), true);
    plane.tangents.assign(4, {1, 0, 0, 1});
    plane.uv[0].assign(4, {0.5f, 0.5f});
    place(s, plane, std::move(m));
    return s;
}

/// The same by its vertices' normals, without a map.
scene::Scene tilted_floor(double tilt_degrees, scene::Material m) {
    scene::Scene s;
    scene::Primitive plane = flat_square(20.0f, glm::vec3(0.0f), true);
    const double tilt = radians(tilt_degrees);
    plane.normals.assign(4, glm::vec3(std::sin(tilt), std::cos(tilt), 0.0));
    place(s, plane, std::move(m));
    return s;
}

scene::Material glossy_lamp() {
    scene::Material m;
    m.base_color = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
    m.metallic = 0.3f;
    m.perceptual_roughness = 0.4f;
    m.emissive_nit = glm::vec3(100.0f);
    return m;
}

void light_it(scene::Scene& s) {
    s.environment = constant(50.0f);
    scene::Light light = sun(300.0f);
    light.direction = glm::normalize(glm::vec3(-1.0f, -0.5f, 0.2f));
    s.lights.push_back(light);
    scene::Light ball;
    ball.type = scene::LightType::sphere;
    ball.position = {2.0f, 0.5f, 0.0f};
    ball.radius_m = 0.3f;
    ball.intensity = 400.0f;
    s.lights.push_back(ball);
}

}  // namespace

TEST(PathNormalMap, AQuadAloneIsLitByNothingOfItsOwn) {
    for (const double tilt : {30.0, 45.0, 60.0}) {
        for (scene::Scene s : {mapped_floor(tilt, glossy_lamp()), tilted_floor(tilt, glossy_lamp())}) {
            light_it(s);
            const scene::Camera eye = spot_meter({1.0f, 3.0f, 0.5f});
            const double direct = mean_luminance(s, eye, path_options(true), 256).y;
            EXPECT_NEAR(mean_luminance(s, eye, path_options(false), 256).y, direct, 1e-9 * direct)
                << tilt << " degrees, " << (s.textures.empty() ? "vertex normals" : "map");
        }
    }
}

// Light from below the surface does not count, so a white surface loses that part of its hemisphere.
TEST(PathNormalMap, TheFurnaceLosesWhatIsBelowTheSurface) {
    for (const double tilt : {0.0, 15.0, 30.0, 45.0, 60.0}) {
        const double kept = 0.5 * (1.0 + std::cos(radians(tilt)));
        const double matt =
            mean_luminance(mapped_floor(tilt, grey(1.0f)), spot_meter(), path_options(false, true), 1024).y;
        EXPECT_NEAR(matt, kept, 0.005) << tilt;
        for (const float metallic : {0.0f, 1.0f}) {
            scene::Material m = grey(1.0f);
            m.specular = 1.0f;
            m.metallic = metallic;
            m.perceptual_roughness = 0.5f;
            const double seen =
                mean_luminance(mapped_floor(tilt, m), spot_meter(), path_options(false, true), 1024).y;
            EXPECT_LE(seen, 1.005) << tilt << " metallic " << metallic;
            RecordProperty("kept_" + std::to_string(static_cast<int>(tilt)) + "_" +
                               std::to_string(static_cast<int>(metallic)),
                           std::to_string(seen));
        }
    }
}

// From every side and for lobes narrow and wide: light is lost below the surface and none is made.
TEST(PathNormalMap, NoFurnaceGainsUnderMapsUpToSixtyDegrees) {
    double most = 0.0;
    for (const double tilt : {15.0, 30.0, 45.0, 60.0}) {
        for (const float metallic : {0.0f, 1.0f}) {
            for (const float roughness : {0.1f, 0.4f, 0.7f, 1.0f}) {
                scene::Material m = grey(1.0f);
                m.specular = 1.0f;
                m.metallic = metallic;
                m.perceptual_roughness = roughness;
                const scene::Scene s = mapped_floor(tilt, m);
                for (const double view : {-75.0, -40.0, 0.0, 40.0, 75.0}) {
                    const glm::vec3 from(3.0 * std::sin(radians(view)), 3.0 * std::cos(radians(view)), 0.0);
                    const double seen =
                        mean_luminance(s, spot_meter(from), path_options(false, true), 64, 4).y;
                    EXPECT_LE(seen, 1.01) << tilt << ", metallic " << metallic << ", roughness " << roughness
                                          << ", seen from " << view;
                    most = std::max(most, seen);
                }
            }
        }
    }
    RecordProperty("most", std::to_string(most));
}

TEST(PathNormalMap, LightFromBelowTheSurfaceDoesNotCount) {
    scene::Scene s = mapped_floor(60.0, grey(1.0f));
    scene::Light light = sun(1000.0f);
    light.direction = glm::normalize(glm::vec3(-1.0f, 0.1f, 0.0f));
    light.casts_shadow = false;
    s.lights = {light};
    EXPECT_EQ(mean_luminance(s, spot_meter(), path_options(true), 64).y, 0.0);
    s.lights[0].direction = glm::normalize(glm::vec3(-1.0f, -0.1f, 0.0f));
    EXPECT_GT(mean_luminance(s, spot_meter(), path_options(true), 64).y, 200.0);
}
