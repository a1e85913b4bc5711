// A profile's material model has a form for lights and one for all other light (shading::image_based_form).
#include <gtest/gtest.h>

#include "lights.hpp"
#include "shading/dfg.glsl"

using namespace candela;
using namespace candela::test;

namespace {

constexpr float kNoV = 0.4f;
constexpr float kRoughness = 0.3f;

scene::Material metal() {
    scene::Material m;
    m.base_color = glm::vec4(0.5f, 0.7f, 0.9f, 1.0f);
    m.metallic = 1.0f;
    m.perceptual_roughness = kRoughness;
    return m;
}

truth::PathOptions ue4(int max_bounces) {
    truth::PathOptions o;
    o.techniques = shading::techniques_ue4();
    o.max_bounces = max_bounces;
    return o;
}

scene::Camera viewer() {
    return spot_meter({std::sqrt(1.0f - kNoV * kNoV), kNoV, 0.0f});
}

/// Of metal() under light that comes from no light: Karis 2013, "Environment BRDF".
glm::dvec3 albedo() {
    const glm::vec4 dfg = shading::integrate_dfg_ue4(kNoV, kRoughness, 4096);
    return glm::dvec3(glm::vec3(metal().base_color) * dfg.x + dfg.y);
}

void expect_near(const glm::dvec3& seen, const glm::dvec3& expected, double relative) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c] / expected[c], 1.0, relative) << "channel " << c;
}

}  // namespace

TEST(TwoForms, AnEnvironmentIsReflectedByTheImageBasedForm) {
    scene::Scene s = floor_under({}, metal());
    s.environment = constant(100.0f);
    for (const truth::Draws draws : {truth::Draws::all, truth::Draws::lights, truth::Draws::material}) {
        truth::PathOptions o = ue4(1);
        o.draws = draws;
        expect_near(mean_luminance(s, viewer(), o, 4096) / 100.0, albedo(), 0.01);
    }
}

// A shell of 100 m about a lamp that the floor does not face has one luminance everywhere, and is met by the
// material's rays only.
TEST(TwoForms, OtherSurfacesAreReflectedByTheImageBasedForm) {
    constexpr float kRadius_m = 100.0f;
    scene::Light bulb = light_of(scene::LightType::point, {0.0f, -0.5f, 0.0f}, {0.0f, -1.0f, 0.0f});
    bulb.intensity = 1.0e6f;
    bulb.color = glm::vec3(1.0f);
    bulb.casts_shadow = false;
    bulb.range_m = std::numeric_limits<float>::infinity();
    scene::Scene s = floor_under({bulb}, metal());
    for (auto& position : s.meshes[0].primitives[0].positions) position *= 0.02f;
    scene::Material wall = grey(0.5f);
    wall.double_sided = true;
    place(s, sphere(kRadius_m, 0, 256, 128), wall);
    const double shell_nit = 0.5 / 3.14159265358979 * 1.0e6 / (kRadius_m * kRadius_m);
    expect_near(mean_luminance(s, viewer(), ue4(2), 4096) / shell_nit, albedo(), 0.02);
}

TEST(TwoForms, ALightIsReflectedByTheFormForLights) {
    scene::Light l = light_of(scene::LightType::directional, {}, {0.5f, -1.0f, 0.2f});
    l.intensity = 1000.0f;
    l.color = glm::vec3(1.0f);
    const scene::Scene s = floor_under({l}, metal());
    shading::Surface surface{};
    surface.base_color = glm::vec3(metal().base_color);
    surface.metallic = 1.0f;
    surface.perceptual_roughness = kRoughness;
    const glm::vec3 n(0.0f, 1.0f, 0.0f);
    const glm::vec3 v(std::sqrt(1.0f - kNoV * kNoV), kNoV, 0.0f);
    const glm::vec3 to_light = -glm::normalize(l.direction);
    glm::vec3 diffuse;
    glm::vec3 specular;
    shading::evaluate_standard(surface, shading::techniques_ue4(), n, v, to_light, glm::vec4(1.0f), diffuse,
                               specular);
    expect_near(mean_luminance(s, viewer(), ue4(1), 16), glm::dvec3(specular) * (1000.0 * double(to_light.y)),
                0.01);
}

// What the material's draws meet of a light is the integrand that the light's own draws have, or their
// weights would not do.
TEST(TwoForms, BothWaysOfDrawingALightAgree) {
    scene::Scene lamps[] = {
        floor_under({light_of(scene::LightType::sphere, {-1.0f, 1.0f, 0.2f}, {0.7f, -1.0f, 0.0f})}, metal()),
        floor_under({}, metal())};
    scene::Primitive panel = flat_square(0.4f, {-1.0f, 1.0f, 0.0f}, false);
    place(lamps[1], panel, lamp(1000.0f));
    for (const scene::Scene& s : lamps) {
        const auto nit = [&](truth::Draws draws) {
            truth::PathOptions o = ue4(1);
            o.draws = draws;
            return mean_luminance(s, viewer(), o, 4096);
        };
        const glm::dvec3 by_lights = nit(truth::Draws::lights);
        expect_near(nit(truth::Draws::material), by_lights, 0.015);
        expect_near(nit(truth::Draws::all), by_lights, 0.01);
    }
}
