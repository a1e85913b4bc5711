#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "candela/truth/render_path.hpp"
#include "render_scenes.hpp"
#include "shading/environment.glsl"

using namespace candela;
using namespace candela::test;

namespace {

constexpr float kPi = 3.14159265f;
const scene::Camera kFront = scene::look_at({0, 0, 3}, {0, 0, 0}, 0.6f);

realtime::Still render(const scene::Scene& scene, const realtime::RendererOptions& renderer_options,
                       const scene::Camera& camera = kFront) {
    const gpu::Device device{validated()};
    realtime::Still still;
    {
        realtime::Renderer renderer(device, scene, renderer_options);
        still = renderer.render_still(camera, fixed_ev(10.0f));
    }
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    return still;
}

realtime::RendererOptions integrals(std::uint32_t samples, bool ray_shadows) {
    realtime::RendererOptions o = options("best", 16, samples);
    o.integrate.emplace().ray_shadows = ray_shadows;
    return o;
}

double mean(const realtime::Still& still) {
    double sum = 0.0;
    for (const glm::vec4& nit : still.planes.light_nit) sum += static_cast<double>(nit.y);
    return sum / static_cast<double>(still.planes.light_nit.size());
}

double mean_of_path(const scene::Scene& s, std::uint32_t samples, const scene::Camera& camera = kFront) {
    truth::PathRenderOptions o;
    o.path.techniques = shading::techniques_best();
    o.path.direct_only = true;
    o.width = o.height = 16;
    o.samples = samples;
    const auto team = truth::join_team();
    const truth::PathRender render = truth::render_path(s, camera, o, *team);
    double sum = 0.0;
    for (std::uint32_t i = 0; i < 256; ++i) sum += render.film.pixel(i % 16, i / 16)[1];
    return sum / (256.0 * samples);
}

std::uint8_t byte(float x) {
    return static_cast<std::uint8_t>(std::lround(255.0f * (0.5f + 0.5f * x)));
}

/// A wall whose map turns every normal by tilt_rad towards +X.
scene::Scene tilted_wall(float tilt_rad, const scene::Material& m) {
    scene::Scene s = scene_of(square(2.0f), m);
    s.images.push_back({"tilt", 1, 1, {byte(std::sin(tilt_rad)), 128, byte(std::cos(tilt_rad)), 255}});
    s.textures.push_back({0, {}});
    s.materials[0].normal_texture.texture = 0;
    return s;
}

/// A wall of grooves: normals lean by tilt_rad to the right and to the left, column by column of texels.
scene::Scene grooved_wall(float tilt_rad, const scene::Material& m) {
    scene::Scene s = tilted_wall(tilt_rad, m);
    s.images[0] = {"grooves",
                   2,
                   1,
                   {byte(std::sin(tilt_rad)), 128, byte(std::cos(tilt_rad)), 255, byte(-std::sin(tilt_rad)),
                    128, byte(std::cos(tilt_rad)), 255}};
    scene::Sampler nearest;
    nearest.magnify = nearest.minify = scene::Filter::nearest;
    nearest.mip = scene::MipFilter::none;
    s.textures[0].sampler = nearest;
    s.materials[0].normal_texture.scale = glm::vec2(8.0f);
    return s;
}

/// A board of cards with constant maps, one beside the other, for one picture of all.
struct Cards {
    static constexpr std::uint32_t kSide = 5;
    static constexpr std::uint32_t kPixels = 60;
    scene::Scene scene;
    std::vector<std::string> names;

