#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "candela/bake/probe_filter.hpp"
#include "candela/realtime/probe_capture.hpp"
#include "candela/truth/irradiance_bake.hpp"
#include "common/contact_scenes.hpp"
#include "realtime/render_scenes.hpp"
#include "shading/environment.glsl"
#include "shading/spherical_harmonics.glsl"
#include "volume_scenes.hpp"

using namespace candela;
using namespace candela::test;

namespace {

constexpr float kPi = 3.14159265f;

realtime::Still render_with(const realtime::RendererOptions& o, const scene::Scene& scene,
                            const scene::Camera& camera, float ev100 = 10.0f) {
    const gpu::Device device{validated()};
    realtime::Still still;
    {
        realtime::Renderer renderer(device, scene, o);
        still = renderer.render_still(camera, fixed_ev(ev100));
    }
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    return still;
}

realtime::Still render(const scene::Scene& scene, const scene::Camera& camera, std::uint32_t size = 32,
                       float ev100 = 10.0f) {
    return render_with(options("best", size), scene, camera, ev100);
}

std::vector<scene::IrradianceVolume> baked(const scene::Scene& scene, std::uint32_t samples = 256) {
    truth::IrradianceBakeOptions o;
    o.path.techniques = shading::techniques_best();
    o.samples = samples;
    return truth::bake_irradiance(scene, o);
}

/// A probe that has seen the same everywhere.
scene::ReflectionProbe uniform_probe(float half_m, float nit, float visibility) {
    scene::ReflectionProbe p;
    p.half_size_m = glm::vec3(half_m);
    p.capture.size = 16;
    for (std::uint32_t size = 16; size >= 4; size /= 2)
        p.capture.levels.emplace_back(std::size_t{size} * size,
                                      glm::vec4(glm::vec3(nit * visibility), visibility));
    return p;
}

scene::Scene metal_floor() {
    scene::Material m;
    m.base_color = glm::vec4(1.0f);
    m.metallic = 1.0f;
    m.perceptual_roughness = 0.3f;
    scene::Scene s;
    s.materials.push_back(m);
    place(s, square(4.0f), glm::rotate(glm::mat4(1.0f), -0.5f * kPi, {1.0f, 0.0f, 0.0f}));
    return s;
}

/// A sky bright on one side of a plane through its middle, and a probe of black that hides that side.
scene::Environment half_sky(const glm::vec3& side) {
    scene::Environment e;
    e.width = 128;
    e.height = 64;
    for (std::uint32_t i = 0; i < 128 * 64; ++i) {
        const glm::vec2 uv((float(i % 128) + 0.5f) / 128.0f, (float(i / 128) + 0.5f) / 64.0f);
        e.luminance_nit.emplace_back(glm::dot(shading::equirect_direction(uv), side) > 0.0f ? 100.0f : 0.0f);
    }
    return e;
}
scene::ReflectionProbe half_probe(const gpu::Device& device, const glm::vec3& side) {
    bake::ProbeFaces faces;
    faces.size = 64;
    for (std::size_t f = 0; f < 6; ++f) {
        const glm::mat4 world = bake::probe_camera(f, glm::vec3(0.0f)).world;
        for (std::uint32_t i = 0; i < 64 * 64; ++i) {
            const glm::vec2 at((float(i % 64) + 0.5f) / 32.0f - 1.0f, 1.0f - (float(i / 64) + 0.5f) / 32.0f);
            const glm::vec3 way(world * glm::vec4(at, -1.0f, 0.0f));
            faces.faces[f].emplace_back(0.0f, 0.0f, 0.0f, glm::dot(way, side) > 0.0f ? 1.0f : 0.0f);
        }
    }
    scene::ReflectionProbe probe;
    probe.half_size_m = glm::vec3(100.0f);
    gpu::Commands commands(device);
    probe.capture = bake::filter_probe(device, commands, faces);
    return probe;
}

}  // namespace

// A white furnace with a volume in it: a sphere of albedo 1 and its sky are the same everywhere, so what the
// path tracer bakes and the frame reads back must vanish too, near probes inside of the sphere as well.
TEST(IrradianceVolume, AWhiteSphereVanishesInAFurnace) {
    scene::Material white = grey(1.0f);
    white.perceptual_roughness = 1.0f;
    scene::Scene s = scene_of(sphere(1.0f), white);
    s.environment = constant(1000.0f);
    s.irradiance_volumes = {volume(glm::vec3(0.0f), glm::vec3(1.2f), {4, 4, 4})};
    s.irradiance_volumes = baked(s, 512);
    const realtime::Still still = render(s, scene::look_at({0, 0, 4}, {0, 0, 0}, 0.6f));
    for (const glm::vec4& nit : still.planes.light_nit) EXPECT_NEAR(nit.x, 1000.0f, 15.0f);
}

