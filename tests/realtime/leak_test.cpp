// Closed rooms under lights that stand outside: nothing may shine on their inner sides, however thin the
// walls are.
#include <gtest/gtest.h>

#include "common/contact_scenes.hpp"
#include "render_scenes.hpp"

using namespace candela;
using namespace candela::test;
using scene::LightType;

namespace {

constexpr std::uint32_t kSize = 96;

/// A cube of six boxes, or of six sheets where the walls have no thickness, about the origin, on a wide
/// ground.
scene::Scene room(float size_m, float wall_m) {
    scene::Scene s;
    s.materials.push_back(grey(0.5f));
    s.materials[0].double_sided = true;
    const float half = 0.5f * size_m;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 n(0.0f);
            n[axis] = -side;
            if (wall_m > 0.0f) {
                glm::vec3 half_m(half + wall_m);
                half_m[axis] = 0.5f * wall_m;
                place(s, box(half_m), at(-(half + 0.5f * wall_m) * n));
                continue;
            }
            glm::vec3 u(0.0f);
            u[(axis + 1) % 3] = 1.0f;
            place(s, square(half),
                  {glm::vec4(u, 0.0f), glm::vec4(glm::cross(n, u), 0.0f), glm::vec4(n, 0.0f),
                   glm::vec4(-half * n, 1.0f)});
        }
    }
    const float lowest_m = -half - std::max(wall_m, 0.001f * size_m);
    place(s, square(3.0f * size_m),
          at({0.0f, lowest_m, 0.0f}) * glm::rotate(glm::mat4(1.0f), -1.57079633f, {1.0f, 0.0f, 0.0f}));
    return s;
}

/// A distant light and a local one at three places outside, each of 10 lx in the middle of the room.
void add_lights(scene::Scene& s, LightType distant, LightType local, float size_m) {
    for (const auto& [elevation, azimuth] : {std::pair{5.0f, 30.0f}, {25.0f, 125.0f}, {50.0f, 250.0f}}) {
        const float e = glm::radians(elevation);
        const float a = glm::radians(azimuth);
        const glm::vec3 way(std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a));
        for (const LightType type : {distant, local}) {
            const float distance_m = 1.5f * size_m;
            scene::Light light = light_at(type, distance_m * way, glm::vec3(0.0f), 10.0f);
            light.radius_m = 0.03f * size_m;
            if (type == LightType::point) light.intensity *= distance_m * distance_m;
            if (type == LightType::sphere) light.intensity *= 1.0f / (3.14159265f * 0.02f * 0.02f);
            s.lights.push_back(light);
        }
    }
}

realtime::RendererOptions leak_options(std::uint32_t size) {
    realtime::RendererOptions o = options("ue4", size, 1);
    o.profile.shadow_filter = realtime::ShadowFilterTechnique::pcss;
    o.profile.area_diffuse = realtime::AreaDiffuseTechnique::exact;
    return o;
}

/// Share of the room's pixels that show light, and that light as a share of what they would show without
/// shadows.
struct Leak {
    double pixels = 0.0;
    double light = 0.0;
};
Leak leak_into(const scene::Scene& s, float size_m) {
    static const gpu::Device device{validated()};
    realtime::RendererOptions o = leak_options(kSize);
    realtime::Renderer shadowed(device, s, o);
    o.shadows.maps = false;
    realtime::Renderer bare(device, s, o);
    // A thousandth of what a surface shows that faces one of the lights.
    constexpr float least_nit = 1e-3f * 10.0f * 0.5f / 3.14159265f;
    Leak leak;
    double all = 0.0;
    double pixels = 0.0;
    // Each sees three of the eight corners well.
    for (const glm::vec3& to : {glm::vec3(-1, 1, -1), {1, -1, -1}, {-1, -1, 1}, {1, 1, 1}}) {
        const scene::Camera camera = scene::look_at(-0.3f * size_m * to, 0.2f * size_m * to, 1.6f);
        const auto with = shadowed.render_still(camera, fixed_ev(8.0f)).planes.light_nit;
        const auto without = bare.render_still(camera, fixed_ev(8.0f)).planes.light_nit;
        for (std::size_t i = 0; i < with.size(); ++i) {
            pixels += 1.0;
            leak.pixels += with[i].x > least_nit ? 1.0 : 0.0;
            leak.light += with[i].x;
            all += without[i].x;
        }
    }
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    EXPECT_GT(all, 0.0);
    return {leak.pixels / pixels, leak.light / all};
}

