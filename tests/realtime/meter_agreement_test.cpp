// The automatic exposure of the frame against that of the path tracer, over scenes that are hard to meter.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "candela/realtime/exposure_meter.hpp"
#include "candela/truth/render_path.hpp"
#include "render_scenes.hpp"
#include "shading/exposure.glsl"

using namespace candela;
using namespace candela::test;

namespace {

constexpr float kPi = 3.14159265f;
constexpr std::uint32_t kSize = 128;

float frame_ev100(const scene::Scene& s, const scene::Camera& camera) {
    static const gpu::Device device(validated());
    realtime::Renderer renderer(device, s, options("best", kSize));
    const realtime::Still still = renderer.render_still(camera, {});
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    EXPECT_TRUE(still.metered);
    return still.ev100;
}

/// Of direct light: what surfaces reflect on each other is another technique's matter.
float path_ev100(const scene::Scene& s, const scene::Camera& camera) {
    truth::PathRenderOptions o;
    o.path.techniques = shading::techniques_best();
    o.path.direct_only = true;
    o.width = o.height = kSize;
    o.samples = 32;
    const auto team = truth::join_team();
    const truth::PathRender render = truth::render_path(s, camera, o, *team);
    std::vector<glm::vec4> nit;
    for (std::uint32_t i = 0; i < kSize * kSize; ++i) {
        const double* p = render.film.pixel(i % kSize, i / kSize);
        const glm::dvec4 mean =
            glm::dvec4(p[0], p[1], p[2], double(o.samples) - p[truth::FilmLayout::unlit + 3]) /
            double(o.samples);
        nit.emplace_back(mean);
    }
    const std::optional<float> ev100 = realtime::metered_ev100(std::span<const glm::vec4>(nit));
    EXPECT_TRUE(ev100);
    return ev100.value_or(0.0f);
}

void add(scene::Scene& s, scene::Primitive shape, const scene::Material& material, const glm::mat4& world) {
    s.materials.push_back(material);
    shape.material = static_cast<std::uint32_t>(s.materials.size() - 1);
    s.meshes.push_back({"", {std::move(shape)}});
    s.instances.push_back({"", static_cast<std::uint32_t>(s.meshes.size() - 1), world});
}

/// Six walls of a cube that face inwards.
void add_room(scene::Scene& s, float half_m, const scene::Material& material) {
    const glm::vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (const glm::vec3& inward : axes) {
        const glm::vec3 up = std::abs(inward.y) > 0.5f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
        glm::mat4 world(1.0f);
        world[2] = glm::vec4(inward, 0.0f);
        world[0] = glm::vec4(glm::cross(up, inward), 0.0f);
        world[1] = glm::vec4(up, 0.0f);
        world[3] = glm::vec4(-half_m * inward, 1.0f);
        add(s, square(half_m), material, world);
    }
}

scene::Light lamp(const glm::vec3& position, float power_lm) {
    scene::Light light;
    light.type = scene::LightType::point;
    light.position = position;
    light.intensity = power_lm / (4.0f * kPi);
    return light;
}

scene::Light spot_down(const glm::vec3& position, float intensity_cd, float half_angle_rad) {
    scene::Light light;
    light.type = scene::LightType::spot;
    light.position = position;
    light.direction = {0, -1, 0};
    light.intensity = intensity_cd;
    light.outer_cone_rad = half_angle_rad;
    light.inner_cone_rad = 0.8f * half_angle_rad;
    return light;
}

scene::Material glowing(float nit) {
    scene::Material m = grey(0.0f);
    m.emissive_nit = glm::vec3(nit);
    return m;
}

const glm::mat4 kLying = glm::rotate(glm::mat4(1.0f), -0.5f * kPi, {1.0f, 0.0f, 0.0f});
const glm::mat4 kStanding(1.0f);

struct Case {
    const char* name;
    scene::Scene scene;
    scene::Camera camera;
};

Case lit_pool() {
    Case c{"a lit pool on a dark floor", {}, scene::look_at({0, 2, 4}, {0, 0, 0}, 0.9f)};
    add(c.scene, square(20.0f), grey(0.5f), kLying);
    c.scene.environment = constant(2.0e-5f);
    c.scene.environment->visible = false;
    c.scene.lights = {spot_down({0, 3, 0}, 200.0f, 0.3f)};
    return c;
}

Case unlit_beside_lit() {
    Case c{"an unlit card beside a lit one", {}, scene::look_at({0, 0, 4}, {0, 0, 0}, 0.6f)};
    add(c.scene, square(1.0f), grey(0.5f), glm::translate(kStanding, {-1.0f, 0, 0}));
    scene::Material white = grey(1.0f);
    white.unlit = true;
    add(c.scene, square(1.0f), white, glm::translate(kStanding, {1.0f, 0, 0}));
    c.scene.lights = {sun(0.05f)};
    return c;
}

Case room_with_window() {
    Case c{"a room with a window", {}, scene::look_at({0.8f, 0, 1.4f}, {-0.2f, 0, -1.5f}, 1.0f)};
    add_room(c.scene, 1.5f, grey(0.4f));
    add(c.scene, square(0.5f), glowing(3000.0f), glm::translate(kStanding, {-0.4f, 0.2f, -1.49f}));
    c.scene.lights = {lamp({0.5f, 1.0f, 0.5f}, 100.0f)};
    return c;
}

Case night_street() {
    Case c{"a street at night", {}, scene::look_at({0, 1.7f, 12}, {0, 1.5f, 0}, 0.9f)};
    add(c.scene, square(40.0f), grey(0.1f), kLying);
    add(c.scene, square(6.0f), grey(0.3f), glm::translate(kStanding, {-8.0f, 3.0f, -8.0f}));
    for (int i = 0; i < 3; ++i) {
        add(c.scene, square(0.5f), glowing(150.0f),
            glm::translate(kStanding, {-10.0f + 2.5f * float(i), 4.0f, -7.95f}));
        c.scene.lights.push_back(spot_down({3.0f, 6.0f, 6.0f - 8.0f * float(i)}, 3000.0f, 0.9f));
    }
    c.scene.environment = constant(1.0e-3f);
    return c;
}

/// The sun is outside and comes in nowhere.
Case closed_room() {
    Case c{
        "a closed room with a lamp of 5 lm", {}, scene::look_at({1.6f, 0.4f, 1.6f}, {-1, -0.6f, -1}, 1.2f)};
    scene::Material wall = grey(0.5f);
    wall.double_sided = true;
    add_room(c.scene, 1.75f, wall);
    c.scene.lights = {lamp({0, 0, 0}, 5.0f), sun(100000.0f)};
    c.scene.lights[1].direction = glm::normalize(glm::vec3(0.3f, -0.9f, -0.4f));
    return c;
}

}  // namespace

TEST(MeterAgreement, TheFrameAndThePathTracerMeterAlike) {
    for (const Case& c :
         {lit_pool(), unlit_beside_lit(), room_with_window(), night_street(), closed_room()}) {
        EXPECT_NEAR(frame_ev100(c.scene, c.camera), path_ev100(c.scene, c.camera), 0.1f) << c.name;
    }
}

// EV -3.57 by a lamp of 5 lm. Walls of albedo 0.5 receive 5 lm over 6 x 3.5 m x 3.5 m in the
// mean, 0.0108 cd/m^2 or EV -3.53; a brighter floor in the middle of the picture is the rest.
TEST(MeterAgreement, AClosedRoomIsMeteredByItsLampAndNotByTheSunOutside) {
    const Case c = closed_room();
    const float mean_nit = 0.5f / kPi * 5.0f / (6.0f * 3.5f * 3.5f);
    EXPECT_NEAR(shading::ev100_from_luminance(mean_nit), -3.57f, 0.05f);
    EXPECT_NEAR(frame_ev100(c.scene, c.camera), -3.57f, 0.35f);
    EXPECT_NEAR(path_ev100(c.scene, c.camera), -3.57f, 0.35f);
}
