#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "candela/bake/environment.hpp"
#include "quadrature.hpp"
#include "render_scenes.hpp"
#include "shading/dfg.glsl"
#include "shading/transfer.glsl"

using namespace candela;
using namespace candela::test;
using realtime::Strategy;

namespace {

constexpr float kPi = 3.14159265f;

realtime::RendererOptions integrating(const std::string& profile, std::uint32_t size, std::uint32_t samples,
                                      Strategy strategy = Strategy::both) {
    realtime::RendererOptions o = options(profile, size, samples);
    o.integrate.emplace();
    o.integrate->strategy = strategy;
    return o;
}

/// Renders with validation on and expects it to be silent.
realtime::Still render(const scene::Scene& scene, const realtime::RendererOptions& o,
                       const scene::Camera& camera, const scene::Exposure& exposure = fixed_ev(10.0f)) {
    const gpu::Device device{validated()};
    realtime::Still still;
    {
        realtime::Renderer renderer(device, scene, o);
        still = renderer.render_still(camera, exposure);
    }
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    return still;
}

/// Sees the square of scene_of(square(20)) at one angle in every pixel, so that the mean of the picture is
/// one integral. v is the direction to the viewer.
scene::Camera parallel(const glm::vec3& v) {
    scene::Camera camera = scene::look_at(10.0f * v, {0, 0, 0}, 0.6f);
    camera.projection = scene::Projection::orthographic;
    camera.xmag_m = camera.ymag_m = 0.5f;
    camera.zfar_m = 100.0f;
    return camera;
}

glm::dvec3 mean(const realtime::Still& still) {
    glm::dvec3 sum(0.0);
    for (const glm::vec4& nit : still.planes.light_nit) sum += glm::dvec3(nit);
    return sum / static_cast<double>(still.planes.light_nit.size());
}

glm::vec3 viewer(float NoV) {
    const float sine = std::sqrt(1.0f - NoV * NoV);
    return {0.6f * sine, 0.8f * sine, NoV};
}

scene::Environment black(std::uint32_t width, std::uint32_t height) {
    scene::Environment e = constant(0.0f);
    e.width = width;
    e.height = height;
    e.luminance_nit.assign(std::size_t{width} * height, glm::vec3(0.0f));
    return e;
}

/// A dim coloured gradient with a lamp 2000 times as bright: smooth enough for quadrature.
scene::Environment lamp_in_a_room() {
    scene::Environment e = constant(0.0f);
    e.width = 64;
    e.height = 32;
    e.luminance_nit.clear();
    for (std::uint32_t y = 0; y < e.height; ++y) {
        for (std::uint32_t x = 0; x < e.width; ++x) {
            const bool lamp = x >= 8 && x < 12 && y >= 9 && y < 12;
            const float fall = 1.0f - static_cast<float>(y) / 32.0f;
            e.luminance_nit.push_back(lamp ? glm::vec3(2000.0f, 1500.0f, 1000.0f)
                                           : glm::vec3(1.0f, 2.0f * fall, 3.0f * fall * fall));
        }
    }
    e.rotation_rad = 0.7f;
    return e;
}

/// `roughness` in steps of the G-buffer.
scene::Material material(float metallic, float roughness) {
    scene::Material m;
    const float c = std::pow(800.0f / 1023.0f, 2.0f);
    m.base_color = glm::vec4(c, 0.5f * c, 0.25f * c, 1.0f);
    m.metallic = metallic;
    m.perceptual_roughness = roughness;
    return m;
}

shading::Surface surface_of(const scene::Material& m) {
    shading::Surface s{};
    s.base_color = glm::vec3(m.base_color);
    s.metallic = m.metallic;
    s.perceptual_roughness = m.perceptual_roughness;
    s.dielectric_f0 = glm::vec3(0.04f * m.specular);
    s.dielectric_f90 = glm::vec3(m.specular);
    s.coat = m.clearcoat.factor;
    s.coat_perceptual_roughness = m.clearcoat.perceptual_roughness;
    s.sheen_color = m.sheen.color;
    s.sheen_perceptual_roughness = m.sheen.perceptual_roughness;
    s.anisotropy = m.anisotropy.strength;
    return s;
}

void expect_the_integral(const scene::Material& m, const std::string& profile,
                         const shading::BsdfTechniques& techniques) {
    scene::Scene s = scene_of(square(20.0f), m);
    s.environment = lamp_in_a_room();
    for (const float NoV : {0.25f, 0.8f}) {
        Point p;
        p.surface = surface_of(m);
        p.techniques = techniques;
        p.v = viewer(NoV);
        p.dfg = shading::integrate_dfg(NoV, m.perceptual_roughness, 1024);
        const glm::dvec3 expected = reflected_nit(*s.environment, p);
        const glm::dvec3 seen = mean(render(s, integrating(profile, 64, 64), parallel(p.v)));
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(seen[c] / expected[c], 1.0, 0.005) << profile << ", NoV " << NoV << ", channel " << c;
        }
    }
}

