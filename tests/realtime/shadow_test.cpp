// The shadow maps: what touches, what is thin, what is curved, what moves.
#include <gtest/gtest.h>

#include <functional>

#include "candela/realtime/shadow_plan.hpp"
#include "candela/realtime/shadow_views.hpp"
#include "candela/realtime/visible_depths.hpp"
#include "common/contact_scenes.hpp"
#include "render_scenes.hpp"

using namespace candela;
using namespace candela::test;
using scene::LightType;

namespace {

struct Pictures {
    realtime::Still with;
    realtime::Still without;

    /// Visible share of the light at a pixel.
    [[nodiscard]] float visibility(std::size_t pixel) const {
        return with.planes.light_nit[pixel].x / without.planes.light_nit[pixel].x;
    }
};

realtime::Still render(const gpu::Device& device, const scene::Scene& s, const scene::Camera& camera,
                       realtime::RendererOptions o, bool shadows) {
    o.shadows.maps = shadows;
    realtime::Renderer renderer(device, s, o);
    return renderer.render_still(camera, fixed_ev(8.0f));
}

/// The lights' cheapest estimates, so that little is compiled, with the best shadows.
realtime::RendererOptions shadow_options(std::uint32_t size, std::uint32_t samples = 1) {
    realtime::RendererOptions o = options("ue4", size, samples);
    o.profile.shadow_filter = realtime::ShadowFilterTechnique::pcss;
    // That by light position lights what faces away from a light, where there is no visibility.
    o.profile.area_diffuse = realtime::AreaDiffuseTechnique::exact;
    return o;
}

const gpu::Device& device() {
    static const gpu::Device shared{validated()};
    return shared;
}

Pictures pictures(const scene::Scene& s, const scene::Camera& camera, std::uint32_t size,
                  std::uint32_t samples = 1) {
    const realtime::RendererOptions o = shadow_options(size, samples);
    Pictures out{render(device(), s, camera, o, true), render(device(), s, camera, o, false)};
    EXPECT_TRUE(device().validation_messages().empty()) << device().validation_messages().front();
    return out;
}

/// Mean over mean, and the largest difference of a pixel as a share of the brightest.
struct Difference {
    double mean = 0.0;
    double largest = 0.0;
};
Difference difference(const Pictures& p) {
    double with = 0.0;
    double without = 0.0;
    double largest = 0.0;
    double brightest = 0.0;
    for (std::size_t i = 0; i < p.with.planes.light_nit.size(); ++i) {
        const double a = p.with.planes.light_nit[i].x;
        const double b = p.without.planes.light_nit[i].x;
        with += a;
        without += b;
        largest = std::max(largest, std::abs(a - b));
        brightest = std::max(brightest, b);
    }
    EXPECT_GT(without, 0.0);
    return {std::abs(with - without) / without, largest / brightest};
}

/// Straight down on the ground from a parallel camera: pixel (x, y) shows x in [-half_m, half_m].
scene::Camera map_camera(float half_m, float height_m = 5.0f) {
    scene::Camera c;
    c.world = glm::mat4({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0.0f, height_m, 0.0f, 1.0f});
    c.projection = scene::Projection::orthographic;
    c.xmag_m = c.ymag_m = half_m;
    c.zfar_m = 10.0f;
    return c;
}

scene::Light a_light(LightType type) {
    scene::Light l = light_at(type, {1.0f, 2.5f, 1.5f}, glm::vec3(0.0f), 100.0f);
    l.radius_m = 0.1f;
    l.half_width_m = 0.3f;
    l.half_height_m = 0.2f;
    l.inner_cone_rad = 0.7f;
    l.outer_cone_rad = 0.8f;
    l.horizontal_angle_rad = l.vertical_angle_rad = 1.6f;
    // About as bright as 100 cd from there.
    if (scene::is_distant(type)) l.intensity = 10.0f;
    if (type == LightType::sphere || type == LightType::disk) l.intensity = 3000.0f;
    if (type == LightType::rectangle) l.intensity = 400.0f;
    if (type == LightType::tube) l.intensity = 700.0f;
    return l;
}

/// One light of every type, a few at a time: a renderer for each would spend its time compiling. No light is
/// more than kLightsAtOnce times brighter than another.
constexpr double kLightsAtOnce = 10.0;
std::vector<std::vector<scene::Light>> every_light() {
    std::vector<std::vector<scene::Light>> groups;
    for (const std::vector<LightType>& types :
         {std::vector{LightType::point, LightType::spot, LightType::directional, LightType::frustum},
          std::vector{LightType::line, LightType::sun, LightType::sphere},
          std::vector{LightType::disk, LightType::rectangle, LightType::tube}}) {
        groups.emplace_back();
        for (const LightType type : types) groups.back().push_back(a_light(type));
    }
    return groups;
}

}  // namespace

