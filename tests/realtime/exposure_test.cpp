// The light buffer's range and the automatic exposure on the device; unlit surfaces under both.
#include "shading/exposure.glsl"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "render_scenes.hpp"
#include "shading/tone_curves.glsl"
#include "shading/transfer.glsl"

using namespace candela;
using namespace candela::test;

namespace {

constexpr float kPi = 3.14159265f;
const scene::Camera kFront = scene::look_at({0, 0, 2}, {0, 0, 0}, 0.6f);

realtime::Still render(const scene::Scene& s, const scene::Exposure& exposure = {},
                       realtime::RendererOptions o = options("best")) {
    static const gpu::Device device(validated());
    o.shadows.maps = false;
    realtime::Renderer renderer(device, s, o);
    realtime::Still still = renderer.render_still(kFront, exposure);
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    return still;
}

scene::Scene plane_of(float nit) {
    scene::Scene s = scene_of(square(5.0f), grey(0.5f));
    s.lights = {sun(nit * kPi / 0.5f)};
    return s;
}

/// A sun that shines on nothing that the camera sees, and that the camera does not see.
scene::Light hidden_sun() {
    scene::Light light;
    light.type = scene::LightType::sun;
    light.intensity = 100000.0f;
    light.angular_diameter_rad = 0.0093f;
    light.direction = {0, 0, 1};
    return light;
}

int code(float linear) {
    return static_cast<int>(std::lround(255.0f * shading::srgb_from_linear(glm::vec3(linear)).x));
}

scene::Material unlit(const glm::vec4& color) {
    scene::Material m = grey(0.5f);
    m.base_color = color;
    m.unlit = true;
    return m;
}

}  // namespace

TEST(Exposure, AGreyCardAloneIs118UnderEveryCurve) {
    for (const float nit : {0.001f, 10.0f, 50000.0f}) {
        const realtime::Still still = render(plane_of(nit));
        for (const std::uint32_t curve : {0u, 1u, 2u, 3u})
            EXPECT_NEAR(code(realtime::display_linear(still, curve)[500].y), 118, 2) << curve << ", " << nit;
    }
}

TEST(Exposure, FrostbiteKeepsThePapersConstant) {
    realtime::RendererOptions o = options("best");
    o.profile.exposure = options("frostbite").profile.exposure;
    const realtime::Still paper = render(plane_of(10.0f), {}, o);
    const realtime::Still other = render(plane_of(10.0f));
    EXPECT_FLOAT_EQ(paper.exposure, shading::exposure_from_ev100(paper.ev100));
    EXPECT_FLOAT_EQ(paper.ev100, other.ev100) << "the meter is the same";
    EXPECT_NEAR(other.exposure / paper.exposure, 1.728f, 0.001f);
}

TEST(Exposure, ASunThatIsNotInThePictureLeavesNoSteps) {
    // 0.01 cd/m^2 falling to a tenth across the picture: neighbours differ by less than a percent.
    scene::Scene s = scene_of(square(5.0f), grey(0.5f));
    scene::Light lamp;
    lamp.type = scene::LightType::point;
    lamp.position = {0, 0, 1};
    lamp.intensity = 0.01f * kPi / 0.5f;
    s.lights = {lamp, hidden_sun()};
    const realtime::Still still = render(s);
    EXPECT_NEAR(center(still).y / 0.01f, 1.0f, 0.02f);
    EXPECT_NEAR(still.ev100, shading::ev100_from_luminance(0.01f), 0.5f);
    for (std::size_t x = 17; x < 31; ++x) {
        const float a = still.planes.light_nit[16 * 32 + x].y;
        const float b = still.planes.light_nit[16 * 32 + x + 1].y;
        EXPECT_LT(b, a) << x << ": falls everywhere, without steps";
    }
}

TEST(Exposure, AFaintPlaneUnderAHiddenSunIsNotBlack) {
    for (const float nit : {1e-4f, 5e-4f, 1e-2f}) {
        scene::Scene s = plane_of(nit);
        s.lights.push_back(hidden_sun());
        const realtime::Still still = render(s);
        EXPECT_NEAR(center(still).y / nit, 1.0f, 0.01f) << nit;
        EXPECT_NEAR(still.ev100, shading::ev100_from_luminance(nit), 0.1f) << nit;
    }
}

TEST(Exposure, AStillHoldsWhatIsFarAboveItsWhite) {
    scene::Material lamp = grey(0.0f);
    lamp.emissive_nit = glm::vec3(1.6e9f);
    const scene::Scene s = scene_of(square(0.31f), lamp);
    // The edge crosses pixels: what is clamped there would be missing from their means.
    realtime::RendererOptions o = options("best", 32, 16);
    const auto sum_at = [&](float ev100) {
        double sum = 0.0;
        for (const glm::vec4& nit : render(s, fixed_ev(ev100), o).planes.light_nit) sum += double(nit.x);
        return sum;
    };
    const double whole = sum_at(25.0f);
    for (const float ev100 : {8.0f, 0.0f, -10.0f}) EXPECT_NEAR(sum_at(ev100) / whole, 1.0, 1e-3) << ev100;
}