// The light of a room does not come through its wall: a volume over both, probes of the lit room next to the
// dark one and none within the wall.
TEST(IrradianceVolume, LightDoesNotLeakThroughAThinWall) {
    for (const glm::ivec3& cells : {glm::ivec3(8, 4, 4), glm::ivec3(4, 2, 2)}) {
        scene::Scene s = bright_and_dark_room();
        s.irradiance_volumes = {volume(glm::vec3(0.0f), {2.0f, 1.0f, 1.0f}, cells)};
        s.irradiance_volumes = baked(s);
        const gpu::Device device{validated()};
        realtime::Renderer renderer(device, s, options("best", 32));
        const auto mean = [&](const glm::vec3& eye, const glm::vec3& target) {
            double sum = 0.0;
            const realtime::Still still =
                renderer.render_still(scene::look_at(eye, target, 1.2f), fixed_ev(3.0f));
            for (const glm::vec4& nit : still.planes.light_nit) sum += double(nit.x);
            return sum / double(still.planes.light_nit.size());
        };
        const double lit = mean({-0.2f, 0, 0}, {-2, -0.5f, 0});
        const double lit_wall = mean({-1.8f, 0, 0}, {0, 0, 0});
        const double dark_wall = mean({1.8f, 0, 0}, {0, 0, 0});
        const double dark_corner = mean({1.5f, 0.5f, 0.5f}, {0, -1, -1});
        EXPECT_GT(lit, 1.0);
        // Cells of half a metre tell the wall well, those of a metre less.
        EXPECT_LT(dark_wall, (cells.x == 8 ? 1e-6 : 8e-5) * lit_wall) << cells.x;
        EXPECT_LT(dark_corner, (cells.x == 8 ? 1e-6 : 3e-4) * lit_wall) << cells.x;
    }
}

TEST(IrradianceVolume, TheSameBytesForAnyNumberOfThreads) {
    scene::Scene s = bright_and_dark_room();
    s.irradiance_volumes = {volume(glm::vec3(0.0f), {2.0f, 1.0f, 1.0f}, {2, 1, 1})};
    const auto a = baked(s, 64);
    const auto b = baked(s, 64);
    for (std::size_t i = 0; i < a[0].probes.size(); ++i) {
        EXPECT_TRUE(a[0].probes[i].irradiance_sh == b[0].probes[i].irradiance_sh);
        EXPECT_TRUE(a[0].probes[i].distances == b[0].probes[i].distances);
    }
}

// Frostbite 4.9.1.2: no specular light, metals diffuse with f0 as albedo, and only surroundings in alpha.
TEST(ProbeCapture, AMetalWallIsDiffuseWithItsF0AndTheSkyIsNotThere) {
    scene::Material gold;
    gold.base_color = {1.0f, 0.8f, 0.3f, 1.0f};
    gold.metallic = 1.0f;
    gold.perceptual_roughness = 0.2f;
    scene::Scene s = scene_of(square(50.0f), gold);
    s.lights.push_back(sun(10000.0f));
    s.environment = constant(500.0f);
    scene::ReflectionProbe probe;
    probe.world = at({0, 0, 1});
    probe.half_size_m = glm::vec3(1.0f);
    probe.margin_m = probe.fade_m = 0.2f;
    s.reflection_probes = {probe};
    const gpu::Device device{validated()};
    realtime::ProbeCaptureOptions o;
    o.profile = realtime::profile_by_name("best");
    o.face_texels = 16;
    o.passes = 1;
    const std::vector<bake::ProbeFaces> faces = realtime::capture_probe_faces(device, s, o);
    const glm::vec4 wall = bake::read_faces(faces[0], {0, 0, -1});
    EXPECT_NEAR(wall.x, 10000.0f / kPi, 0.01f * 10000.0f / kPi);
    EXPECT_NEAR(wall.z / wall.x, 0.3f, 0.005f);
    EXPECT_EQ(wall.w, 1.0f);
    EXPECT_EQ(bake::read_faces(faces[0], {0, 0, 1}), glm::vec4(0.0f));
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
}