TEST(Shadow, ALitPlaneDoesNotShadowItself) {
    for (const std::vector<scene::Light>& lights : every_light()) {
        scene::Scene s = ground(2.0f);
        s.lights = lights;
        const Difference d = difference(pictures(s, scene::look_at({0, 2, 3}, {0, 0, 0}, 0.7f), 48));
        EXPECT_LT(d.largest, 1e-3 / kLightsAtOnce) << scene::name_of(lights[0].type) << " and others";
    }
}

TEST(Shadow, ACoarseSphereDoesNotShadowItsLitSide) {
    for (const std::vector<scene::Light>& lights : every_light()) {
        scene::Scene s;
        s.materials.push_back(grey(0.5f));
        place(s, sphere(0.8f, 0, 24, 12), at({0.0f, 0.0f, 0.0f}));
        s.lights = lights;
        const Difference d = difference(pictures(s, scene::look_at({0, 1, 3}, {0, 0, 0}, 0.7f), 64));
        EXPECT_LT(d.mean, 0.01 / 3.0) << scene::name_of(lights[0].type) << " and others";
    }
}

TEST(Shadow, NothingLeaksIntoAClosedBox) {
    for (const std::vector<scene::Light>& lights : every_light()) {
        scene::Scene s;
        s.materials.push_back(grey(0.5f));
        // Six walls of 15 cm about a room of 1 m, seen from inside.
        for (int axis = 0; axis < 3; ++axis) {
            for (const float side : {-1.0f, 1.0f}) {
                glm::vec3 half(0.65f);
                half[axis] = 0.075f;
                glm::vec3 middle(0.0f);
                middle[axis] = side * 0.575f;
                place(s, box(half), at(middle));
            }
        }
        s.lights = lights;
        scene::Camera camera = scene::look_at({0.4f, 0.3f, 0.4f}, {-0.3f, -0.3f, -0.3f}, 1.6f);
        const Pictures p = pictures(s, camera, 64);
        float most = 0.0f;
        float brightest = 0.0f;
        for (std::size_t i = 0; i < p.with.planes.light_nit.size(); ++i) {
            most = std::max(most, p.with.planes.light_nit[i].x);
            brightest = std::max(brightest, p.without.planes.light_nit[i].x);
        }
        EXPECT_GT(brightest, 0.0f);
        // A pixel at an inner edge may show a little of a light: its square has few lookups there.
        const bool soft = lights[0].type != LightType::point;
        EXPECT_LE(most, soft ? 0.03f * brightest : 0.0f) << scene::name_of(lights[0].type) << " and others";
    }
}

// The shadow of a box that stands on the ground begins at the box: nothing lit between the two.
TEST(Shadow, AShadowStartsAtItsCaster) {
    scene::Scene s = ground(2.0f);
    place(s, box({0.2f, 0.2f, 0.2f}), at({-0.2f, 0.2f, 0.0f}));
    scene::Light sun_light = light_at(LightType::sun, {-2.0f, 2.0f, 0.0f}, glm::vec3(0.0f), 1000.0f);
    s.lights = {sun_light};
    // The box ends at x = 0; its shadow, as long as it is high, at x = 0.4.
    const std::uint32_t size = 200;
    const Pictures p = pictures(s, map_camera(0.5f), size);
    const auto at_x = [&](float x_m) {
        return p.visibility(std::size_t{size / 2} * size + static_cast<std::size_t>((x_m + 0.5f) * 200.0f));
    };
    for (float x = 0.01f; x < 0.38f; x += 0.005f) EXPECT_LT(at_x(x), 0.01f) << x;
    for (float x = 0.42f; x < 0.49f; x += 0.005f) EXPECT_GT(at_x(x), 0.99f) << x;
}