scene::Material white(float metallic, float roughness) {
    scene::Material m = material(metallic, roughness);
    m.base_color = glm::vec4(1.0f);
    return m;
}

double furnace(const scene::Material& m, float NoV) {
    scene::Scene s = scene_of(square(20.0f), m);
    s.environment = constant(1.0f);
    return mean(render(s, integrating("best", 32, 16), parallel(viewer(NoV)))).x;
}

}  // namespace

// Against the same functions of shading/ summed over the environment on the host, without random numbers.
TEST(Integrate, ADielectricIsItsIntegral) {
    expect_the_integral(material(0.0f, 1638.0f / 4095.0f), "best", shading::techniques_best());
    expect_the_integral(material(0.0f, 2457.0f / 4095.0f), "ue4",
                        shading::image_based_form(shading::techniques_ue4()));
}

TEST(Integrate, AMetalIsItsIntegral) {
    expect_the_integral(material(1.0f, 1638.0f / 4095.0f), "frostbite", shading::techniques_frostbite());
    expect_the_integral(material(1.0f, 3276.0f / 4095.0f), "best", shading::techniques_best());
}

TEST(Integrate, AFrostbiteDiffuseSurfaceIsItsIntegral) {
    expect_the_integral(material(0.0f, 1.0f), "frostbite", shading::techniques_frostbite());
}

TEST(Integrate, CoatAndSheenAreTheirIntegral) {
    scene::Material m = material(0.0f, 2457.0f / 4095.0f);
    m.clearcoat.factor = 1.0f;
    m.clearcoat.perceptual_roughness = 77.0f / 255.0f;
    expect_the_integral(m, "best", shading::techniques_best());
    m.clearcoat.factor = 0.0f;
    m.sheen.color = glm::vec3(std::pow(204.0f / 255.0f, 2.0f));
    m.sheen.perceptual_roughness = 102.0f / 255.0f;
    expect_the_integral(m, "best", shading::techniques_best());
}

TEST(Integrate, AnAnisotropicMetalIsItsIntegral) {
    scene::Material m = material(1.0f, 1638.0f / 4095.0f);
    m.anisotropy.strength = 204.0f / 255.0f;
    expect_the_integral(m, "best", shading::techniques_best());
}

TEST(Integrate, WhiteSurfacesReturnWhatTheyGetInAFurnace) {
    scene::Material lambert = white(0.0f, 1.0f);
    lambert.specular = 0.0f;
    for (const float NoV : {0.1f, 0.5f, 1.0f}) {
        EXPECT_NEAR(furnace(lambert, NoV), 1.0, 0.01) << "Lambert, NoV " << NoV;
        EXPECT_NEAR(furnace(white(0.0f, 0.4f), NoV), 1.0, 0.01) << "dielectric, NoV " << NoV;
        for (const float roughness : {0.1f, 0.4f, 0.7f, 1.0f}) {
            EXPECT_NEAR(furnace(white(1.0f, roughness), NoV), 1.0, 0.01)
                << "metal, roughness " << roughness << ", NoV " << NoV;
        }
    }
}

