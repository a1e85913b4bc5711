#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "trace.hpp"

using namespace candela;
using namespace candela::test;

namespace {

constexpr double kPi = 3.14159265358979;

/// A grey floor, seen at the origin, under one emissive shape.
double floor_luminance(scene::Primitive shape, float luminance_nit, float albedo,
                       const glm::mat4& world = glm::mat4(1.0f)) {
    scene::Scene s;
    place(s, flat_square(20.0f, glm::vec3(0.0f), true), grey(albedo));
    place(s, std::move(shape), lamp(luminance_nit), world);
    // From the side, where no lamp of these tests is in the way.
    return mean_luminance(s, spot_meter({2.5f, 0.4f, 0.0f}), path_options(true)).y;
}

/// Form factor of a parallel rectangle a x b at distance c, of which one corner is above the point (Howell,
/// B-3).
double corner_form_factor(double a, double b, double c) {
    const double x = a / c;
    const double y = b / c;
    const double rx = std::sqrt(1.0 + x * x);
    const double ry = std::sqrt(1.0 + y * y);
    return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2.0 * kPi);
}

scene::Primitive disk(float radius_m, const glm::vec3& center, int segments) {
    scene::Primitive p;
    p.positions.push_back(center);
    for (int i = 0; i < segments; ++i) {
        const float phi = 2.0f * 3.14159265f * static_cast<float>(i) / static_cast<float>(segments);
        p.positions.push_back(center + radius_m * glm::vec3(std::cos(phi), 0.0f, std::sin(phi)));
        const auto here = static_cast<std::uint32_t>(1 + i);
        const auto next = static_cast<std::uint32_t>(1 + (i + 1) % segments);
        p.indices.insert(p.indices.end(), {0u, here, next});
    }
    p.normals.assign(p.positions.size(), {0.0f, -1.0f, 0.0f});
    return p;
}

}  // namespace

TEST(ClosedForm, ARectangleAboveThePoint) {
    const double expected = 1000.0 * 4.0 * corner_form_factor(0.7, 0.7, 1.2) * 0.6;
    EXPECT_NEAR(floor_luminance(flat_square(0.7f, {0, 1.2f, 0}, false), 1000.0f, 0.6f) / expected, 1.0,
                0.003);
}

TEST(ClosedForm, ARectangleSeenAtASlant) {
    // Two corner rectangles' difference, twice: from x = 1 to 2 and z = -0.5 to 0.5, at height 1.
    const double expected =
        500.0 * 2.0 * (corner_form_factor(2.0, 0.5, 1.0) - corner_form_factor(1.0, 0.5, 1.0)) * 0.5;
    EXPECT_NEAR(floor_luminance(flat_square(0.5f, {-1.5f, 1.0f, 0}, false), 500.0f, 0.5f) / expected, 1.0,
                0.003);
}

TEST(ClosedForm, TheBackOfARectangleIsDark) {
    EXPECT_EQ(floor_luminance(flat_square(0.7f, {0, 1.2f, 0}, true), 1000.0f, 0.6f), 0.0);
}

TEST(ClosedForm, ADiskAboveThePoint) {
    const double expected = 1000.0 * 0.5 * 0.25 / (0.25 + 1.0);
    EXPECT_NEAR(floor_luminance(disk(0.5f, {0, 1, 0}, 256), 1000.0f, 0.5f) / expected, 1.0, 0.003);
}

TEST(ClosedForm, ASphereAboveThePoint) {
    const double expected = 1000.0 * 0.5 * 0.3 * 0.3 / (1.5 * 1.5);
    const glm::mat4 up = glm::translate(glm::mat4(1.0f), glm::vec3(0, 1.5f, 0));
    EXPECT_NEAR(floor_luminance(sphere(0.3f, 0, 128, 64), 1000.0f, 0.5f, up) / expected, 1.0, 0.003);
}

TEST(ClosedForm, ATinyLampIsDrawnByItsAreaAndABigOneByItsSolidAngle) {
    const double small = 1e6 * 4.0 * corner_form_factor(0.005, 0.005, 1.2) * 0.6;
    EXPECT_NEAR(floor_luminance(flat_square(0.005f, {0, 1.2f, 0}, false), 1e6f, 0.6f) / small, 1.0, 0.003);
    const double big = 10.0 * 4.0 * corner_form_factor(50.0, 50.0, 1.2) * 0.6;
    EXPECT_NEAR(floor_luminance(flat_square(50.0f, {0, 1.2f, 0}, false), 10.0f, 0.6f) / big, 1.0, 0.003);
}