TEST(Shadow, AnAlphaMaskIsWhatCasts) {
    scene::Scene s = ground(2.0f);
    scene::Material fence = grey(0.5f);
    fence.alpha_mode = scene::AlphaMode::mask;
    fence.double_sided = true;
    fence.base_color_texture.texture = 0;
    s.textures.push_back({});
    s.textures[0].image = 0;
    s.textures[0].sampler.magnify = s.textures[0].sampler.minify = scene::Filter::nearest;
    // Left half solid, right half open.
    s.images.push_back({"half", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}});
    s.materials.push_back(fence);
    place(s, square(0.4f, 1),
          at({0.0f, 1.0f, 0.0f}) * glm::rotate(glm::mat4(1.0f), -1.57079633f, {1.0f, 0.0f, 0.0f}));
    s.lights = {light_at(LightType::directional, {0.0f, 3.0f, 0.0f}, glm::vec3(0.0f), 1000.0f)};
    // From the side, so that the fence hides nothing of what is looked at.
    const scene::Camera camera = scene::look_at({0.0f, 0.6f, 1.6f}, {0.0f, 0.0f, 0.0f}, 0.5f);
    const Pictures p = pictures(s, camera, 64);
    const auto row = std::size_t{34} * 64;
    EXPECT_LT(p.visibility(row + 20), 0.01f);
    EXPECT_GT(p.visibility(row + 44), 0.99f);
}

TEST(Shadow, BlendedSurfacesAndLightsThatSaySoCastNone) {
    scene::Scene s = ground(2.0f);
    scene::Material glass = grey(0.5f);
    glass.alpha_mode = scene::AlphaMode::blend;
    glass.base_color.a = 0.5f;
    s.materials.push_back(glass);
    place(s, box({0.1f, 0.1f, 0.1f}, 1), at({0.0f, 3.0f, 0.0f}));
    place(s, box({0.1f, 0.1f, 0.1f}), at({0.5f, 3.0f, 0.0f}));
    s.lights = {light_at(LightType::directional, {0.0f, 3.0f, 0.0f}, glm::vec3(0.0f), 1000.0f)};
    scene::Camera camera = map_camera(1.0f, 2.0f);  // under the boxes
    Pictures p = pictures(s, camera, 64);
    EXPECT_GT(p.visibility(std::size_t{32} * 64 + 32), 0.99f);
    EXPECT_LT(p.visibility(std::size_t{32} * 64 + 48), 0.01f);
    s.lights[0].casts_shadow = false;
    p = pictures(s, camera, 64);
    EXPECT_GT(p.visibility(std::size_t{32} * 64 + 48), 0.99f);
}

// The penumbra of a straight edge at height d_r - d_b above the ground under a rectangle of width w, d_r
// above it: w (d_r - d_b) / d_b wide, and light falls off along it as the light's width is uncovered:
// linearly.
TEST(Shadow, APenumbraIsAsWideAsTheLightMakesIt) {
    scene::Scene s = ground(4.0f);
    const float d_r = 2.0f;
    const float d_b = 1.5f;
    // A plate whose edge is at x = 0, above a camera that looks at the ground from below it.
    place(s, box({1.0f, 0.002f, 3.0f}), at({-1.0f, d_r - d_b, 0.0f}));
    scene::Light light = light_at(LightType::rectangle, {0.0f, d_r, 0.0f}, {0.0f, 0.0f, 0.0f}, 1000.0f);
    light.right = {1.0f, 0.0f, 0.0f};
    light.half_width_m = 0.3f;
    light.half_height_m = 0.3f;
    s.lights = {light};
    const std::uint32_t size = 128;
    const Pictures p = pictures(s, map_camera(0.3f, 0.4f), size, 64);
    const float width_m = 2.0f * light.half_width_m * (d_r - d_b) / d_b;
    float ten = 1.0f;
    float ninety = 1.0f;
    for (std::uint32_t x = 0; x < size; ++x) {
        float mean = 0.0f;
        for (std::uint32_t y = 48; y < 80; ++y) mean += p.visibility(std::size_t{y} * size + x) / 32.0f;
        const float x_m = (static_cast<float>(x) + 0.5f) / size * 0.6f - 0.3f;
        if (mean < 0.1f) ten = x_m;
        if (mean < 0.9f) ninety = x_m;
    }
    EXPECT_NEAR(ninety - ten, 0.8f * width_m, 0.15f * width_m);
    EXPECT_NEAR(0.5f * (ten + ninety), 0.0f, 0.1f * width_m);
}

