#include "sky.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "shading/environment.glsl"
#include "shading/exposure.glsl"

namespace candela::scenes {
namespace {

const glm::vec3 to_sun = glm::normalize(glm::vec3(0.3f, 0.7f, 0.5f));

TEST(Sky, GivesTheIlluminancesAskedFor) {
    const Panorama sky = outdoor_sky({to_sun, 20000.0f, 0.0f, 90000.0f, 0.2f});
    EXPECT_NEAR(sky.illuminance_lx({0, 1, 0}), 20000.0f, 5.0f);
    EXPECT_NEAR(sky.illuminance_lx({0, -1, 0}), 0.2f * 90000.0f, 1500.0f);  // Lambertian ground; tinted
    const Panorama with_sun = outdoor_sky({to_sun, 20000.0f, 100000.0f, 90000.0f, 0.2f});
    EXPECT_NEAR(with_sun.illuminance_lx(to_sun) - sky.illuminance_lx(to_sun), 100000.0f, 50.0f);
    EXPECT_NEAR(soft_box_studio(500.0f).illuminance_lx({0, 1, 0}), 500.0f, 0.1f);
}

TEST(Sky, TheSunIsWhereTheEnvironmentMappingLooksForIt) {
    const Panorama sky = outdoor_sky({to_sun, 20000.0f, 100000.0f, 0.0f, 0.2f});
    const auto brightest = std::max_element(sky.luminance_nit.begin(), sky.luminance_nit.end(),
                                            [](const auto& a, const auto& b) { return a.y < b.y; });
    const auto index = static_cast<std::uint32_t>(brightest - sky.luminance_nit.begin());
    EXPECT_GT(glm::dot(sky.direction(index % sky.width, index / sky.width), to_sun), 0.9996f);
    EXPECT_GT(brightest->y, 65504.0f) << "the demo is meant to exceed half range";
    const glm::vec2 uv = shading::equirect_uv(to_sun);
    const auto column = static_cast<std::uint32_t>(uv.x * 512.0f),
               row = static_cast<std::uint32_t>(uv.y * 256.0f);
    EXPECT_GT(sky.luminance_nit[row * 512 + column].y, 1e6f);
}

TEST(Sky, ZenithIsBluerThanTheHorizonAndSunny16DoesNotClipIt) {
    const Panorama sky = outdoor_sky({to_sun, 20000.0f, 0.0f, 90000.0f, 0.2f});
    const glm::vec3 zenith = sky.luminance_nit[0], horizon = sky.luminance_nit[120 * 512 + 100];
    EXPECT_GT(zenith.z / zenith.x, horizon.z / horizon.x);
    const float saturation =
        shading::max_luminance_from_ev100(shading::ev100_from_camera(16.0f, 1.0f / 125.0f, 100.0f));
    for (const glm::vec3& texel : sky.luminance_nit) {
        EXPECT_LT(shading::luminance(texel), saturation);
        EXPECT_GE(std::min({texel.x, texel.y, texel.z}), 0.0f);
    }
}

}  // namespace
}  // namespace candela::scenes