    Cards() {
        for (const int degrees : {30, 45, 60}) {
            const scene::Scene wall = tilted_wall(float(degrees) * kPi / 180.0f, grey(0.5f));
            scene.images.push_back(wall.images[0]);
            scene.textures.push_back({static_cast<std::uint32_t>(scene.images.size() - 1), {}});
            for (const float roughness : {0.1f, 0.2f, 0.4f, 0.7f}) {
                for (const float metallic : {0.0f, 1.0f}) add(degrees, roughness, metallic);
            }
        }
    }
    void add(int degrees, float roughness, float metallic) {
        scene::Material m;
        // Black dielectrics: their highlight alone.
        m.base_color = metallic > 0.0f ? glm::vec4(1.0f) : glm::vec4(0, 0, 0, 1);
        m.metallic = metallic;
        m.perceptual_roughness = roughness;
        m.normal_texture.texture = static_cast<std::uint32_t>(scene.textures.size() - 1);
        const auto i = static_cast<std::uint32_t>(names.size());
        scene.materials.push_back(m);
        scene.meshes.push_back({"card", {square(0.5f, i)}});
        scene.instances.push_back({"card", i, glm::translate(glm::mat4(1.0f), middle(i))});
        names.push_back(std::to_string(degrees) + " degrees, roughness " + std::to_string(roughness) +
                        (metallic > 0.0f ? ", metal" : ", dielectric"));
    }
    static glm::vec3 middle(std::size_t i) {
        return {float(i % kSide) - 2.0f, float(i / kSide) - 2.0f, 0.0f};
    }
    [[nodiscard]] const std::string& name(std::size_t i) const { return names[i]; }
    [[nodiscard]] scene::Camera seen_from(const glm::vec3& eye) const {
        return scene::look_at(eye, {0, 0, 0}, 2.0f * std::atan(2.7f / glm::length(eye)));
    }
    /// The pixel in the middle of each card.
    [[nodiscard]] std::vector<std::size_t> pixels(const scene::Camera& camera) const {
        std::vector<std::size_t> out;
        for (std::size_t i = 0; i < names.size(); ++i) {
            const glm::vec4 clip = scene::view_projection(camera, 1.0f) * glm::vec4(middle(i), 1.0f);
            const glm::vec2 at = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * float(kPixels);
            out.push_back(std::size_t(at.y) * kPixels + std::size_t(at.x));
        }
        return out;
    }
    /// Of the nine pixels about one, which are all of its card.
    template <class Value>
    static double mean_about(std::size_t pixel, const Value& value) {
        double sum = 0.0;
        for (const std::size_t row : {pixel - kPixels, pixel, pixel + kPixels})
            sum += value(row - 1) + value(row) + value(row + 1);
        return sum / 9.0;
    }
    [[nodiscard]] std::vector<double> read(const realtime::Still& still, const scene::Camera& camera) const {
        std::vector<double> out;
        for (const std::size_t i : pixels(camera))
            out.push_back(mean_about(i, [&](std::size_t p) { return double(still.planes.light_nit[p].y); }));
        return out;
    }
    [[nodiscard]] std::vector<double> path(const scene::Scene& s, const scene::Camera& camera,
                                           std::uint32_t samples) const {
        truth::PathRenderOptions o;
        o.path.techniques = shading::techniques_best();
        o.path.direct_only = true;
        o.width = o.height = kPixels;
        o.samples = samples;
        const auto team = truth::join_team();
        const truth::PathRender render = truth::render_path(s, camera, o, *team);
        std::vector<double> out;
        for (const std::size_t i : pixels(camera)) {
            out.push_back(mean_about(i, [&](std::size_t p) {
                return render.film.pixel(std::uint32_t(p % kPixels), std::uint32_t(p / kPixels))[1] / samples;
            }));
        }
        return out;
    }
};

scene::Material plastic(float perceptual_roughness) {
    scene::Material m;
    m.base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
    m.metallic = 0.0f;
    m.perceptual_roughness = perceptual_roughness;
    return m;
}

}  // namespace

TEST(NormalMap, LightFromBelowTheSurfaceDoesNotCount) {
    scene::Scene s = tilted_wall(kPi / 3.0f, plastic(0.5f));
    scene::Light below = sun(1000.0f);
    below.direction = glm::normalize(glm::vec3(-1.0f, 0.0f, 0.1f));
    below.casts_shadow = false;
    scene::Light ball;
    ball.type = scene::LightType::sphere;
    ball.position = {1.0f, 0.0f, -0.3f};
    ball.radius_m = 0.2f;
    ball.intensity = 1000.0f;
    ball.casts_shadow = false;
    s.lights = {below, ball};
    for (realtime::RendererOptions o :
         {options("best", 16), options("ue4", 16), integrals(4, false), integrals(4, true)}) {
        EXPECT_EQ(mean(render(s, o)), 0.0);
    }
}

TEST(NormalMap, EveryModeLosesTheSameOfTheEnvironment) {
    for (const float tilt : {kPi / 6.0f, kPi / 3.0f}) {
        scene::Scene s = tilted_wall(tilt, grey(1.0f));
        s.environment = constant(100.0f);
        const double kept = 100.0 * 0.5 * (1.0 + std::cos(static_cast<double>(tilt)));
        EXPECT_NEAR(mean(render(s, options("best", 16))), kept, 0.01 * kept);
        EXPECT_NEAR(mean(render(s, integrals(64, true))), kept, 0.01 * kept);
        s.materials[0] = plastic(0.4f);
        s.materials[0].metallic = 1.0f;
        s.materials[0].normal_texture.texture = 0;
        const double path = mean_of_path(s, 64);
        EXPECT_NEAR(mean(render(s, integrals(64, true))), path, 0.01 * path) << tilt;
        EXPECT_NEAR(mean(render(s, options("best", 16))), path, 0.1 * path + 1.0) << tilt;
    }
}