// A camera that moves by a fraction of a texel sees the same cascades, moved by whole texels if at all.
TEST(Shadow, CascadesStayOnTheirTexels) {
    scene::Aabb bounds;
    bounds.extend({-50.0f, 0.0f, -50.0f});
    bounds.extend({50.0f, 5.0f, 50.0f});
    const scene::Light light = light_at(LightType::sun, {2.0f, 3.0f, 1.0f}, glm::vec3(0.0f), 1000.0f);
    realtime::LightShadow shadow{0, realtime::ShadowKind::cascades, {}};
    for (auto& tile : shadow.tiles) tile.size = 1024;
    const auto views = [&](float step_m) {
        const glm::vec3 eye(step_m, 2.0f, 10.0f + 0.3f * step_m);
        const scene::Camera camera = scene::look_at(eye, eye + glm::vec3(0.1f, -0.2f, -1.0f), 0.7f);
        return realtime::cascade_views(light, shadow, camera, 1.6f, bounds,
                                       realtime::visible_depths_m(camera, 1.6f, std::array{bounds}));
    };
    const realtime::LightViews before = views(0.0f);
    ASSERT_EQ(before.records.size(), realtime::kCascades);
    for (const float step_m : {0.0007f, 0.0113f, 0.131f}) {
        const realtime::LightViews after = views(step_m);
        ASSERT_EQ(after.records.size(), before.records.size());
        for (std::size_t i = 0; i < after.records.size(); ++i) {
            const float texel = before.records[i].numbers.w;
            ASSERT_EQ(after.records[i].numbers.w, texel);
            for (const auto member : {&realtime::ShadowRecord::right, &realtime::ShadowRecord::up}) {
                const float moved = ((after.records[i].*member).w - (before.records[i].*member).w) / texel;
                EXPECT_NEAR(moved, std::round(moved), 2e-3f) << "cascade " << i;
            }
        }
    }
}

// A picture of things on a ground that goes on for 200 m and that the picture cuts off: no texel of what is
// seen is wider than 3.5 of its pixels.
TEST(Shadow, CascadesAreForWhatIsSeenOfALargeGround) {
    const scene::Camera camera = scene::look_at({0.35f, 1.35f, 3.4f}, {0.0f, 0.4f, 0.0f}, 0.471f);
    scene::Aabb ground;
    ground.extend({-100.0f, -0.01f, -100.0f});
    ground.extend({100.0f, 0.0f, 100.0f});
    scene::Aabb thing;
    thing.extend({-1.0f, 0.0f, -0.5f});
    thing.extend({1.0f, 0.7f, 0.5f});
    scene::Aabb bounds = ground;
    bounds.extend(thing);
    const scene::Light light = light_at(LightType::sun, {2.0f, 3.0f, 1.0f}, glm::vec3(0.0f), 1000.0f);
    realtime::LightShadow shadow{0, realtime::ShadowKind::cascades, {}};
    for (auto& tile : shadow.tiles) tile.size = 1024;
    const float aspect = 1280.0f / 720.0f;
    const glm::vec2 seen_m = realtime::visible_depths_m(camera, aspect, std::array{ground, thing});
    const realtime::LightViews views = realtime::cascade_views(light, shadow, camera, aspect, bounds, seen_m);
    const glm::vec3 eye(camera.world[3]);
    for (float depth_m = seen_m.x; depth_m < seen_m.y; depth_m *= 1.1f) {
        const glm::vec3 p = eye - depth_m * glm::vec3(camera.world[2]);
        const auto holds = [&](const realtime::ShadowRecord& r) {
            const float x = (glm::dot(glm::vec3(r.right), p) + r.right.w) / r.numbers.w;
            const float y = (glm::dot(glm::vec3(r.up), p) + r.up.w) / r.numbers.w;
            return std::max(std::abs(x), std::abs(y)) < r.numbers.z;
        };
        const auto first = std::find_if(views.records.begin(), views.records.end(), holds);
        ASSERT_NE(first, views.records.end()) << depth_m;
        const float pixel_m = 2.0f * depth_m * std::tan(0.5f * camera.yfov_rad) / 720.0f;
        EXPECT_LT(first->numbers.w, 3.5f * pixel_m) << depth_m;
    }
}