struct Walls {
    float size_m;
    float wall_m;
    double pixels;  ///< bounds
    double light;
};
void expect_dark(LightType distant, LightType local, const Walls& walls) {
    scene::Scene s = room(walls.size_m, walls.wall_m);
    add_lights(s, distant, local, walls.size_m);
    const Leak leak = leak_into(s, walls.size_m);
    EXPECT_LE(leak.pixels, walls.pixels) << walls.size_m << " m, walls of " << walls.wall_m << " m";
    EXPECT_LE(leak.light, walls.light) << walls.size_m << " m, walls of " << walls.wall_m << " m";
}

}  // namespace

// Texels are 1.4 cm in a room of 4 m, 7 cm in one of 20 m. Walls of 0 m are sheets, on ground that goes on
// outside.
TEST(Leak, RoomsStayDarkUnderLightsWithoutExtent) {
    const double pixels = 5e-4;
    const double light = 1e-4;
    expect_dark(LightType::directional, LightType::point, {4.0f, 0.2f, 0.0, 0.0});
    expect_dark(LightType::directional, LightType::point, {20.0f, 0.2f, 1e-4, 2e-6});
    for (const auto& [size_m, wall_m] : {std::pair{4.0f, 0.01f}, {20.0f, 0.01f}, {4.0f, 0.0f}}) {
        expect_dark(LightType::directional, LightType::point, {size_m, wall_m, pixels, light});
    }
}

TEST(Leak, RoomsStayDarkUnderLightsWithExtent) {
    const double pixels = 1.2e-3;
    const double light = 2e-4;
    expect_dark(LightType::sun, LightType::sphere, {4.0f, 0.2f, 0.0, 0.0});
    expect_dark(LightType::sun, LightType::sphere, {20.0f, 0.2f, 1e-4, 2e-6});
    for (const auto& [size_m, wall_m] : {std::pair{4.0f, 0.01f}, {20.0f, 0.01f}, {4.0f, 0.0f}}) {
        expect_dark(LightType::sun, LightType::sphere, {size_m, wall_m, pixels, light});
    }
}

// Ways to a sun spread over more texels than the border of a cascade is wide: what they meet outside of it is
// not known, and is no light. Two rooms, one behind the other as the sun sees them.
TEST(Leak, TheBorderOfACascadeIsNotLit) {
    scene::Scene s;
    s.materials.push_back(grey(0.5f));
    const auto wall = [&](const glm::vec3& size_m, const glm::vec3& center) {
        place(s, box(0.5f * size_m), at(center));
    };
    for (const float side : {-1.0f, 1.0f}) {
        wall({4.0f, 0.2f, 5.0f}, {side * 2.1f, 2.9f, 0.0f});
        wall({0.2f, 2.8f, 5.0f}, {side * 4.2f, 1.4f, 0.0f});
        wall({0.2f, 2.8f, 1.8f}, {0.0f, 1.4f, side * 1.6f});
        for (const float z : {-2.6f, 2.6f}) wall({4.0f, 2.8f, 0.2f}, {side * 2.1f, 1.4f, z});
    }
    wall({8.6f, 0.2f, 5.4f}, {0.0f, -0.1f, 0.0f});
    const float e = glm::radians(20.0f);
    const glm::vec3 way(-0.70710678f * std::cos(e), std::sin(e), 0.70710678f * std::cos(e));
    s.lights = {light_at(LightType::sun, way, glm::vec3(0.0f), 10.0f)};
    s.lights[0].angular_diameter_rad = glm::radians(0.5329f);
    static const gpu::Device device{validated()};
    realtime::RendererOptions unshadowed = leak_options(256);
    unshadowed.shadows.maps = false;
    realtime::Renderer renderer(device, s, leak_options(256));
    realtime::Renderer without(device, s, unshadowed);
    const scene::Camera camera = scene::look_at({2.1f, 1.4f, 0.0f}, {4.1f, 0.3f, -2.5f}, 1.5707963f);
    const realtime::Still still = renderer.render_still(camera, fixed_ev(8.0f));
    for (const glm::vec4& light : still.planes.light_nit) ASSERT_EQ(light.x, 0.0f);
    EXPECT_GT(center(without.render_still(camera, fixed_ev(8.0f))).x, 0.1f);
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
}
