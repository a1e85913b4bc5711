// Shadow maps against the path tracer's visibility where things touch: what leaks, what peels off its caster.
#include <gtest/gtest.h>

#include "candela/truth/camera_rays.hpp"
#include "candela/truth/path_integrator.hpp"
#include "common/contact_scenes.hpp"
#include "render_scenes.hpp"

using namespace candela;
using namespace candela::test;
using scene::LightType;

namespace {

constexpr std::uint32_t kSize = 64;

/// Things on a ground, one in each of six fields of 2/3 m by 1 m: a box, a sphere, a thin wall, a leaning
/// plate, a masked card that stands on its edge, and a plate that hovers a centimetre above the ground.
scene::Scene contact_scene() {
    scene::Scene s = ground(3.0f);
    const auto field = [](int i, float y) {
        return glm::vec3(static_cast<float>(i % 3 - 1) * 2.0f / 3.0f, y, static_cast<float>(i / 3) - 0.5f);
    };
    const auto turned = [](float angle, const glm::vec3& axis) {
        return glm::rotate(glm::mat4(1.0f), angle, axis);
    };
    place(s, box({0.1f, 0.1f, 0.1f}), at(field(0, 0.1f)));
    place(s, sphere(0.12f, 0, 48, 24), at(field(1, 0.12f)));
    place(s, box({0.15f, 0.1f, 0.005f}), at(field(2, 0.1f)) * turned(0.4f, {0, 1, 0}));
    place(s, box({0.15f, 0.005f, 0.12f}), at(field(3, 0.07f)) * turned(0.6f, {0, 0, 1}));
    scene::Material card = grey(0.5f);
    card.alpha_mode = scene::AlphaMode::mask;
    card.double_sided = true;
    card.base_color_texture.texture = 0;
    s.textures.push_back({});
    s.textures[0].image = 0;
    s.textures[0].sampler.magnify = s.textures[0].sampler.minify = scene::Filter::nearest;
    s.images.push_back({"half", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}});
    s.materials.push_back(card);
    place(s, square(0.15f, 1), at(field(4, 0.15f)) * turned(0.5f, {0, 1, 0}));
    place(s, box({0.12f, 0.005f, 0.12f}), at(field(5, 0.015f)));
    return s;
}

scene::Camera from_above() {
    return scene::look_at({0.0f, 2.2f, 2.2f}, glm::vec3(0.0f), 0.62f);
}

std::vector<float> reds(const realtime::Still& still) {
    std::vector<float> out;
    for (const glm::vec4& light : still.planes.light_nit) out.push_back(light.x);
    return out;
}

/// What the path tracer sees through the middles of the pixels.
std::vector<float> traced(const scene::Scene& s, bool shadows, std::uint32_t samples) {
    truth::PathOptions o;
    o.techniques = shading::techniques_best();
    o.direct_only = true;
    o.shadows = shadows;
    const truth::PathIntegrator integrator(s, o);
    const truth::CameraRays rays(from_above(), kSize, kSize);
    std::vector<float> out(std::size_t{kSize} * kSize);
    for (std::uint32_t y = 0; y < kSize; ++y) {
        for (std::uint32_t x = 0; x < kSize; ++x) {
            double sum = 0.0;
            for (std::uint32_t i = 0; i < samples; ++i) {
                const truth::PathSampler sampler({x, y}, i, 7);
                const glm::vec2 middle = glm::vec2(x, y) + 0.5f;
                sum += integrator.trace(rays.through(middle, glm::vec2(0.5f)), sampler).luminance_nit.x;
            }
            out[std::size_t{y} * kSize + x] = static_cast<float>(sum / samples);
        }
    }
    return out;
}