// Light inside a diffuse sphere, equal everywhere after any number of bounces: L = E rho / (pi (1 - rho)).
TEST(ClosedForm, TheIntegratingSphere) {
    for (const float albedo : {0.5f, 0.8f}) {
        scene::Material wall = grey(albedo);
        wall.double_sided = true;
        scene::Scene s = scene_of(sphere(2.0f, 0, 128, 64), wall);
        scene::Light light;
        light.type = scene::LightType::point;
        light.intensity = 100.0f;
        s.lights.push_back(light);
        const double illuminance_lx = 100.0 / 4.0;
        const double expected =
            illuminance_lx * static_cast<double>(albedo) / (kPi * (1.0 - static_cast<double>(albedo)));
        const double seen =
            mean_luminance(s, spot_meter({0.3f, 0.2f, 0.1f}, {0, 0, -2}), path_options(), 2048).y;
        EXPECT_NEAR(seen / expected, 1.0, 0.003) << albedo;
    }
}

TEST(ClosedForm, AMirrorShowsTheLuminanceOfWhatItSees) {
    scene::Material mirror;
    mirror.base_color = glm::vec4(0.5f, 0.7f, 0.9f, 1.0f);
    mirror.metallic = 1.0f;
    mirror.perceptual_roughness = 0.0f;
    scene::Scene s;
    place(s, flat_square(1.0f, glm::vec3(0.0f), true), mirror);
    place(s, flat_square(20.0f, {0, 5, 0}, false), lamp(300.0f));
    const glm::dvec3 seen = mean_luminance(s, spot_meter({0.5f, 1.0f, 0}), path_options(true), 1024);
    // Schlick's Fresnel at the 26.6 degrees between view and normal.
    const double rise = std::pow(1.0 - 1.0 / std::sqrt(1.25), 5.0);
    for (int c = 0; c < 3; ++c) {
        const double f0 = static_cast<double>(mirror.base_color[c]);
        EXPECT_NEAR(seen[c] / (300.0 * (f0 + (1.0 - f0) * rise)), 1.0, 0.003) << c;
    }
}

TEST(ClosedForm, PunctualLightsGiveTheirIlluminance) {
    scene::Scene s;
    place(s, flat_square(20.0f, glm::vec3(0.0f), true), grey(0.5f));
    scene::Light point;
    point.position = {0, 2, 0};
    point.intensity = 400.0f;
    scene::Light from_above = sun(1000.0f);
    from_above.direction = glm::normalize(glm::vec3(0.0f, -1.0f, 1.0f));
    s.lights = {point, from_above};
    const double illuminance_lx = 100.0 + 1000.0 * std::sqrt(0.5);
    EXPECT_NEAR(
        mean_luminance(s, spot_meter({2.5f, 0.4f, 0}), path_options(), 256).y / (illuminance_lx * 0.5 / kPi),
        1.0, 0.003);
}

TEST(ClosedForm, AnEnvironmentGivesTheSumOfItsTexels) {
    scene::Scene s;
    place(s, flat_square(20.0f, glm::vec3(0.0f), true), grey(0.5f));
    scene::Environment e = constant(100.0f);
    // A sun of one texel, a thousand times brighter than all the rest together.
    e.luminance_nit[std::size_t{4} * 32 + 20] = glm::vec3(1e7f);
    s.environment = e;
    s.environment->rotation_rad = 0.4f;
    double illuminance_lx = 0.0;
    const int fine = 64;  // sub-steps a texel: the map is read bilinearly
    for (int y = 0; y < 8 * fine; ++y) {
        const double theta = (y + 0.5) * kPi / (16.0 * fine);
        for (int x = 0; x < 32 * fine; ++x) {
            const auto texel = [&](int cx, int cy) {
                const int wrapped = (cx + 32) % 32;
                const int clamped = std::clamp(cy, 0, 15);
                return static_cast<double>(
                    e.luminance_nit[static_cast<std::size_t>(clamped * 32 + wrapped)].y);
            };
            const double px = (x + 0.5) / fine - 0.5;
            const double py = (y + 0.5) / fine - 0.5;
            const int x0 = static_cast<int>(std::floor(px));
            const int y0 = static_cast<int>(std::floor(py));
            const double fx = px - x0;
            const double fy = py - y0;
            const double nit = (texel(x0, y0) * (1 - fx) + texel(x0 + 1, y0) * fx) * (1 - fy) +
                               (texel(x0, y0 + 1) * (1 - fx) + texel(x0 + 1, y0 + 1) * fx) * fy;
            illuminance_lx +=
                nit * std::cos(theta) * std::sin(theta) * (kPi / (16.0 * fine)) * (2 * kPi / (32.0 * fine));
        }
    }
    const double seen = mean_luminance(s, spot_meter({2.5f, 0.4f, 0}), path_options(true), 4096).y;
    EXPECT_NEAR(seen / (illuminance_lx * 0.5 / kPi), 1.0, 0.003);
}
