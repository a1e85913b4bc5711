#include "lights.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "candela/truth/light_sampler.hpp"
#include "candela/truth/shape_light.hpp"
#include "shading/lights/units.glsl"
#include "shading/sequence.glsl"

using namespace candela;
using namespace candela::test;
using scene::LightType;

namespace {

constexpr double kPi = 3.14159265358979;
constexpr double kWithin = 0.003;

/// Projected solid angle of a polygon above the horizon of +Y: Lambert 1760, the sum over its edges.
double polygon_projected_sr(const std::vector<glm::dvec3>& corners) {
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(corners[i]);
        const glm::dvec3 b = glm::normalize(corners[(i + 1) % corners.size()]);
        const glm::dvec3 across = glm::cross(a, b);
        sum += std::atan2(glm::length(across), glm::dot(a, b)) * across.y / glm::length(across);
    }
    return std::abs(0.5 * sum);
}

double rectangle_lx(const scene::Light& l) {
    const glm::dvec3 right = glm::dvec3(l.right) * static_cast<double>(l.half_width_m);
    const glm::dvec3 up = glm::dvec3(l.up()) * static_cast<double>(l.half_height_m);
    const glm::dvec3 c(l.position);
    return static_cast<double>(l.intensity) *
           polygon_projected_sr({c - right - up, c + right - up, c + right + up, c - right + up});
}

/// Illuminance per unit of strength over its length of a thin line parallel to the floor at height h, from
/// -x to x: the integral of h^2 / (h^2 + y^2)^2.
double parallel_line(double x, double h) {
    return (x * h / (h * h + x * x) + std::atan(x / h)) / h;
}

/// The light that arrives at an enclosing sphere, drawn from the light; and by rays towards it.
struct Power {
    double drawn_lm = 0.0;
    double met_lm = 0.0;
};
Power power_of(const scene::Light& light, float radius_m) {
    Power p;
    constexpr unsigned count = 1u << 16;
    const double area = 4.0 * kPi * static_cast<double>(radius_m) * static_cast<double>(radius_m);
    for (unsigned i = 0; i < count; ++i) {
        const glm::vec2 a = shading::hammersley(i, count);
        const float sine = std::sqrt(a.x * (1.0f - a.x)) * 2.0f;
        const float phi = shading::TWO_PI * a.y;
        const glm::vec3 outward(sine * std::cos(phi), 1.0f - 2.0f * a.x, sine * std::sin(phi));
        const glm::vec3 point = light.position + radius_m * outward;
        const glm::vec2 u = shading::sobol_owen_pair(i, 1, 5);
        const shading::LightDirection drawn = truth::sample_shape(light, point, u);
        if (drawn.pdf > 0.0f) {
            const float cosine = std::max(-glm::dot(drawn.direction, outward), 0.0f);
            p.drawn_lm += static_cast<double>(light.intensity * cosine / drawn.pdf) * area / count;
        }
        glm::vec3 t;
        glm::vec3 b;
        shading::orthonormal_basis(-outward, t, b);
        const glm::vec3 d = shading::to_world(shading::sample_cosine_hemisphere(u), t, b, -outward);
        if (truth::enter_shape(light, {point, d}) > 0.0f)
            p.met_lm += static_cast<double>(light.intensity) * kPi * area / count;
    }
    return p;
}

}  // namespace

TEST(Lights, ASphereGivesItsIlluminanceFromAboveAndAtASlant) {
    scene::Light l = light_of(LightType::sphere, {0, 1.5f, 0});
    EXPECT_NEAR(floor_lx(l) / (1000.0 * kPi * 0.09 / 2.25), 1.0, kWithin);
    l.position = {-1.0f, 0.8f, 0.6f};
    const double d2 = 1.0 + 0.64 + 0.36;
    EXPECT_NEAR(floor_lx(l) / (1000.0 * kPi * 0.09 / d2 * 0.8 / std::sqrt(d2)), 1.0, kWithin);
}

TEST(Lights, ADiskGivesItsIlluminanceAboveBesideAndTilted) {
    scene::Light l = light_of(LightType::disk, {0, 1, 0});
    l.radius_m = 0.5f;
    EXPECT_NEAR(floor_lx(l) / (1000.0 * kPi * 0.25 / 1.25), 1.0, kWithin);
    // Parallel, off the axis by x (Howell, B-13): half of 1 - (h^2 + x^2 - r^2) / sqrt((h^2 + x^2 + r^2)^2 -
    // 4 r^2 x^2).
    l.position = {-0.8f, 0.5f, 0};
    const double s = 0.25 + 0.64;
    const double factor = 0.5 * (1.0 - (s - 0.25) / std::sqrt((s + 0.25) * (s + 0.25) - 4 * 0.25 * 0.64));
    EXPECT_NEAR(floor_lx(l) / (1000.0 * kPi * factor), 1.0, kWithin);
    // Facing the point at 45 degrees, as the cap that it hides.
    l = light_of(LightType::disk, {-1, 1, 0}, {1, -1, 0});
    EXPECT_NEAR(floor_lx(l) / (1000.0 * kPi * 0.09 / (0.09 + 2.0) * std::sqrt(0.5)), 1.0, kWithin);
    // Nearly touching: half of the sky.
    l = light_of(LightType::disk, {0.1f, 0.002f, 0.05f});
    EXPECT_NEAR(floor_lx(l) / (1000.0 * kPi), 1.0, kWithin);
}

