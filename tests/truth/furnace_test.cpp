#include <gtest/gtest.h>

#include "trace.hpp"

using namespace candela;
using namespace candela::test;

namespace {

scene::Material white(float metallic, float perceptual_roughness) {
    scene::Material m;
    m.base_color = glm::vec4(1.0f);
    m.metallic = metallic;
    m.perceptual_roughness = perceptual_roughness;
    return m;
}

/// A sphere that fills the picture, in a furnace of luminance 1.
double in_the_furnace(const scene::Material& m) {
    const scene::Scene s = scene_of(sphere(1.0f), m);
    return mean_luminance(s, scene::look_at({0, 0, 3}, {0, 0, 0}, 0.45f), path_options(false, true), 256, 16)
        .y;
}

}  // namespace

TEST(PathFurnace, MetalAndDielectricReturnWhatTheyGet) {
    for (const float metallic : {0.0f, 0.5f, 1.0f}) {
        for (const float roughness : {0.0f, 0.2f, 0.4f, 0.6f, 0.8f, 1.0f}) {
            EXPECT_NEAR(in_the_furnace(white(metallic, roughness)), 1.0, 0.01)
                << "metallic " << metallic << ", roughness " << roughness;
        }
    }
}

TEST(PathFurnace, CoatAndSheenKeepTheEnergyOfWhatIsBelow) {
    for (const float roughness : {0.1f, 0.5f, 1.0f}) {
        scene::Material coated = white(0.0f, roughness);
        coated.clearcoat.factor = 1.0f;
        EXPECT_NEAR(in_the_furnace(coated), 1.0, 0.01) << "coat over roughness " << roughness;
        scene::Material cloth = white(0.0f, 0.8f);
        cloth.sheen.color = glm::vec3(1.0f);
        cloth.sheen.perceptual_roughness = roughness;
        EXPECT_NEAR(in_the_furnace(cloth), 1.0, 0.01) << "sheen of roughness " << roughness;
    }
}

// The compensation of the anisotropic lobe is by the isotropic table, faded out at grazing angles
// (bsdf.glsl): it loses light and must not make any.
TEST(PathFurnace, AnisotropyMakesNoEnergy) {
    for (const float strength : {0.3f, 0.7f, 1.0f}) {
        scene::Material brushed = white(1.0f, 0.3f);
        brushed.anisotropy.strength = strength;
        const double seen = in_the_furnace(brushed);
        EXPECT_LT(seen, 1.01) << strength;
        EXPECT_GT(seen, 0.5) << strength;
    }
}

TEST(PathFurnace, AlbedosAreKept) {
    EXPECT_NEAR(in_the_furnace(grey(0.5f)), 0.5, 0.002);
}

TEST(PathFurnace, OtherLightIsOff) {
    scene::Material m = grey(0.5f);
    m.emissive_nit = glm::vec3(1000.0f);
    scene::Scene s = scene_of(sphere(1.0f), m);
    s.lights.push_back(sun(1e5f));
    s.environment = constant(500.0f);
    EXPECT_NEAR(
        mean_luminance(s, scene::look_at({0, 0, 3}, {0, 0, 0}, 0.45f), path_options(false, true), 64, 8).y,
        0.5, 0.005);
}