/// How far the visibilities of a light are apart where it would shine: in the mean, and the share of pixels
/// where they differ by more than half.
struct Agreement {
    double mean = 0.0;
    double wrong = 0.0;
    double dark = 0.0;  ///< share of the pixels that the truth sees in shadow
};
struct How {
    std::uint32_t atlas_texels = 4096;
    realtime::ContactShadowTechnique contact = realtime::ContactShadowTechnique::none;
};
Agreement agreement(const scene::Light& light, std::uint32_t samples, const How& how = {}) {
    static const gpu::Device device{validated()};
    scene::Scene s = contact_scene();
    s.lights = {light};
    std::array<std::vector<float>, 2> frame;
    for (const bool shadows : {false, true}) {
        // The lights' cheapest estimates, so that little is compiled, with the best shadows.
        realtime::RendererOptions o = options("ue4", kSize, light.type == LightType::sphere ? 8 : 1);
        o.profile.shadow_filter = realtime::ShadowFilterTechnique::pcss;
        o.profile.contact_shadows = how.contact;
        o.shadows.maps = shadows;
        o.shadows.atlas_texels = how.atlas_texels;
        realtime::Renderer renderer(device, s, o);
        frame[shadows ? 1 : 0] = reds(renderer.render_still(from_above(), fixed_ev(8.0f)));
    }
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    const std::vector<float> lit = traced(s, false, samples);
    const std::vector<float> shadowed = traced(s, true, samples);
    const float most = *std::max_element(lit.begin(), lit.end());
    Agreement a;
    double count = 0.0;
    for (std::size_t i = 0; i < lit.size(); ++i) {
        // Facets that see next to nothing of the light have no visibility to speak of.
        if (lit[i] < 0.02f * most || frame[0][i] < 0.02f * most) continue;
        const double truth = shadowed[i] / lit[i];
        const double difference = std::abs(frame[1][i] / frame[0][i] - truth);
        count += 1.0;
        a.mean += difference;
        a.wrong += difference > 0.5 ? 1.0 : 0.0;
        a.dark += truth < 0.5 ? 1.0 : 0.0;
    }
    return {a.mean / count, a.wrong / count, a.dark / count};
}

}  // namespace

TEST(Contact, ASpotSeesWhatRaysSee) {
    scene::Light light = light_at(LightType::spot, {1.5f, 2.0f, 0.5f}, glm::vec3(0.0f), 1000.0f);
    light.inner_cone_rad = 0.7f;
    light.outer_cone_rad = 0.8f;
    const Agreement a = agreement(light, 1);
    EXPECT_GT(a.dark, 0.01);
    EXPECT_LT(a.mean, 0.004);
    EXPECT_LT(a.wrong, 0.002);
}

TEST(Contact, APointSeesWhatRaysSee) {
    const Agreement a =
        agreement(light_at(LightType::point, {-1.0f, 1.5f, 0.3f}, glm::vec3(0.0f), 1000.0f), 1);
    EXPECT_GT(a.dark, 0.01);
    EXPECT_LT(a.mean, 0.0045);
    EXPECT_LT(a.wrong, 0.004);
}

TEST(Contact, ALowSunSeesWhatRaysSee) {
    // 12 degrees above the ground.
    const Agreement a =
        agreement(light_at(LightType::directional, {3.0f, 0.64f, 0.4f}, glm::vec3(0.0f), 1000.0f), 1);
    EXPECT_GT(a.dark, 0.01);
    EXPECT_LT(a.mean, 0.004);
    EXPECT_LT(a.wrong, 0.003);
}

TEST(Contact, ASphereSeesWhatRaysSee) {
    scene::Light light = light_at(LightType::sphere, {1.0f, 1.5f, 0.5f}, glm::vec3(0.0f), 10000.0f);
    light.radius_m = 0.15f;
    const Agreement a = agreement(light, 32);
    EXPECT_GT(a.dark, 0.01);
    EXPECT_LT(a.mean, 0.012);
    EXPECT_LT(a.wrong, 0.002);
}

// A map of few texels misses the last centimetres, which the march over the picture finds; and it takes
// nothing from what is lit.
TEST(Contact, AMarchFindsWhatACoarseMapMisses) {
    for (const bool low_sun : {false, true}) {
        const scene::Light light =
            low_sun ? light_at(LightType::directional, {3.0f, 0.64f, 0.4f}, glm::vec3(0.0f), 1000.0f)
                    : light_at(LightType::point, {-1.0f, 1.5f, 0.3f}, glm::vec3(0.0f), 1000.0f);
        // Tiles of 64 texels a cascade, or a face.
        const std::uint32_t atlas_texels = low_sun ? 128 : 256;
        const Agreement map = agreement(light, 1, {atlas_texels});
        const Agreement both =
            agreement(light, 1, {atlas_texels, realtime::ContactShadowTechnique::screen_march});
        EXPECT_LT(both.mean, 0.95 * map.mean) << low_sun << ' ' << map.mean << " to " << both.mean;
        EXPECT_LE(both.wrong, map.wrong) << low_sun << ' ' << map.wrong << " to " << both.wrong;
        const Agreement fine = agreement(light, 1, {4096, realtime::ContactShadowTechnique::screen_march});
        EXPECT_LT(fine.mean, 0.006) << low_sun;
    }
}
