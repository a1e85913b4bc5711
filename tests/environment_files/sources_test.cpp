#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "candela/scene/environment_sources.hpp"
#include "shading/language.glsl"
#include "sky_of_directions.hpp"

namespace candela::test {
namespace {

constexpr double kPi = std::numbers::pi;

double luminous(const glm::dvec3& v) {
    return 0.2126 * v.x + 0.7152 * v.y + 0.0722 * v.z;
}

glm::vec3 direction_of(double elevation_deg, double azimuth_deg) {
    const double e = elevation_deg * kPi / 180.0, a = azimuth_deg * kPi / 180.0;
    return {float(std::cos(e) * std::sin(a)), float(std::sin(e)), float(-std::cos(e) * std::cos(a))};
}

/// Each texel the mean of the sky over a grid inside it.
scene::Environment picture_of(std::uint32_t height, const Sky& sky) {
    constexpr int grid = 4;
    scene::Environment out;
    out.name = "test";
    out.width = 2 * height;
    out.height = height;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < out.width; ++x) {
            glm::vec3 sum(0.0f);
            for (int v = 0; v < grid; ++v) {
                for (int u = 0; u < grid; ++u)
                    sum += sky(direction_of(90.0 - 180.0 * (y + (v + 0.5) / grid) / height,
                                            360.0 * (x + (u + 0.5) / grid) / out.width - 180.0));
            }
            out.luminance_nit.push_back(sum / float(grid * grid));
        }
    }
    return out;
}

/// A clear sky brighter towards its horizon, over dark ground.
glm::vec3 clear_sky(const glm::vec3& d) {
    return d.y > 0 ? glm::vec3(3000, 4000, 6000) * (1.0f - 0.5f * d.y) : glm::vec3(800, 700, 500);
}

Sky with_disc(const Sky& sky, const glm::vec3& middle, double radius_deg, const glm::vec3& nit) {
    const auto edge = float(std::cos(radius_deg * kPi / 180.0));
    return [=](const glm::vec3& d) { return glm::dot(d, middle) > edge ? nit : sky(d); };
}

TEST(Split, ASunKeepsItsPlaceSizeColorAndLight) {
    for (const auto& [elevation, azimuth] :
         {std::pair{35.0, 20.0}, std::pair{8.0, 179.9}, std::pair{89.5, 0.0}, std::pair{60.0, -100.0}}) {
        const glm::vec3 sun = direction_of(elevation, azimuth);
        const double radius_deg = 0.8;
        const glm::vec3 nit(4e8f, 3.6e8f, 3e8f);
        scene::Scene scene;
        scene.environment = picture_of(512, with_disc(clear_sky, sun, radius_deg, nit));
        const glm::dvec3 before = light_of(*scene.environment);
        const double upward_before = scene::upward_illuminance_lx(*scene.environment);
        ASSERT_TRUE(scene::split_sun(scene)) << elevation;
        ASSERT_EQ(scene.lights.size(), 1u);
        const scene::Light& light = scene.lights[0];
        EXPECT_EQ(light.type, scene::LightType::sun);
        EXPECT_TRUE(light.casts_shadow);
        EXPECT_GT(glm::dot(-light.direction, sun), std::cos(0.1 * kPi / 180.0)) << elevation;
        EXPECT_NEAR(light.angular_diameter_rad, 2.0 * radius_deg * kPi / 180.0,
                    0.04 * radius_deg * kPi / 180.0);
        const double solid_angle = 2.0 * kPi * (1.0 - std::cos(0.5 * double{light.angular_diameter_rad}));
        EXPECT_NEAR(double{light.intensity} / solid_angle / luminous(glm::dvec3(nit)), 1.0, 0.03)
            << "luminance";
        EXPECT_NEAR(light.color.x / light.color.y, nit.x / nit.y, 1e-3f);
        EXPECT_NEAR(light.color.z / light.color.y, nit.z / nit.y, 1e-3f);
        const glm::dvec3 after =
            light_of(*scene.environment) + glm::dvec3(light.color) * double{light.intensity};
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(after[c] / before[c], 1.0, 1e-5) << "no light is lost or made";
        const double upward_after = scene::upward_illuminance_lx(*scene.environment) +
                                    double{light.intensity} * std::max(double{-light.direction.y}, 0.0);
        EXPECT_NEAR(upward_after / upward_before, 1.0, 5e-3);
        EXPECT_NEAR(seen(*scene.environment, sun).y / clear_sky(sun).y, 1.0, 0.15)
            << "the hole is filled from its surroundings";
        EXPECT_FALSE(scene::split_sun(scene)) << "there is no second one";
    }
}

