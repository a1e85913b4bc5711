#include <gtest/gtest.h>

#include "render_scenes.hpp"
#include "shading/exposure.glsl"

using namespace candela;
using namespace candela::test;

namespace {

constexpr float kPi = 3.14159265f;

/// Renders with validation on and expects it to be silent.
realtime::Still render(const scene::Scene& scene, const scene::Camera& camera,
                       const scene::Exposure& exposure, const realtime::RendererOptions& renderer_options) {
    const gpu::Device device{validated()};
    realtime::Still still;
    {
        realtime::Renderer renderer(device, scene, renderer_options);
        still = renderer.render_still(camera, exposure);
    }
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    return still;
}

const scene::Camera kFront = scene::look_at({0, 0, 2}, {0, 0, 0}, 0.6f);

}  // namespace

// L = E * albedo / pi for a Lambert surface under a perpendicular sun, in absolute cd/m^2.
TEST(Light, AGreyPlaneUnderTenThousandLuxReadsItsLuminance) {
    scene::Scene s = scene_of(square(2.0f), grey(0.5f));
    s.lights.push_back(sun(10000.0f));
    const realtime::Still still = render(s, kFront, fixed_ev(12.0f), options("ue4"));
    const float expected_nit = 10000.0f * 0.5f / kPi;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(center(still)[c], expected_nit, 0.005f * expected_nit);
}

TEST(Light, ThePictureDoesNotDependOnTheExposureItWasTakenWith) {
    scene::Scene s = scene_of(square(2.0f), grey(0.5f));
    s.lights.push_back(sun(10000.0f));
    for (const float ev100 : {4.0f, 12.0f, 20.0f}) {
        const realtime::Still still = render(s, kFront, fixed_ev(ev100), options("ue4"));
        EXPECT_NEAR(center(still).x, 5000.0f / kPi, 0.005f * 5000.0f / kPi) << "EV100 " << ev100;
    }
}

TEST(Light, APointLightFollowsTheInverseSquareAndItsWindow) {
    scene::Scene s = scene_of(square(3.0f), grey(0.5f));
    scene::Light lamp;
    lamp.type = scene::LightType::point;
    lamp.intensity = 100.0f;
    for (const float distance_m : {0.5f, 1.0f, 1.9f}) {
        lamp.position = {0, 0, distance_m};
        s.lights = {lamp};
        const float expected_nit = 100.0f / (distance_m * distance_m) * 0.5f / kPi;
        EXPECT_NEAR(center(render(s, kFront, fixed_ev(5.0f), options("ue4"))).x, expected_nit,
                    0.01f * expected_nit);
    }
    lamp.position = {0, 0, 1.0f};
    lamp.range_m = 1.0f;
    s.lights = {lamp};
    EXPECT_EQ(center(render(s, kFront, fixed_ev(5.0f), options("ue4"))).x, 0.0f)
        << "nothing arrives at the range";
}

TEST(Light, ASpotIsDarkOutsideItsOuterConeAndFullInside) {
    scene::Scene s = scene_of(square(3.0f), grey(0.5f));
    scene::Light lamp;
    lamp.type = scene::LightType::spot;
    lamp.position = {0, 0, 1};
    lamp.intensity = 100.0f;
    lamp.inner_cone_rad = 0.1f;
    lamp.outer_cone_rad = 0.2f;
    s.lights = {lamp};
    const realtime::Still still = render(s, kFront, fixed_ev(5.0f), options("ue4", 64));
    EXPECT_NEAR(center(still).x, 100.0f * 0.5f / kPi, 0.01f * 50.0f / kPi);
    EXPECT_EQ(still.planes.light_nit.front().x, 0.0f);
}

// Frostbite 5.1.4: the card's luminance is E * 0.18 / pi; f/16, 1/125 s, ISO 100 saturate at 78/(100 q)
// N^2/t.
TEST(Light, Sunny16ExposesAGreyCardToBetweenATenthAndAFifthOfSaturation) {
    scene::Scene s = scene_of(square(2.0f), grey(0.18f));
    s.lights.push_back(sun(100000.0f));
    s.environment = constant(20000.0f / kPi);
    scene::Exposure camera;
    camera.aperture_f = 16.0f;
    camera.shutter_s = 1.0f / 125.0f;
    camera.iso = 100.0f;
    realtime::RendererOptions o = options("ue4");
    o.profile.exposure = realtime::ExposureTechnique::saturation;
    const realtime::Still still = render(s, kFront, camera, o);
    const float expected_nit = 120000.0f * 0.18f / kPi;
    EXPECT_NEAR(center(still).x, expected_nit, 0.01f * expected_nit);
    EXPECT_NEAR(still.ev100, 14.97f, 0.01f);
    const float saturation = center(still).x * still.exposure;
    EXPECT_NEAR(saturation, expected_nit / (78.0f / 65.0f * 256.0f * 125.0f), 0.01f);
    EXPECT_GT(saturation, 0.10f);
    EXPECT_LT(saturation, 0.20f);
}

TEST(Light, TheMeterPutsAUniformSceneWhereASpotMeterWould) {
    scene::Scene s = scene_of(square(5.0f), grey(0.5f));
    for (const float lux : {1.0f, 1000.0f, 100000.0f}) {
        s.lights = {sun(lux)};
        const realtime::Still still = render(s, kFront, {}, options("ue4"));
        const float nit = lux * 0.5f / kPi;
        EXPECT_TRUE(still.metered);
        EXPECT_NEAR(still.ev100, std::log2(nit * 100.0f / 12.5f), 0.1f) << lux << " lx";
    }
}

TEST(Light, CompensationBrightensByStops) {
    scene::Scene s = scene_of(square(5.0f), grey(0.5f));
    s.lights = {sun(1000.0f)};
    scene::Exposure plus;
    plus.compensation_ev = 2.0f;
    const float base = render(s, kFront, {}, options("ue4")).exposure;
    EXPECT_NEAR(render(s, kFront, plus, options("ue4")).exposure / base, 4.0f, 0.01f);
}

TEST(Light, ASunInTheMapBeyondHalfRangeSurvivesAsBackground) {
    scene::Scene s = scene_of(square(0.01f), grey(0.5f));
    s.environment = constant(1000.0f);
    for (glm::vec3& texel : s.environment->luminance_nit) texel = glm::vec3(1.6e9f);
    for (const float ev100 : {15.0f, 0.0f}) {
        const realtime::Still still =
            render(s, scene::look_at({0, 0, 2}, {0, 0, 4}, 0.6f), fixed_ev(ev100), options("best"));
        EXPECT_NEAR(center(still).x / 1.6e9f, 1.0f, 0.002f) << ev100;
    }
}

TEST(Light, AnEmptySceneIsItsEnvironment) {
    scene::Scene s;
    s.environment = constant(321.0f);
    const realtime::Still still = render(s, kFront, {}, options("best"));
    EXPECT_NEAR(center(still).x, 321.0f, 1.0f);
    scene::Scene dark;
    const realtime::Still black = render(dark, kFront, {}, options("best"));
    EXPECT_EQ(center(black).x, 0.0f);
    EXPECT_FALSE(black.metered);
}