TEST(Lights, ARectangleGivesItsIlluminanceAboveAndTilted) {
    scene::Light l = light_of(LightType::rectangle, {0, 1.2f, 0});
    EXPECT_NEAR(floor_lx(l) / rectangle_lx(l), 1.0, kWithin);
    l = light_of(LightType::rectangle, {-1.0f, 0.9f, 0.7f}, {1.0f, -0.3f, -0.2f});
    EXPECT_NEAR(floor_lx(l) / rectangle_lx(l), 1.0, kWithin);
    l.half_width_m = 0.001f;
    l.half_height_m = 0.002f;
    l.intensity = 1e6f;
    EXPECT_NEAR(floor_lx(l) / rectangle_lx(l), 1.0, kWithin);
}

TEST(Lights, ATubeIsAnEndlessCylinderInTheLimitAndAThinOneALine) {
    scene::Light l = light_of(LightType::tube, {0, 1, 0});
    l.half_width_m = 2000.0f;
    EXPECT_NEAR(floor_lx(l) / (1000.0 * kPi * 0.3), 1.0, kWithin);
    l.half_width_m = 1.5f;
    l.radius_m = 0.001f;
    EXPECT_NEAR(floor_lx(l) / (1000.0 * 2.0 * 0.001 * parallel_line(1.5, 1.0)), 1.0, kWithin);
    l.half_width_m = 0.0f;  // a sphere
    l.radius_m = 0.3f;
    EXPECT_NEAR(floor_lx(l) / (1000.0 * kPi * 0.09), 1.0, kWithin);
}

TEST(Lights, ALineSpreadsItsIntensityOverItsLength) {
    scene::Light l = light_of(LightType::line, {0, 1, 0});
    l.half_width_m = 1.5f;
    EXPECT_NEAR(floor_lx(l) / (1000.0 / 3.0 * parallel_line(1.5, 1.0)), 1.0, kWithin);
    l.position = {0, 10, 0};
    l.half_width_m = 0.01f;
    EXPECT_NEAR(floor_lx(l) / 10.0, 1.0, kWithin) << "from far away it is a point of its candelas";
}

TEST(Lights, TheSunGivesItsIlluminance) {
    scene::Light l = light_of(LightType::sun, {}, {0.5f, -1.0f, 0.2f});
    for (const float diameter : {0.0093f, 0.5f}) {
        for (const bool limb : {false, true}) {
            l.angular_diameter_rad = diameter;
            l.limb_darkening = limb;
            EXPECT_NEAR(floor_lx(l) / (1000.0 / std::sqrt(1.29)), 1.0, kWithin) << diameter << limb;
        }
    }
}

TEST(Lights, AFrustumShinesWithinItsPyramid) {
    scene::Light l = light_of(LightType::frustum, {0, 2, 0});
    l.horizontal_angle_rad = 0.8f;  // along x
    l.vertical_angle_rad = 0.4f;
    EXPECT_NEAR(floor_lx(l) / 250.0, 1.0, kWithin);
    l.position = {2.0f * std::tan(0.39f), 2, 0};
    EXPECT_GT(floor_lx(l), 0.0);
    l.position = {2.0f * std::tan(0.41f), 2, 0};
    EXPECT_EQ(floor_lx(l), 0.0);
    l.position = {0, 2, 2.0f * std::tan(0.21f)};
    EXPECT_EQ(floor_lx(l), 0.0);
}

TEST(Lights, AProfileGivesItsCandelasOverTheSquaredDistance) {
    scene::PhotometricProfile web;
    web.vertical_deg = {0, 30, 60, 90, 180};
    web.horizontal_deg = {0, 90, 180, 270, 360};
    for (int c = 0; c < 5; ++c)
        web.candela.insert(web.candela.end(), {800, 700.0f + 50.0f * static_cast<float>(c % 4), 200, 0, 0});
    scene::Light l = light_of(LightType::point, {0, 2, 0});
    l.intensity = 1.5f;
    l.profile = 0;
    scene::Scene s = floor_under({l});
    s.profiles = {web};
    EXPECT_NEAR(floor_lx(s) / (1.5 * 800.0 / 4.0), 1.0, 0.005);
    // 30 degrees towards each half-plane: the point is at -right of a light that is moved to +right.
    const float side = 2.0f * std::tan(shading::PI / 6.0f);
    const double d2 = 4.0 + static_cast<double>(side) * static_cast<double>(side);
    for (int c = 0; c < 4; ++c) {
        const glm::vec3 towards = c == 0 ? l.right : c == 1 ? l.up() : c == 2 ? -l.right : -l.up();
        s.lights[0].position = glm::vec3(0, 2, 0) - side * towards;
        EXPECT_NEAR(floor_lx(s) / (1.5 * (700.0 + 50.0 * c) / d2 * 2.0 / std::sqrt(d2)), 1.0, 0.005) << c;
    }
    s.lights[0].position = {0, 2, 0};
    s.lights[0].direction = {0, 1, 0};
    EXPECT_EQ(floor_lx(s), 0.0) << "turned over";
}

