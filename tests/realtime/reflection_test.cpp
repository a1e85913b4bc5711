#include <gtest/gtest.h>

#include <cmath>

#include "render_scenes.hpp"

using namespace candela;
using namespace candela::test;

namespace {

/// Smooth light that is not the same along any axis: a coloured lamp as wide as a rough lobe in each third of
/// the sky, over a dim ground.
scene::Environment coloured_sky() {
    scene::Environment e = constant(0.0f);
    e.width = 64;
    e.height = 32;
    e.luminance_nit.clear();
    for (std::uint32_t y = 0; y < e.height; ++y) {
        for (std::uint32_t x = 0; x < e.width; ++x) {
            glm::vec3 nit(1.0f);
            for (int lamp = 0; lamp < 3; ++lamp) {
                const float du = 6.2831853f * ((float(x) + 0.5f) / 64.0f - (0.1f + float(lamp) / 3.0f));
                const float dv = 3.1415927f * ((float(y) + 0.5f) / 32.0f - 0.4f);
                nit[lamp] += 50.0f * std::exp(4.0f * (std::cos(du) - 1.0f) - 8.0f * dv * dv);
            }
            e.luminance_nit.push_back(nit);
        }
    }
    return e;
}

realtime::Still render(const scene::Scene& s, const realtime::RendererOptions& o,
                       const scene::Camera& camera) {
    const gpu::Device device{validated()};
    realtime::Renderer renderer(device, s, o);
    return renderer.render_still(camera, fixed_ev(5.0f));
}

/// Of a sphere in the real-time frame, over its integral.
struct Difference {
    double mean = 0.0;  ///< of what is too much and of what is too little
    double bias = 0.0;
};

Difference difference_of(const scene::Material& m, const std::string& profile,
                         const scene::Environment& environment) {
    scene::Scene s = scene_of(sphere(1.0f), m);
    s.environment = environment;
    s.environment->visible = false;
    const scene::Camera camera = scene::look_at({0, 0, 4}, {0, 0, 0}, 0.5f);
    realtime::RendererOptions integrating = options("best", 48, 64);
    integrating.integrate.emplace();
    const auto truth = render(s, integrating, camera).planes.light_nit;
    const auto frame = render(s, options(profile, 48, 16), camera).planes.light_nit;
    Difference difference;
    double sum = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            difference.mean += std::abs(double(frame[i][c] - truth[i][c]));
            difference.bias += double(frame[i][c] - truth[i][c]);
            sum += double(truth[i][c]);
        }
    }
    return {difference.mean / sum, difference.bias / sum};
}

double error_of(const scene::Material& m, const std::string& profile, const scene::Environment& environment) {
    return difference_of(m, profile, environment).mean;
}

/// Reflects, and has no diffuse light.
scene::Material black(float metallic, float perceptual_roughness) {
    scene::Material m;
    m.base_color = glm::vec4(glm::vec3(metallic), 1.0f);
    m.metallic = metallic;
    m.perceptual_roughness = perceptual_roughness;
    return m;
}

scene::Material anisotropic() {
    scene::Material m = black(1.0f, 0.3f);
    m.anisotropy.strength = 0.8f;
    return m;
}

scene::Material velvet() {
    scene::Material m = black(0.0f, 1.0f);
    m.specular = 0.0f;
    m.sheen.color = glm::vec3(1.0f);
    m.sheen.perceptual_roughness = 0.4f;
    return m;
}

}  // namespace

// Fresnel's rise draws the lobe of a dielectric outwards, which its reads must know.
TEST(Reflection, OfRoughSurfacesIsNearItsIntegral) {
    EXPECT_LT(error_of(black(0.0f, 0.7f), "best", coloured_sky()), 0.07);
    EXPECT_LT(error_of(black(1.0f, 0.5f), "best", coloured_sky()), 0.065);
}

// Reads along the wrong axis of the grain are worse than none, which is what the paper's techniques have.
TEST(Reflection, OfLayersIsNearerTheirIntegralThanWithoutReadsOfTheirOwn) {
    const double metal = error_of(anisotropic(), "best", coloured_sky());
    EXPECT_LT(metal, 0.45);
    EXPECT_LT(metal, 0.6 * error_of(anisotropic(), "frostbite", coloured_sky()));
    const double sheen = error_of(velvet(), "best", coloured_sky());
    EXPECT_LT(sheen, 0.35);
    EXPECT_LT(sheen, 0.7 * error_of(velvet(), "frostbite", coloured_sky()));
}

// In light that is the same everywhere only the albedo counts.
TEST(Reflection, OfLayersInAFurnaceIsTheirAlbedo) {
    EXPECT_NEAR(difference_of(velvet(), "best", constant(100.0f)).bias, 0.0, 0.02);
    scene::Material coated = black(0.0f, 0.6f);
    coated.clearcoat.factor = 1.0f;
    coated.clearcoat.perceptual_roughness = 0.2f;
    EXPECT_NEAR(difference_of(coated, "best", constant(100.0f)).bias, 0.0, 0.02);
}