// Cards side by side: maps of 30, 45 and 60 degrees, metal and dielectric, roughness 0.1 to 0.7.
TEST(NormalMap, ALobeCutByTheSurfaceKeepsWhatItsIntegralKeeps) {
    const Cards cards;
    for (const glm::vec3& from : {glm::vec3(0, 0, 60), glm::vec3(-42, 0, 42), glm::vec3(36, 30, 36)}) {
        const scene::Camera camera = cards.seen_from(from);
        // From there the mapped normals face away and are turned to the viewer.
        const bool away = from.x < 0.0f;
        scene::Scene s = cards.scene;
        s.environment = constant(100.0f);
        realtime::RendererOptions o = options("best", Cards::kPixels, 4);
        const std::vector<double> frame = cards.read(render(s, o, camera), camera);
        o.samples = 64;
        o.integrate.emplace();
        const std::vector<double> integral = cards.read(render(s, o, camera), camera);
        const std::vector<double> path = cards.path(s, camera, 128);
        double sum = 0.0;
        double sum_of_metals = 0.0;
        for (std::size_t i = 0; i < path.size(); ++i) {
            EXPECT_NEAR(integral[i], path[i], 0.04 * path[i] + 0.2) << cards.name(i);
            EXPECT_NEAR(frame[i], path[i], away ? 26.0 : 13.0) << cards.name(i);
            sum += std::abs(frame[i] - path[i]);
            if (i % 2 == 1) sum_of_metals += std::abs(frame[i] - path[i]);
        }
        const double count = static_cast<double>(path.size());
        RecordProperty("mean_" + std::to_string(int(from.x)), std::to_string(sum / count));
        EXPECT_LT(sum / count, away ? 4.5 : 3.0) << "of 100 cd/m2";
        EXPECT_LT(sum_of_metals / (0.5 * count), away ? 8.5 : 4.0);
    }
}

// What lies behind the surface is not reflected, however steep the map: a bright world behind a wall.
TEST(NormalMap, ALobeIsReadAboveTheSurface) {
    const Cards cards;
    scene::Scene s = cards.scene;
    s.environment = constant(10.0f);
    scene::Environment& e = *s.environment;
    for (std::uint32_t i = 0; i < e.width * e.height; ++i) {
        const glm::vec2 uv((float(i % e.width) + 0.5f) / float(e.width),
                           (float(i / e.width) + 0.5f) / float(e.height));
        if (shading::equirect_direction(uv).z < -0.1f) e.luminance_nit[i] = glm::vec3(100.0f);
    }
    const scene::Camera camera = cards.seen_from({0, 0, 60});
    const std::vector<double> frame =
        cards.read(render(s, options("best", Cards::kPixels, 4), camera), camera);
    const std::vector<double> path = cards.path(s, camera, 128);
    double sum = 0.0;
    for (std::size_t i = 0; i < path.size(); ++i) {
        EXPECT_LT(frame[i], path[i] + 12.0) << cards.name(i);
        sum += std::abs(frame[i] - path[i]);
    }
    RecordProperty("mean", std::to_string(sum / double(path.size())));
    EXPECT_LT(sum / double(path.size()), 3.0);
}

TEST(NormalMap, ASurfaceWithoutAMapIsTheSameBesideOneWithAMap) {
    scene::Material rough = plastic(0.8f);
    rough.metallic = 1.0f;
    for (const float width : {0.3f, 0.8f}) {
        rough.perceptual_roughness = width;
        scene::Scene alone = scene_of(square(2.0f), rough);
        alone.environment = constant(100.0f);
        scene::Scene beside = alone;
        const scene::Scene mapped = tilted_wall(0.5f, rough);
        beside.images = mapped.images;
        beside.textures = mapped.textures;
        beside.materials.push_back(mapped.materials[0]);
        beside.meshes.push_back({"mapped", {square(0.1f, 1)}});
        beside.instances.push_back({"mapped", 1, glm::translate(glm::mat4(1.0f), {0.0f, 50.0f, 0.0f})});
        const scene::Camera grazing = scene::look_at({3.0f, 0, 0.6f}, {0, 0, 0}, 0.1f);
        const double right = mean(render(alone, options("best", 16), grazing));
        EXPECT_NEAR(mean(render(beside, options("best", 16), grazing)), right, 0.005 * right) << width;
    }
}