TEST(Split, ASunOfOneTexelInADimSkyIsFound) {
    scene::Environment e = picture_of(64, [](const glm::vec3&) { return glm::vec3(50.0f); });
    e.luminance_nit[std::size_t{20} * e.width + 30] = glm::vec3(1.6e9f);
    const double texel = std::cos(kPi * 20 / 64) - std::cos(kPi * 21 / 64);
    const auto sun = scene::find_sun(e);
    ASSERT_TRUE(sun);
    EXPECT_NEAR(sun->solid_angle_sr, texel * 2.0 * kPi / 128, 1e-6);
    EXPECT_NEAR(luminous(sun->illuminance_lx) / (1.6e9 * sun->solid_angle_sr), 1.0, 1e-5);
}

TEST(Split, RotationScaleAndVisibilityGoWithTheSun) {
    scene::Scene scene;
    scene.environment = picture_of(256, with_disc(clear_sky, direction_of(40, 0), 0.8, glm::vec3(1e8f)));
    const auto plain = scene::find_sun(*scene.environment);
    ASSERT_TRUE(plain);
    scene.environment->scale = 0.5f;
    scene.environment->rotation_rad = float(0.5 * kPi);  // counter-clockwise from above: from -Z to -X
    scene.environment->visible = false;
    ASSERT_TRUE(scene::split_sun(scene));
    const scene::Light& light = scene.lights[0];
    EXPECT_GT(glm::dot(-light.direction, direction_of(40, -90)), 0.99999f);
    EXPECT_NEAR(double{light.intensity}, 0.5 * luminous(plain->illuminance_lx),
                1e-3 * double{light.intensity});
    EXPECT_FALSE(light.visible);
    EXPECT_NEAR(glm::dot(light.right, light.direction), 0.0f, 1e-6f);
}

TEST(Split, WhatIsNoSunStays) {
    const auto has_sun = [](const Sky& sky) { return scene::find_sun(picture_of(256, sky)).has_value(); };
    EXPECT_FALSE(has_sun(clear_sky));
    EXPECT_FALSE(has_sun(with_disc(clear_sky, direction_of(40, 0), 12.0, glm::vec3(2e5f)))) << "a soft box";
    EXPECT_FALSE(has_sun(with_disc(clear_sky, direction_of(40, 0), 4.0, glm::vec3(1e7f))))
        << "too wide for a sun";
    EXPECT_FALSE(has_sun(with_disc(clear_sky, direction_of(40, 0), 0.5, glm::vec3(5e5f))))
        << "too weak to matter";
    EXPECT_FALSE(has_sun(with_disc(clear_sky, direction_of(-60, 0), 0.5, glm::vec3(1e9f))))
        << "below the horizon";
    EXPECT_FALSE(has_sun([](const glm::vec3& d) {  // an aureole without a disc
        return clear_sky(d) +
               glm::vec3(2e6f) * float(std::exp(-50.0 * (1.0 - double{glm::dot(d, direction_of(40, 0))})));
    }));
}

TEST(Split, ATexelOfACoarsePictureIsAPartOfTheSkyAndNoSun) {
    scene::Environment e = picture_of(4, [](const glm::vec3&) { return glm::vec3(10.0f); });
    e.luminance_nit[3] = glm::vec3(1e7f);
    EXPECT_TRUE(scene::find_sources(e).empty());
    e = picture_of(1, [](const glm::vec3&) { return glm::vec3(10.0f); });
    e.luminance_nit[0] = glm::vec3(1e7f);
    EXPECT_TRUE(scene::find_sources(e).empty());
    e.luminance_nit.assign(2, glm::vec3(0.0f));
    EXPECT_TRUE(scene::find_sources(e).empty());
    EXPECT_EQ(scene::statistics_of(e).peak_nit, 0.0);
}