// Each pass is made of the pass before alone, so the order of the probes is nothing, where they overlap too;
// and light that meets more surfaces is more light.
TEST(ProbeCapture, DoesNotDependOnTheOrderOfTheProbes) {
    scene::Scene s = bright_and_dark_room();
    for (const float half_m : {0.8f, 1.0f}) {
        scene::ReflectionProbe probe;
        probe.world = at({-1.9f + half_m, half_m - 1.0f, 0});
        probe.half_size_m = glm::vec3(half_m);
        probe.margin_m = probe.fade_m = 0.2f;
        s.reflection_probes.push_back(probe);
    }
    const gpu::Device device{validated()};
    realtime::ProbeCaptureOptions o;
    o.profile = realtime::profile_by_name("best");
    o.face_texels = 16;
    o.passes = 2;
    const auto forward = realtime::capture_probe_faces(device, s, o);
    std::swap(s.reflection_probes[0], s.reflection_probes[1]);
    const auto backward = realtime::capture_probe_faces(device, s, o);
    EXPECT_TRUE(forward[0].faces == backward[1].faces);
    EXPECT_TRUE(forward[1].faces == backward[0].faces);
    o.passes = 1;
    const auto once = realtime::capture_probe_faces(device, s, o);
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    EXPECT_GT(bake::read_faces(backward[0], up).x, 1.1f * bake::read_faces(once[0], up).x);
}

// All that a filter and the frame do with a probe keeps what is the same everywhere.
TEST(ReflectionProbe, UniformLightStaysAcrossEveryBorder) {
    scene::Scene s = metal_floor();
    s.environment = constant(100.0f);
    s.reflection_probes = {uniform_probe(0.5f, 100.0f, 0.3f), uniform_probe(1.0f, 100.0f, 0.6f),
                           uniform_probe(2.0f, 100.0f, 1.0f)};
    for (auto& p : s.reflection_probes) p.margin_m = p.fade_m = 0.4f;
    const realtime::Still still = render(s, scene::look_at({0, 3, 3}, {0, 0, 0}, 1.0f));
    for (const glm::vec4& nit : still.planes.light_nit) EXPECT_NEAR(nit.x, 100.0f, 1.5f);
}

// Where a probe's influence ends there is no line: a bright probe over a dim sky, over 0.5 m, of which a
// pixel shows 6 cm.
TEST(ReflectionProbe, TheBorderOfItsInfluenceIsNoStep) {
    scene::Scene s = metal_floor();
    s.environment = constant(50.0f);
    s.reflection_probes = {uniform_probe(1.0f, 100.0f, 1.0f)};
    s.reflection_probes[0].margin_m = s.reflection_probes[0].fade_m = 0.5f;
    constexpr std::uint32_t size = 64;
    const realtime::Still still = render(s, scene::look_at({0, 3, 0.01f}, {0, 0, 0}, 1.2f), size);
    const auto row = [&](std::uint32_t x) {
        return still.planes.light_nit[std::size_t{size / 2} * size + x].x;
    };
    EXPECT_NEAR(row(size / 2), 100.0f, 1.5f);
    EXPECT_NEAR(row(1), 50.0f, 1.0f);
    for (std::uint32_t x = 2; x < size; ++x) EXPECT_LT(std::abs(row(x) - row(x - 1)), 10.0f) << x;
}

// In the middle of a probe a surface's own roughness says which level is read: (level / last)^2.
TEST(ReflectionProbe, ReadsTheLevelsOfItsRoughness) {
    scene::Scene s = metal_floor();
    s.environment = constant(10.0f);
    s.reflection_probes = {uniform_probe(2.0f, 1.0f, 1.0f)};
    auto& levels = s.reflection_probes[0].capture.levels;
    const std::array nit{100.0f, 200.0f, 400.0f};
    ASSERT_EQ(levels.size(), nit.size());
    for (std::size_t i = 0; i < nit.size(); ++i)
        for (glm::vec4& texel : levels[i]) texel = glm::vec4(glm::vec3(nit[i]), 1.0f);
    // A lobe of one read, which is as wide as the surface says.
    realtime::RendererOptions o = options("best");
    o.profile.reflection = realtime::ReflectionTechnique::mirror_direction;
    for (const float roughness : {0.09f, 0.3f, 0.64f}) {
        s.materials[0].perceptual_roughness = roughness;
        const float level = 2.0f * std::sqrt(roughness);
        const float expected =
            level < 1.0f ? glm::mix(nit[0], nit[1], level) : glm::mix(nit[1], nit[2], level - 1.0f);
        const realtime::Still still = render_with(o, s, scene::look_at({0, 3, 0.01f}, {0, 0, 0}, 0.01f));
        EXPECT_NEAR(center(still).x, expected, 0.02f * expected) << roughness;
    }
}