TEST(Shadow, TilesShareTheAtlasWithoutOverlap) {
    std::vector<realtime::ShadowRequest> requests;
    for (std::uint32_t i = 0; i < 40; ++i) {
        requests.push_back(
            {i, static_cast<realtime::ShadowKind>(i % 3), 64u << (i % 5), static_cast<float>(i)});
    }
    const realtime::ShadowPlan plan = realtime::plan_shadows(requests, 2048);
    EXPECT_EQ(plan.unshadowed, 0u);
    EXPECT_LE(plan.atlas_texels, 2048u);
    std::vector<char> taken(std::size_t{32} * 32, 0);
    for (const realtime::LightShadow& light : plan.lights) {
        for (std::uint32_t t = 0; t < realtime::shadow_tiles(light.kind); ++t) {
            const realtime::AtlasTile& tile = light.tiles[t];
            ASSERT_GE(tile.size, 64u);
            for (std::uint32_t y = tile.y / 64; y < (tile.y + tile.size) / 64; ++y) {
                for (std::uint32_t x = tile.x / 64; x < (tile.x + tile.size) / 64; ++x) {
                    EXPECT_EQ(taken.at(std::size_t{y} * 32 + x)++, 0);
                }
            }
        }
    }
}

// Cascades cover the picture: when the atlas is full, other lights shrink first, and those first that cover
// little of it.
TEST(Shadow, AFullAtlasShrinksWhatCoversLittle) {
    using realtime::ShadowKind;
    const std::vector<realtime::ShadowRequest> requests{
        {0, ShadowKind::cascades, 512, std::numeric_limits<float>::infinity(), 1.0f},
        {1, ShadowKind::perspective, 1024, 3.0f, 1.0f},
        {2, ShadowKind::perspective, 1024, 2.0f, 0.1f}};
    const auto size_of = [](const realtime::ShadowPlan& plan, std::uint32_t light) {
        for (const realtime::LightShadow& l : plan.lights)
            if (l.light == light) return l.tiles[0].size;
        return 0u;
    };
    // 4 * 512^2 + 1024^2 + 1024^2 texels wanted, of 2048^2 and then of 1024^2.
    EXPECT_EQ(size_of(realtime::plan_shadows(requests, 2048), 2), 1024u);
    const realtime::ShadowPlan plan = realtime::plan_shadows(requests, 1024);
    EXPECT_EQ(plan.unshadowed, 0u);
    EXPECT_EQ(size_of(plan, 0), 256u);
    EXPECT_EQ(size_of(plan, 1), 512u);
    EXPECT_EQ(size_of(plan, 2), 512u);
    std::vector<realtime::ShadowRequest> fewer = requests;
    fewer[0].size = 256;
    fewer[1].size = 512;
    const realtime::ShadowPlan roomy = realtime::plan_shadows(fewer, 1024);
    EXPECT_EQ(size_of(roomy, 0), 256u);
    EXPECT_EQ(size_of(roomy, 1), 512u);
    EXPECT_EQ(size_of(roomy, 2), 512u);
}

TEST(Shadow, AFullAtlasServesTheMostImportantLights) {
    std::vector<realtime::ShadowRequest> requests;
    for (std::uint32_t i = 0; i < 30; ++i)
        requests.push_back({i, realtime::ShadowKind::cube, 256, static_cast<float>(i)});
    const realtime::ShadowPlan plan = realtime::plan_shadows(requests, 512);
    // 64 tiles of the smallest size: ten lights of six.
    EXPECT_EQ(plan.lights.size(), 10u);
    EXPECT_EQ(plan.unshadowed, 20u);
    for (const realtime::LightShadow& light : plan.lights) EXPECT_GE(light.light, 20u);
}