TEST(Split, LampsAreTakenOutTogetherAndTheLightStays) {
    Sky room = [](const glm::vec3&) { return glm::vec3(20.0f); };
    room = with_disc(room, direction_of(50, 30), 2.0, glm::vec3(40000, 30000, 15000));
    room = with_disc(room, direction_of(50, -60), 1.5, glm::vec3(20000, 25000, 40000));
    room = with_disc(room, direction_of(20, 150), 25.0, glm::vec3(400.0f));  // a window: stays
    scene::Environment e = picture_of(256, room);
    const glm::dvec3 before = light_of(e);
    const auto sources = scene::find_sources(e);
    ASSERT_EQ(sources.size(), 2u);
    EXPECT_GT(glm::dot(sources[0].direction, direction_of(50, 30)), 0.9999f);
    EXPECT_NEAR(sources[1].half_angle_rad(), 1.5 * kPi / 180.0, 0.1 * kPi / 180.0);
    glm::dvec3 after(0.0);
    for (const scene::Light& light : scene::take_out(e, sources))
        after += glm::dvec3(light.color) * double{light.intensity};
    after += light_of(e);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c] / before[c], 1.0, 1e-5);
    EXPECT_NEAR(seen(e, direction_of(50, 30)).x, 20.0f, 0.5f);
    EXPECT_NEAR(seen(e, direction_of(20, 150)).x, 400.0f, 1.0f);
}

TEST(Statistics, AUniformSkyAndAKnownPeak) {
    const scene::EnvironmentStatistics even =
        scene::statistics_of(picture_of(64, [](const glm::vec3&) { return glm::vec3(2000.0f); }));
    EXPECT_NEAR(even.upward_lx, 2000.0 * kPi, 0.1);
    EXPECT_NEAR(even.downward_lx, 2000.0 * kPi, 0.1);
    EXPECT_NEAR(even.mean_luminance_nit, 2000.0, 0.01);
    for (const double p : even.percentiles_nit) EXPECT_NEAR(p, 2000.0, 0.01);
    // Bright over the upper 30 % of the sphere: cos(theta) > 0.4.
    scene::Environment cap =
        picture_of(256, [](const glm::vec3& d) { return glm::vec3(d.y > 0.4f ? 100.0f : 1.0f); });
    cap.scale = 2.0f;
    const scene::EnvironmentStatistics s = scene::statistics_of(cap);
    EXPECT_NEAR(s.upward_lx, 2.0 * kPi * (100.0 * (1.0 - 0.16) + 0.16), 2.0);
    EXPECT_NEAR(s.percentiles_nit[2], 2.0, 1e-5);
    EXPECT_NEAR(s.percentiles_nit[3], 200.0, 1e-4);
    EXPECT_NEAR(s.peak_nit, 200.0, 1e-4);
    EXPECT_NEAR(s.peak_solid_angle_sr, 2.0 * kPi * 0.6, 0.05);
}

// Against a sort of all texels, on a picture whose luminance spans many powers of two and repeats.
TEST(Statistics, PercentilesAreThoseOfSortedTexels) {
    scene::Environment e;
    e.width = 64;
    e.height = 32;
    std::uint32_t state = 1;
    for (std::uint32_t i = 0; i < e.width * e.height; ++i) {
        state = state * 1664525u + 1013904223u;
        e.luminance_nit.emplace_back(std::ldexp(float(state >> 20), int(state % 40) - 20) * float(i % 7));
    }
    std::vector<std::pair<float, double>> texels;
    double all_sr = 0.0;
    for (std::uint32_t i = 0; i < e.width * e.height; ++i) {
        const double top = M_PI * (i / e.width) / e.height, bottom = M_PI * (i / e.width + 1.0) / e.height;
        const double solid_angle = 2.0 * M_PI / e.width * (std::cos(top) - std::cos(bottom));
        texels.emplace_back(shading::luminance(e.luminance_nit[i]), solid_angle);
        all_sr += solid_angle;
    }
    EXPECT_NEAR(all_sr, 4.0 * M_PI, 1e-9);
    std::sort(texels.begin(), texels.end());
    const scene::EnvironmentStatistics s = scene::statistics_of(e);
    for (std::size_t p = 0; p < s.percentiles_nit.size(); ++p) {
        double below_sr = 0.0;
        std::size_t i = 0;
        while (below_sr + texels[i].second < scene::kPercentiles[p] / 100.0 * all_sr)
            below_sr += texels[i++].second;
        EXPECT_NEAR(s.percentiles_nit[p], double(texels[i].first), 1e-6 * double(texels[i].first)) << p;
    }
}

}  // namespace
}  // namespace candela::test