TEST(Integrate, CoatAndSheenGainNothingInAFurnace) {
    for (const float NoV : {0.1f, 0.5f, 1.0f}) {
        scene::Material coated = white(1.0f, 0.5f);
        coated.clearcoat.factor = 1.0f;
        coated.clearcoat.perceptual_roughness = 0.2f;
        const double coat = furnace(coated, NoV);
        EXPECT_LE(coat, 1.01) << "NoV " << NoV;
        EXPECT_GE(coat, 0.9) << "NoV " << NoV;
        scene::Material cloth = white(0.0f, 1.0f);
        cloth.sheen.color = glm::vec3(1.0f);
        cloth.sheen.perceptual_roughness = 0.5f;
        const double sheen = furnace(cloth, NoV);
        EXPECT_LE(sheen, 1.01) << "NoV " << NoV;
        EXPECT_GE(sheen, 0.9) << "NoV " << NoV;
    }
}

// Where interpolated normals face away from the viewer, or nearly so, every estimator divides by little.
TEST(Integrate, SmoothCoatsHaveNoFirefliesAtTheSilhouette) {
    scene::Material m = white(0.0f, 0.5f);
    m.clearcoat.factor = 1.0f;
    m.clearcoat.perceptual_roughness = 0.0f;
    scene::Scene s = scene_of(sphere(0.45f, 0, 24, 12), m);  // coarse: many such normals
    s.environment = constant(1.0f);
    float peak = 0.0f;
    for (const glm::vec4& nit :
         render(s, integrating("best", 128, 16), parallel({0, 0, 1})).planes.light_nit) {
        peak = std::max(peak, nit.x);
    }
    EXPECT_LT(peak, 1.2f);
}

// Under half a sky, E / pi = L (1 + cos t) / 2 for a plane tilted by t.
TEST(Integrate, ALambertPlaneUnderHalfASkyIsTheClosedForm) {
    scene::Scene s = scene_of(square(20.0f), grey(0.5f));
    s.environment = black(256, 128);
    std::fill_n(s.environment->luminance_nit.begin(), 256 * 64, glm::vec3(100.0f));
    for (const float tilt_rad : {0.0f, 0.8f, 1.5707963f, 2.4f}) {
        // From facing +Z to facing +Y, then back by the tilt.
        s.instances[0].world = glm::rotate(glm::mat4(1.0f), tilt_rad - 0.5f * kPi, glm::vec3(1, 0, 0));
        const glm::vec3 n(0.0f, std::cos(tilt_rad), std::sin(tilt_rad));
        const double expected = 100.0 * 0.5 * 0.5 * (1.0 + std::cos(static_cast<double>(tilt_rad)));
        EXPECT_NEAR(mean(render(s, integrating("best", 64, 64), parallel(n))).x / expected, 1.0, 0.005)
            << "tilt " << tilt_rad;
    }
}

TEST(Integrate, ADiffuseSphereInAConstantEnvironmentIsItsAlbedo) {
    scene::Scene s = scene_of(sphere(2.0f), grey(0.5f));
    s.environment = constant(100.0f);
    const realtime::Still still = render(s, integrating("best", 32, 16), parallel({0, 0, 1}));
    EXPECT_NEAR(mean(still).x, 50.0, 0.15);
    for (const glm::vec4& nit : still.planes.light_nit) EXPECT_NEAR(nit.x, 50.0f, 2.0f);
}