TEST(Lights, WhatLeavesAShapeIsItsLuminousPower) {
    using namespace shading;
    const auto expect = [](const scene::Light& l, float lm) {
        const Power p = power_of(l, 1.0f);
        EXPECT_NEAR(p.drawn_lm / static_cast<double>(lm), 1.0, 0.005) << scene::name_of(l.type);
        EXPECT_NEAR(p.met_lm / static_cast<double>(lm), 1.0, 0.02) << scene::name_of(l.type);
    };
    scene::Light l = light_of(LightType::sphere, {1, 2, 3}, {1, 2, -1});
    expect(l, sphere_lm_from_nit(l.intensity, l.radius_m));
    l.type = LightType::tube;
    expect(l, tube_lm_from_nit(l.intensity, l.radius_m, 2.0f * l.half_width_m));
    for (const float sides : {1.0f, 2.0f}) {
        l.two_sided = sides > 1.0f;
        l.type = LightType::disk;
        expect(l, sides * disk_lm_from_nit(l.intensity, l.radius_m));
        l.type = LightType::rectangle;
        expect(l, sides * rectangle_lm_from_nit(l.intensity, 2.0f * l.half_width_m, 2.0f * l.half_height_m));
    }
}

TEST(Lights, ARectangleIsAnEmissiveMeshOfItsSize) {
    scene::Material glossy;
    glossy.base_color = glm::vec4(0.6f, 0.5f, 0.4f, 1.0f);
    glossy.metallic = 0.5f;
    glossy.perceptual_roughness = 0.35f;
    scene::Light l = light_of(LightType::rectangle, {-1.5f, 1.0f, 0});
    l.half_width_m = l.half_height_m = 0.5f;
    const scene::Scene light = floor_under({l}, glossy);
    scene::Scene mesh = floor_under({}, glossy);
    place(mesh, flat_square(0.5f, l.position, false), lamp(1000.0f));
    const auto seen = [&](const scene::Scene& s) {
        return mean_luminance(s, spot_meter({2.5f, 1.4f, 0.0f}), path_options(true), 2048);
    };
    const glm::dvec3 a = seen(light);
    const glm::dvec3 b = seen(mesh);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c] / b[c], 1.0, 0.005) << c;
}

TEST(Lights, AThousandOfAllKindsGiveWhatTheyGiveOneByOne) {
    constexpr std::array kinds{LightType::point,  LightType::spot, LightType::frustum,   LightType::line,
                               LightType::sphere, LightType::disk, LightType::rectangle, LightType::tube};
    std::vector<scene::Light> lights;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const auto u = [&](std::uint32_t use) { return shading::unit_float(shading::hash_combine(i, use)); };
        const glm::vec3 way(u(0) - 0.5f, -u(1), u(2) - 0.5f);
        scene::Light l =
            light_of(kinds[i % kinds.size()], {12 * u(3) - 6, 0.3f + 3 * u(4), 12 * u(5) - 6}, way);
        l.intensity = 10.0f + 1000.0f * u(6) * u(7) * u(8);
        l.radius_m = 0.02f + 0.1f * u(9);
        l.half_width_m = 0.02f + 0.2f * u(10);
        l.half_height_m = 0.02f + 0.2f * u(11);
        l.two_sided = i % 3 == 0;
        if (i % 5 == 0) l.range_m = 0.5f + 4.0f * u(12);
        lights.push_back(l);
    }
    const scene::Scene all = floor_under(lights);
    double expected = 0.0;
    for (const scene::Light& l : lights) {
        const scene::Scene one = floor_under({l});
        const truth::Geometry geometry(one);
        const truth::SurfaceReader surfaces(one, geometry);
        const truth::LightSampler sampler(one, geometry, surfaces);
        for (unsigned i = 0; i < 64; ++i) {
            const truth::LightSample s = sampler.sample_near({}, {0, 1, 0}, 0.5f, shading::hammersley(i, 64));
            if (s.pdf > 0.0f)
                expected += static_cast<double>(s.light.y * std::max(s.direction.y, 0.0f) / s.pdf) / 64.0;
        }
    }
    EXPECT_NEAR(floor_lx(all, truth::Draws::all, 2048) / expected, 1.0, 0.01);
    EXPECT_NEAR(floor_lx(all, truth::Draws::lights, 2048) / expected, 1.0, 0.01);
}