// What a probe hides, it hides from the read of a lobe that would see it. One composition for both reads lets
// as much of the hidden light through as a single wide read.
TEST(ReflectionProbe, HidesFromEachReadWhatThatReadWouldSee) {
    const gpu::Device device{validated()};
    scene::Scene s = metal_floor();
    const auto shown = [&](realtime::ReflectionTechnique technique, const glm::vec3& to_eye) {
        realtime::RendererOptions o = options("best");
        o.profile.reflection = technique;
        return center(render_with(o, s, scene::look_at(3.0f * to_eye, {0, 0, 0}, 0.01f))).x;
    };
    for (const glm::vec2& view : {glm::vec2(0.3f, 0.2f), glm::vec2(0.6f, 0.2f), glm::vec2(0.8f, 0.5f)}) {
        s.materials[0].perceptual_roughness = view.x;
        const float sine = std::sqrt(1.0f - view.y * view.y);
        // The plane cuts the lobe along its middle: bright is what is nearer to the horizon than the mirror
        // direction.
        const glm::vec3 side(0.0f, -sine, -view.y);
        s.environment = half_sky(side);
        s.reflection_probes.clear();
        const glm::vec3 to_eye(0.0f, view.y, sine);
        const float open = shown(realtime::ReflectionTechnique::stretched_2, to_eye);
        s.reflection_probes = {half_probe(device, side)};
        const float one = shown(realtime::ReflectionTechnique::fitted_direction, to_eye);
        const float two = shown(realtime::ReflectionTechnique::stretched_2, to_eye);
        EXPECT_LT(two, 0.85f * one) << view.x;
        EXPECT_LT(two, open) << view.x;
    }
}

// What captures are lit by: light that a probe has seen everywhere stays on a white floor.
TEST(ReflectionProbe, UniformLightStaysOnDiffuseSurfaces) {
    scene::Scene s = metal_floor();
    s.materials[0] = grey(1.0f);
    s.environment = constant(100.0f);
    s.reflection_probes = {uniform_probe(1.0f, 100.0f, 0.6f)};
    s.reflection_probes[0].margin_m = s.reflection_probes[0].fade_m = 0.4f;
    const float basis = shading::sh_basis(0, glm::vec3(0.0f));
    s.reflection_probes[0].capture.irradiance_sh[0] = glm::vec4(60.0f, 60.0f, 60.0f, 0.6f) / basis;
    const realtime::Still still = render(s, scene::look_at({0, 3, 3}, {0, 0, 0}, 1.0f));
    for (const glm::vec4& nit : still.planes.light_nit) EXPECT_NEAR(nit.x, 100.0f, 1.5f);
}

TEST(ReflectionProbe, TheSmallerProbeIsAskedFirstAndTheSkyLast) {
    scene::Scene s = metal_floor();
    s.environment = constant(10.0f);
    s.reflection_probes = {uniform_probe(0.5f, 100.0f, 0.5f), uniform_probe(2.0f, 1000.0f, 0.75f)};
    const realtime::Still still = render(s, scene::look_at({0, 3, 0.01f}, {0, 0, 0}, 0.1f));
    EXPECT_NEAR(center(still).x, 0.5f * 100.0f + 0.25f * 1000.0f + 0.25f * 10.0f, 3.0f);
}

// Unlit colours are display-referred and no light, in the path tracer's bounces as in probes.
TEST(ReflectionProbe, SeesUnlitSurfacesAsBlackAndThere) {
    for (const scene::AlphaMode mode :
         {scene::AlphaMode::opaque, scene::AlphaMode::mask, scene::AlphaMode::blend}) {
        scene::Material card = grey(1.0f);
        card.unlit = true;
        card.double_sided = true;
        card.alpha_mode = mode;
        scene::Scene s;
        s.materials.push_back(card);
        place(s, square(1.0f), glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, -0.5f}));
        s.environment = constant(100.0f);
        s.lights = {sun(1000.0f)};
        s.reflection_probes = {uniform_probe(2.0f, 0.0f, 0.0f)};
        const gpu::Device device{validated()};
        realtime::ProbeCaptureOptions o;
        o.profile = options("best").profile;
        o.face_texels = 16;
        const std::vector<bake::ProbeFaces> faces = realtime::capture_probe_faces(device, s, o);
        int seen = 0;
        for (const auto& face : faces[0].faces) {
            for (const glm::vec4& texel : face) {
                EXPECT_EQ(glm::vec3(texel), glm::vec3(0.0f));
                seen += texel.w > 0.5f ? 1 : 0;
            }
        }
        EXPECT_GT(seen, 200) << "it covers the sky behind it";
        EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    }
}