// The larger picture has more texels than its table has cells.
TEST(Integrate, ASunOfOneTexelGivesItsWholeIlluminance) {
    scene::Scene s = scene_of(square(20.0f), grey(0.5f));
    for (const glm::uvec2 size : {glm::uvec2(256, 128), glm::uvec2(4501, 2251)}) {
        s.environment = black(size.x, size.y);
        const std::uint32_t row = size.y * 40 / 128;
        const std::uint32_t column = size.x * 230 / 256;  // behind the viewer of a square that faces +Z
        s.environment->luminance_nit[row * size.x + column] = glm::vec3(1.0e9f);
        const glm::vec2 uv((static_cast<float>(column) + 0.5f) / static_cast<float>(size.x),
                           (static_cast<float>(row) + 0.5f) / static_cast<float>(size.y));
        const glm::vec3 sun = shading::equirect_direction(uv);
        ASSERT_GT(sun.z, 0.3f);
        const double sr = shading::equirect_texel_solid_angle(row, size.x, size.y);
        const double expected = 1.0e9 * sr * static_cast<double>(sun.z) * 0.5 / 3.14159265358979;
        const double nit =
            mean(render(s, integrating("best", 64, 64), parallel({0, 0, 1}), fixed_ev(20.0f))).x;
        EXPECT_NEAR(nit / expected, 1.0, 0.005) << size.x;
    }
}

TEST(Integrate, EachStrategyAloneConvergesToTheSameIntegral) {
    scene::Scene s = scene_of(square(20.0f), material(1.0f, 0.6f));
    s.environment = lamp_in_a_room();
    const auto seen = [&](Strategy strategy) {
        return mean(render(s, integrating("best", 64, 64, strategy), parallel(viewer(0.5f)))).y;
    };
    const double both = seen(Strategy::both);
    EXPECT_NEAR(seen(Strategy::light) / both, 1.0, 0.01);
    EXPECT_NEAR(seen(Strategy::bsdf) / both, 1.0, 0.01);
}

TEST(Integrate, LightsWithoutExtentAreExactInOneSample) {
    scene::Scene s = scene_of(square(20.0f), grey(0.5f));
    s.lights.push_back(sun(1000.0f));
    const realtime::Still still = render(s, integrating("best", 16, 1), parallel({0, 0, 1}));
    for (const glm::vec4& nit : still.planes.light_nit) EXPECT_NEAR(nit.x, 500.0f / kPi, 0.5f);
}

TEST(Integrate, LightOfBlendedSurfacesIsIntegratedToo) {
    scene::Material back = grey(0.0f);
    back.emissive_nit = glm::vec3(1.0f);
    scene::Material pane = material(1.0f, 1638.0f / 4095.0f);
    pane.alpha_mode = scene::AlphaMode::blend;
    pane.base_color.w = 0.25f;
    scene::Scene s = scene_of(square(20.0f), back);
    s.materials.push_back(pane);
    s.meshes.push_back({"pane", {square(20.0f, 1)}});
    s.instances.push_back({"pane", 1, glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, 1))});
    s.environment = lamp_in_a_room();
    Point p;
    p.surface = surface_of(pane);
    p.techniques = shading::techniques_frostbite();
    p.v = viewer(0.5f);
    const double expected = 0.25 * reflected_nit(*s.environment, p).x + 0.75 * 1.0;
    EXPECT_NEAR(mean(render(s, integrating("frostbite", 64, 64), parallel(p.v))).x / expected, 1.0, 0.005);
    EXPECT_GT(std::abs(mean(render(s, options("frostbite", 64, 4), parallel(p.v))).x / expected - 1.0), 0.01)
        << "the technique is off here, or this would not tell the two apart";
}