TEST(Exposure, WhatExceedsAnInteractiveFramesLightBufferIsClampedAndFinite) {
    scene::Material lamp = grey(0.0f);
    lamp.emissive_nit = glm::vec3(1e9f);
    const scene::Scene s = scene_of(square(5.0f), lamp);
    realtime::RendererOptions o = options("best");
    o.half_light = true;
    const realtime::Still still = render(s, fixed_ev(-5.0f), o);
    const float limit = 65504.0f / shading::standard_output_exposure(-5.0f);
    EXPECT_TRUE(std::isfinite(center(still).x));
    EXPECT_GE(center(still).x, 0.99f * limit);
    EXPECT_LE(center(still).x, 65.0f * limit) << "six stops are kept for what is seen";
    EXPECT_NEAR(center(render(s, {}, o)).x / 1e9f, 1.0f, 0.001f) << "metered, it fits";
}

// A slip in one place stays there: neither the means of other pixels nor what is filtered from it know of it.
TEST(Exposure, NotANumberStaysWhereItIs) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    scene::Scene s = scene_of(square(0.3f), grey(0.8f));
    s.environment = constant(100.0f);
    const realtime::Still right = render(s);
    s.environment->luminance_nit[17] = glm::vec3(nan, 100.0f, nan);
    const realtime::Still still = render(s);
    EXPECT_NEAR(still.ev100, right.ev100, 0.05f);
    for (std::size_t i = 0; i < still.planes.light_nit.size(); ++i) {
        for (int c = 0; c < 3; ++c) ASSERT_FALSE(std::isnan(still.planes.light_nit[i][c])) << i;
    }
    EXPECT_NEAR(center(still).y / center(right).y, 1.0f, 0.02f) << "lit by the rest of the sky";
    // One pixel's material: the card in the middle, its neighbour as before.
    scene::Scene two = scene_of(square(5.0f), grey(0.5f));
    two.lights = {sun(100.0f)};
    const float beside = render(two, fixed_ev(5.0f)).planes.light_nit.front().x;
    two.materials.push_back(grey(0.5f));
    two.materials.back().base_color = glm::vec4(nan, nan, nan, 1.0f);
    two.meshes.push_back({"card", {square(0.3f, 1)}});
    two.instances.push_back({"card", 1, glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, 0.1f})});
    const realtime::Still card = render(two, fixed_ev(5.0f), options("best", 32, 4));
    EXPECT_FALSE(std::isnan(center(card).x));
    EXPECT_NEAR(card.planes.light_nit.front().x, beside, 1e-3f * beside);
}

TEST(Exposure, UnlitSurfacesAreShownAsTheyAreAndNotMetered) {
    const glm::vec4 orange(1.0f, 0.2158605f, 0.0f, 1.0f);
    for (const char* kind : {"opaque", "masked", "blended"}) {
        for (const float nit : {0.01f, 1e4f}) {
            scene::Scene s = plane_of(nit);
            s.instances[0].world[3] = glm::vec4(0, 0, -2, 1);
            s.materials.push_back(unlit(orange));
            scene::Material& m = s.materials.back();
            if (std::string(kind) == "masked") m.alpha_mode = scene::AlphaMode::mask;
            if (std::string(kind) == "blended") {
                // As good as opaque, and blended all the same.
                m.alpha_mode = scene::AlphaMode::blend;
                m.base_color.a = 0.9999f;
            }
            s.meshes.push_back({"card", {square(0.3f, 1)}});
            s.instances.push_back({"card", 1, glm::mat4(1.0f)});
            const realtime::Still still = render(s);
            EXPECT_NEAR(still.ev100, shading::ev100_from_luminance(nit), 0.1f) << kind << ", " << nit;
            for (const std::uint32_t curve : {0u, 1u, 2u, 3u}) {
                const glm::vec3 shown = realtime::display_linear(still, curve)[16 * 32 + 16];
                EXPECT_EQ(code(shown.x), 255) << kind << ", " << nit << ", curve " << curve;
                EXPECT_EQ(code(shown.y), 128) << kind << ", " << nit << ", curve " << curve;
                EXPECT_EQ(code(shown.z), 0) << kind << ", " << nit << ", curve " << curve;
            }
            // The stored luminance gives the colour back without a curve.
            EXPECT_NEAR(center(still).y * still.exposure, orange.y, 0.001f);
        }
    }
}

TEST(Exposure, AHalfTransparentUnlitSurfaceMixesWithWhatTheDisplayShowsBehindIt) {
    scene::Scene s = plane_of(100.0f);
    s.instances[0].world[3] = glm::vec4(0, 0, -2, 1);
    const realtime::Still alone = render(s, fixed_ev(7.0f));
    s.materials.push_back(unlit({1.0f, 1.0f, 1.0f, 0.5f}));
    s.materials.back().alpha_mode = scene::AlphaMode::blend;
    s.meshes.push_back({"card", {square(0.3f, 1)}});
    s.instances.push_back({"card", 1, glm::mat4(1.0f)});
    const realtime::Still both = render(s, fixed_ev(7.0f));
    const std::size_t at = 16 * 32 + 16;
    for (const std::uint32_t curve : {0u, 1u, 2u, 3u}) {
        const float behind = realtime::display_linear(alone, curve)[at].y;
        EXPECT_NEAR(realtime::display_linear(both, curve)[at].y, 0.5f + 0.5f * behind, 0.002f) << curve;
    }
}
