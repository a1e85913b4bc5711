// bake::sky_of: what a clear sky and its sun give.
#include "candela/bake/sky.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "candela/bake/environment.hpp"
#include "candela/measure/sky_truth.hpp"
#include "shading/environment.glsl"

namespace {

using namespace candela;
using namespace candela::shading;

scene::SkySettings sky(float elevation_deg, float turbidity = 2.5f) {
    scene::SkySettings s;
    s.elevation_deg = elevation_deg;
    s.turbidity = turbidity;
    return s;
}

float sun_lx(const scene::SkySettings& s) {
    return luminance(bake::SkyModel(s).sun_rec709_lx());
}
float sky_lx(const scene::SkySettings& s) {
    return bake::upward_illuminance_lx(bake::sky_of(s, 64).environment);
}

/// Kelvin of the black body nearest in CIE 1960 u, v.
float correlated_temperature(const vec3& rec709) {
    const auto uv = [](float x, float y) { return vec2(4.0f * x, 6.0f * y) / (12.0f * y - 2.0f * x + 3.0f); };
    const vec3 xyz = glm::inverse(mat3(rec709_from_xyz(vec3(1, 0, 0)), rec709_from_xyz(vec3(0, 1, 0)),
                                       rec709_from_xyz(vec3(0, 0, 1)))) *
                     rec709;
    const vec2 at = uv(xyz.x / (xyz.x + xyz.y + xyz.z), xyz.y / (xyz.x + xyz.y + xyz.z));
    float best = 0.0f, nearest = 1e9f;
    for (float kelvin = 1500.0f; kelvin < 100000.0f; kelvin *= 1.01f) {
        const vec2 body = black_body_xy(kelvin);
        const float d = glm::length(at - uv(body.x, body.y));
        if (d < nearest) best = kelvin, nearest = d;
    }
    return best;
}

TEST(Sky, TheSunIsWeakerThroughMoreAirAndMoreAerosol) {
    float before = 1e9f;
    for (const float elevation : {90.0f, 60.0f, 30.0f, 15.0f, 5.0f, 1.0f}) {
        const float lx = sun_lx(sky(elevation));
        EXPECT_LT(lx, before) << elevation;
        before = lx;
    }
    before = 1e9f;
    for (const float turbidity : {1.0f, 1.5f, 2.0f, 3.0f, 6.0f, 10.0f}) {
        const float lx = sun_lx(sky(40.0f, turbidity));
        EXPECT_LT(lx, before) << turbidity;
        before = lx;
    }
}

TEST(Sky, OnTopOfTheAirTheSkyIsBlackAndTheSunTheSolarConstant) {
    scene::SkySettings s = sky(40.0f);
    s.altitude_m = 99000.0f;
    const bake::SkyModel model(s);
    vec3 constant(0.0f);
    for (const vec3& band : model.air().rec709_lx) constant += band;
    EXPECT_NEAR(luminance(model.sun_rec709_lx()) / luminance(constant), 1.0f, 1e-3f);
    EXPECT_LT(luminance(model.luminance_nit(0.5f * PI, 0.0f)), 0.1f);
}

TEST(Sky, ItIsSymmetricAboutTheSunAndTheMapIsTurnedToIt) {
    scene::SkySettings s = sky(20.0f);
    const bake::SkyModel model(s);
    for (const float azimuth : {0.3f, 1.5f, 2.8f})
        EXPECT_EQ(model.luminance_nit(0.4f, azimuth), model.luminance_nit(0.4f, -azimuth));
    s.azimuth_deg = 70.0f;
    const bake::Sky found = bake::sky_of(s, 128);
    const auto& e = found.environment;
    const auto brightest =
        std::max_element(e.luminance_nit.begin(), e.luminance_nit.end(),
                         [](const vec3& a, const vec3& b) { return luminance(a) < luminance(b); }) -
        e.luminance_nit.begin();
    const auto x = std::uint32_t(brightest) % e.width, y = std::uint32_t(brightest) / e.width;
    const vec3 d =
        equirect_direction({(float(x) + 0.5f) / float(e.width), (float(y) + 0.5f) / float(e.height)});
    ASSERT_TRUE(found.sun);
    // Under the sun: the haze at the horizon may be brighter than the sky about it.
    const vec3 level = glm::normalize(vec3(d.x, 0.0f, d.z));
    const vec3 sun_level = glm::normalize(vec3(found.sun->direction.x, 0.0f, found.sun->direction.z));
    EXPECT_GT(glm::dot(level, -sun_level), std::cos(0.05f));
    EXPECT_GT(d.y, 0.0f);
    EXPECT_NEAR(found.sun->direction.x, -std::cos(0.34907f) * std::sin(1.22173f), 1e-4f);
}

TEST(Sky, TheMapHasTheIlluminanceOfTheModelIntegratedDirectly) {
    for (const float elevation : {50.0f, 5.0f, -4.0f}) {
        const bake::SkyModel model(sky(elevation));
        constexpr int rows = 48, columns = 24;
        double lx = 0.0;
        for (int i = 0; i < rows; ++i) {
            const float height = 0.5f * PI * square((float(i) + 0.5f) / rows);
            const double step = M_PI * (double(i) + 0.5) / rows / rows;
            for (int j = 0; j < columns; ++j)
                lx += double(luminance(model.luminance_nit(height, PI * (float(j) + 0.5f) / columns))) *
                      std::sin(double(height)) * std::cos(double(height)) * step * 2.0 * M_PI / columns;
        }
        const float map = bake::upward_illuminance_lx(bake::sky_of(sky(elevation), 256).environment);
        EXPECT_NEAR(map / lx, 1.0, 0.01) << elevation;
    }
}

TEST(Sky, GroundBrightensTheSkyAndIsItselfLit) {
    scene::SkySettings dark = sky(40.0f), bright = sky(40.0f);
    dark.ground_albedo = 0.0f;
    bright.ground_albedo = 0.8f;
    EXPECT_GT(sky_lx(bright), 1.1f * sky_lx(dark));
    // Straight down from 2 m: what a Lambertian shows under sun and sky.
    const bake::SkyModel model(bright);
    const float lx = sky_lx(bright) + sun_lx(bright) * std::sin(40.0f * PI / 180.0f);
    EXPECT_NEAR(luminance(model.luminance_nit(-0.5f * PI, 0.0f)) / (0.8f * lx * INV_PI), 1.0f, 0.06f);
    EXPECT_LT(luminance(bake::SkyModel(dark).luminance_nit(-0.5f * PI, 0.0f)), 10.0f);
}

TEST(Sky, TheZenithIsBlueAndALowSunRed) {
    EXPECT_GT(correlated_temperature(bake::SkyModel(sky(40.0f, 2.0f)).luminance_nit(0.5f * PI, 0.0f)),
              9000.0f);
    float before = 1e9f;
    for (const float elevation : {90.0f, 40.0f, 20.0f, 10.0f, 5.0f}) {
        const float kelvin = correlated_temperature(bake::SkyModel(sky(elevation)).sun_rec709_lx());
        EXPECT_LT(kelvin, before) << elevation;
        before = kelvin;
    }
    EXPECT_LT(before, 3000.0f);
    const float noon = correlated_temperature(bake::SkyModel(sky(60.0f)).sun_rec709_lx());
    EXPECT_GT(noon, 4800.0f);
    EXPECT_LT(noon, 5900.0f);
}

TEST(Sky, TwilightFadesWithoutEnd) {
    float before = 1e9f;
    for (const float elevation :
         {10.0f, 3.0f, 0.2f, 0.0f, -0.2f, -1.0f, -3.0f, -6.0f, -9.0f, -12.0f, -18.0f}) {
        const bake::Sky found = bake::sky_of(sky(elevation), 64);
        for (const vec3& t : found.environment.luminance_nit)
            ASSERT_TRUE(std::isfinite(t.x + t.y + t.z) && min(t.x, min(t.y, t.z)) >= 0.0f) << elevation;
        const float lx = bake::upward_illuminance_lx(found.environment);
        EXPECT_LT(lx, before) << elevation;
        before = lx;
        EXPECT_EQ(found.sun.has_value(), elevation > -0.27f) << elevation;
    }
    // Glossary of Meteorology (AMS): civil twilight goes from 585-410 lx, as the sun's edge is seen to set,
    // to 3.5-2 lx.
    EXPECT_GT(sky_lx(sky(-0.83f)), 350.0f);
    EXPECT_LT(sky_lx(sky(-0.83f)), 700.0f);
    EXPECT_GT(sky_lx(sky(-6.0f)), 2.0f);
    EXPECT_LT(sky_lx(sky(-6.0f)), 4.0f);
    for (const float elevation : {-40.0f, -90.0f}) {
        const float night = sky_lx(sky(elevation));
        EXPECT_TRUE(night >= 0.0f && night < 1e-3f) << elevation;
    }
}

TEST(Sky, ExtremeSettingsAreFinite) {
    for (const float turbidity : {1.0f, 10.0f}) {
        for (const float albedo : {0.0f, 1.0f}) {
            for (const float altitude : {0.0f, 99000.0f}) {
                for (const float elevation : {90.0f, 0.0f}) {
                    scene::SkySettings s = sky(elevation, turbidity);
                    s.ground_albedo = albedo;
                    s.altitude_m = altitude;
                    s.ozone_du = altitude > 0.0f ? 1000.0f : 0.0f;
                    for (const vec3& t : bake::sky_of(s, 16).environment.luminance_nit)
                        ASSERT_TRUE(std::isfinite(t.x + t.y + t.z) && min(t.x, min(t.y, t.z)) >= 0.0f)
                            << turbidity << " " << albedo << " " << altitude << " " << elevation;
                }
            }
        }
    }
}

TEST(Sky, ItIsThatOfRandomWalksThroughTheSameAir) {
    for (const auto& [elevation, turbidity, allowed] :
         {std::tuple{50.0f, 1.0f, 0.02}, std::tuple{10.0f, 1.0f, 0.03}, std::tuple{50.0f, 3.0f, 0.03},
          std::tuple{10.0f, 3.0f, 0.04}}) {
        const scene::SkySettings s = sky(elevation, turbidity);
        const measure::SkyEstimate truth = measure::sky_illuminance_truth(bake::SkyModel(s), 60000, 7);
        EXPECT_NEAR(double(sky_lx(s)) / truth.value, 1.0, allowed + 3.0 * truth.standard_error / truth.value)
            << elevation << " degrees, turbidity " << turbidity;
    }
}

/// Even scattering of all light but the first would be 20 % too dark below the sun and too bright opposite.
TEST(Sky, HazeIsBrighterBelowTheSunAsInRandomWalks) {
    const bake::SkyModel model(sky(20.0f, 3.0f));
    for (const double azimuth : {0.0, M_PI}) {
        const measure::SkyEstimate truth = measure::sky_luminance_truth(model, 0.1, azimuth, 20000, 3);
        const double nit = double(luminance(model.luminance_nit(0.1f, float(azimuth))));
        EXPECT_NEAR(nit / truth.value, 1.0, 0.08 + 3.0 * truth.standard_error / truth.value) << azimuth;
    }
}

TEST(Sky, ItsSunFollowsTheEnvironment) {
    bake::Sky found = bake::sky_of(sky(30.0f), 16);
    ASSERT_TRUE(found.sun);
    scene::Light sun = *found.sun;
    found.environment.rotation_rad = 0.5f * PI;
    found.environment.scale = 0.5f;
    found.environment.visible = false;
    bake::follow_environment(sun, found.environment);
    EXPECT_NEAR(sun.intensity, 0.5f * found.sun->intensity, 1.0f);
    EXPECT_FALSE(sun.visible);
    const vec3 turned = rotate_about_y(found.sun->direction, 0.5f * PI);
    EXPECT_NEAR(glm::length(sun.direction - turned), 0.0f, 1e-5f);
    EXPECT_NEAR(glm::dot(sun.direction, sun.right), 0.0f, 1e-5f);
}

}  // namespace