// Half floats exposed for the sun have no digits left for what does not see it.
TEST(Integrate, WhatDoesNotSeeTheSunKeepsItsDigits) {
    scene::Scene s = scene_of(square(20.0f), grey(0.5f));
    s.environment = black(256, 128);
    s.environment->luminance_nit.assign(std::size_t{256} * 128, glm::vec3(0.01f));
    s.environment->luminance_nit[40 * 256 + 128] = glm::vec3(1.0e9f);  // -Z
    const double seen = mean(render(s, integrating("best", 32, 16), parallel({0, 0, 1}), fixed_ev(-5.0f))).x;
    EXPECT_NEAR(seen / 0.005, 1.0, 0.01);
}

TEST(Integrate, TheSameInputGivesTheSameBytesAndASeedAnother) {
    scene::Scene s = scene_of(sphere(1.0f), material(1.0f, 0.5f));
    s.environment = lamp_in_a_room();
    const auto once = [&](std::uint32_t seed) {
        realtime::RendererOptions o = integrating("best", 32, 3);
        o.seed = seed;
        return render(s, o, parallel({0, 0, 1})).planes.light_nit;
    };
    EXPECT_EQ(once(0), once(0));
    EXPECT_NE(once(0), once(1));
}

TEST(Integrate, IsMeteredAsTheRealTimeFrameIs) {
    scene::Scene s = scene_of(sphere(1.0f), material(0.0f, 0.5f));
    s.environment = bake::studio_environment();
    s.environment->visible = false;
    const auto metered = [&](const realtime::RendererOptions& o) {
        return render(s, o, parallel({0, 0, 1}), scene::Exposure{}).ev100;
    };
    EXPECT_NEAR(metered(integrating("best", 64, 1)), metered(options("best", 64)), 0.1f);
}

// The split sum of the real-time frame against the integral, on ten spheres: the picture that validates
// `best`.
TEST(Integrate, TheRealTimeSpheresAreCloseToTheirIntegrals) {
    scene::Scene s;
    for (int i = 0; i < 10; ++i) {
        const float roughness = 0.1f + 0.2f * static_cast<float>(i % 5);
        s.materials.push_back(material(i < 5 ? 0.0f : 1.0f, roughness));
        s.meshes.push_back({"sphere", {sphere(0.09f, static_cast<std::uint32_t>(i))}});
        const glm::vec3 at(0.2f * static_cast<float>(i % 5 - 2), i < 5 ? 0.12f : -0.12f, 0.0f);
        s.instances.push_back({"sphere", static_cast<std::uint32_t>(i), glm::translate(glm::mat4(1.0f), at)});
    }
    s.environment = bake::studio_environment();
    s.environment->visible = false;
    const auto fast = render(s, options("best", 160, 16), parallel({0, 0, 1})).planes.light_nit;
    const auto truth = render(s, integrating("best", 160, 64), parallel({0, 0, 1}));
    double difference = 0.0;
    double sum = 0.0;
    double bias = 0.0;
    double display = 0.0;
    double covered = 0.0;
    for (std::size_t i = 0; i < fast.size(); ++i) {
        const glm::vec3 a(fast[i]);
        const glm::vec3 b(truth.planes.light_nit[i]);
        if (b.x <= 0.0f) continue;
        ++covered;
        for (int c = 0; c < 3; ++c) {
            difference += std::abs(static_cast<double>(a[c] - b[c]));
            bias += static_cast<double>(a[c] - b[c]);
            sum += static_cast<double>(b[c]);
            const float scale = 4.0f * truth.exposure;
            display += std::abs(static_cast<double>(shading::srgb_from_linear(glm::min(a * scale, 1.0f))[c] -
                                                    shading::srgb_from_linear(glm::min(b * scale, 1.0f))[c]));
        }
    }
    std::printf("split sum against integral: |d| %.2f %%, bias %.2f %%, mean display difference %.4f\n",
                100.0 * difference / sum, 100.0 * bias / sum, display / (3.0 * covered));
    EXPECT_LT(difference / sum, 0.10);
    EXPECT_LT(std::abs(bias / sum), 0.05);
    EXPECT_GT(difference / sum, 0.002) << "the integral is not the technique";
}