TEST(NormalMap, ASteepMapNeitherShadowsNorLightsItsPlane) {
    scene::Scene s = grooved_wall(1.0f, plastic(0.6f));
    scene::Light front = sun(1000.0f);
    front.direction = glm::normalize(glm::vec3(-1.0f, -0.4f, -0.5f));
    s.lights = {front};
    for (const auto& from : {glm::vec3(0, 0, 3), glm::vec3(2, 0.5f, 1.2f)}) {
        const scene::Camera camera = scene::look_at(from, {0, 0, 0}, 0.6f);
        const realtime::Still with = render(s, options("best", 48), camera);
        realtime::RendererOptions o = options("best", 48);
        o.shadows.maps = false;
        const realtime::Still without = render(s, o, camera);
        ASSERT_GT(mean(without), 10.0);
        for (std::size_t i = 0; i < with.planes.light_nit.size(); ++i) {
            ASSERT_NEAR(with.planes.light_nit[i].y, without.planes.light_nit[i].y,
                        0.02f * without.planes.light_nit[i].y + 0.01f)
                << "pixel " << i % 48 << ", " << i / 48;
        }
    }
    s.lights[0].direction = glm::normalize(glm::vec3(-1.0f, -0.4f, 0.2f));
    EXPECT_EQ(mean(render(s, options("best", 48))), 0.0) << "from behind";
}

// The length of a mean is that of the normals before the scale and before they are rounded: of a map that is
// the same everywhere it is 1, and no highlight is widened.
TEST(NormalMap, AMapWithoutSpreadKeepsTheHighlight) {
    scene::Scene s = tilted_wall(kPi / 6.0f, plastic(0.2f));
    s.materials[0].normal_scale = 0.5f;
    const float tilt = std::atan(0.5f * std::tan(kPi / 6.0f));
    scene::Light light = sun(1000.0f);
    light.direction = -glm::vec3(std::sin(2.0f * tilt), 0.0f, std::cos(2.0f * tilt));
    light.casts_shadow = false;
    s.lights = {light};
    scene::Camera narrow = kFront;
    narrow.yfov_rad = 0.01f;
    const double path = mean_of_path(s, 16, narrow);
    for (const std::uint32_t size : {1u, 32u}) {
        const std::vector<std::uint8_t> texel = s.images[0].rgba;
        scene::Scene tiled = s;
        tiled.images[0] = {"tiled", size, size, {}};
        for (std::uint32_t i = 0; i < size * size; ++i)
            tiled.images[0].rgba.insert(tiled.images[0].rgba.end(), texel.begin(), texel.begin() + 4);
        tiled.materials[0].normal_texture.scale = glm::vec2(4000.0f);
        EXPECT_NEAR(mean(render(tiled, options("best", 16), narrow)), path, 0.03 * path) << size;
    }
}

// From afar, grooves are a rougher surface: nearer to the integral than the mean normal alone.
TEST(NormalMap, GroovesFromAfarAreRough) {
    for (const float scale : {1.0f, 0.5f}) {
        scene::Scene s = grooved_wall(0.4f, plastic(0.3f));
        s.textures[0].sampler = {};
        s.materials[0].normal_texture.scale = glm::vec2(500.0f);
        s.materials[0].normal_scale = scale;
        s.lights = {sun(1000.0f)};
        scene::Camera narrow = kFront;
        narrow.yfov_rad = 0.05f;
        const double path = mean_of_path(s, 256, narrow);
        const double frame = mean(render(s, options("best", 16), narrow));
        // Reads of level 0 that average both sides of a groove: without their length 1.29 stops at scale 1.
        EXPECT_LT(std::abs(std::log2(frame / path)), 0.5) << scale << ": " << frame << " against " << path;
        realtime::RendererOptions o = integrals(64, false);
        EXPECT_NEAR(mean(render(s, o, narrow)), path, 0.02 * path) << scale;
    }
}

TEST(Mask, CoversAsMuchFromAfarAsItDoes) {
    scene::Material m = grey(0.0f);
    m.emissive_nit = glm::vec3(100.0f);
    m.alpha_mode = scene::AlphaMode::mask;
    scene::Scene s = scene_of(square(2.0f), m);
    scene::Image fence{"fence", 64, 64, {}};
    for (int i = 0; i < 64 * 64; ++i) {
        const bool wire = i % 16 < 2 || i / 64 % 16 < 2;
        for (const int c : {255, 255, 255, wire ? 255 : 0})
            fence.rgba.push_back(static_cast<std::uint8_t>(c));
    }
    s.images.push_back(fence);
    s.textures.push_back({0, {}});
    s.materials[0].base_color_texture.texture = 0;
    for (const float repeats : {1.0f, 4.0f, 16.0f}) {
        s.materials[0].base_color_texture.scale = glm::vec2(repeats);
        const double path = mean_of_path(s, 64);
        EXPECT_GT(path, 15.0);
        EXPECT_NEAR(mean(render(s, options("best", 16, 64))), path, 0.1 * path) << repeats;
        EXPECT_NEAR(mean(render(s, integrals(64, false))), path, 0.03 * path) << repeats;
    }
}
