// Lights of every type in the mode integrate, against closed forms and against each other.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "render_scenes.hpp"

using namespace candela;
using namespace candela::test;
using realtime::Strategy;
using scene::LightType;

namespace {

constexpr double kPi = 3.14159265358979;

struct How {
    Strategy strategy = Strategy::both;
    bool rays = false;
    std::uint32_t size = 16;
    std::uint32_t samples = 64;
};

/// Renders with validation on and expects it to be silent.
realtime::Still render(const scene::Scene& scene, const scene::Camera& camera, const How& how) {
    realtime::RendererOptions o = options("best", how.size, how.samples);
    o.integrate.emplace();
    o.integrate->strategy = how.strategy;
    o.integrate->ray_shadows = how.rays;
    const gpu::Device device{validated()};
    realtime::Still still;
    {
        realtime::Renderer renderer(device, scene, o);
        still = renderer.render_still(camera, fixed_ev(10.0f));
    }
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    return still;
}

glm::dvec3 mean(const realtime::Still& still) {
    glm::dvec3 sum(0.0);
    for (const glm::vec4& nit : still.planes.light_nit) sum += glm::dvec3(nit);
    return sum / static_cast<double>(still.planes.light_nit.size());
}

/// Sees 2 cm of the plane z = 0 about the origin, from direction v.
scene::Camera spot_meter(const glm::vec3& v = {0.0f, 0.0f, 1.0f}, float half_m = 0.01f) {
    scene::Camera camera = scene::look_at(20.0f * v, {0, 0, 0}, 0.6f);
    camera.projection = scene::Projection::orthographic;
    camera.xmag_m = camera.ymag_m = half_m;
    camera.zfar_m = 100.0f;
    return camera;
}

/// On a grey plane: 1/2 / pi of the illuminance.
double illuminance_lx(const std::vector<scene::Light>& lights, const How& how = {}) {
    scene::Scene s = scene_of(square(20.0f), grey(0.5f));
    s.lights = lights;
    return mean(render(s, spot_meter(), how)).x * kPi / 0.5;
}

/// Above the origin of the plane, shining down.
scene::Light light_of(LightType type, float height_m = 2.0f) {
    scene::Light light;
    light.type = type;
    light.position = {0.0f, 0.0f, height_m};
    light.direction = {0.0f, 0.0f, -1.0f};
    light.right = {1.0f, 0.0f, 0.0f};
    light.intensity = 1000.0f;
    light.radius_m = 0.5f;
    light.half_width_m = 0.75f;
    light.half_height_m = 0.5f;
    light.angular_diameter_rad = 0.1f;
    light.visible = false;  // the meter looks through it
    return light;
}

/// Projected solid angle of a rectangle straight above, facing down: four corners about the foot point.
double rectangle_sr(double half_a, double half_b, double h) {
    const double a = half_a / h;
    const double b = half_b / h;
    const double ra = std::sqrt(1.0 + a * a);
    const double rb = std::sqrt(1.0 + b * b);
    return 2.0 * (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb));
}

void expect_by_every_strategy(const scene::Light& light, double expected_lx, const std::string& what) {
    for (const Strategy strategy : {Strategy::both, Strategy::light, Strategy::bsdf}) {
        const double seen = illuminance_lx({light}, {strategy, false, 16, 64});
        EXPECT_NEAR(seen / expected_lx, 1.0, strategy == Strategy::bsdf ? 0.01 : 0.005)
            << what << ", strategy " << static_cast<int>(strategy);
    }
}

}  // namespace

TEST(IntegrateLights, ShapesGiveTheirClosedForms) {
    const double L = 1000.0;
    expect_by_every_strategy(light_of(LightType::sphere), L * kPi * 0.25 / 4.0, "sphere");
    expect_by_every_strategy(light_of(LightType::disk), L * kPi * 0.25 / 4.25, "disk");
    expect_by_every_strategy(light_of(LightType::rectangle), L * rectangle_sr(0.75, 0.5, 2.0), "rectangle");
}

TEST(IntegrateLights, LightsWithoutASurfaceGiveTheirClosedForms) {
    EXPECT_NEAR(illuminance_lx({light_of(LightType::point)}) / 250.0, 1.0, 0.005);
    EXPECT_NEAR(illuminance_lx({light_of(LightType::frustum)}) / 250.0, 1.0, 0.005);
    scene::Light aside = light_of(LightType::frustum);
    aside.position.x = 1.0f;  // its pyramid's half angle is 22.5 degrees
    EXPECT_EQ(illuminance_lx({aside}), 0.0);
    // I / (2 a) times the integral of h^2 / (x^2 + h^2)^2 over the length, with sin(theta) = cos = h /
    // distance.
    const double a = 0.75;
    const double h = 2.0;
    const double angle = std::atan(a / h);
    const double line = 1000.0 / (2.0 * a) / h * (angle + std::sin(angle) * std::cos(angle)) / 2.0 * 2.0;
    EXPECT_NEAR(illuminance_lx({light_of(LightType::line)}) / line, 1.0, 0.005);
    for (const bool darkened : {false, true}) {
        scene::Light sun = light_of(LightType::sun);
        sun.limb_darkening = darkened;
        EXPECT_NEAR(illuminance_lx({sun}) / 1000.0, 1.0, 0.005);
    }
}

TEST(IntegrateLights, ShapesShineFromTheirBrightSideOnly) {
    for (const LightType type : {LightType::disk, LightType::rectangle}) {
        scene::Light light = light_of(type);
        const double front = illuminance_lx({light});
        light.direction = -light.direction;
        EXPECT_EQ(illuminance_lx({light}), 0.0);
        light.two_sided = true;
        EXPECT_NEAR(illuminance_lx({light}) / front, 1.0, 0.005);
    }
    scene::Light around = light_of(LightType::sphere, 0.1f);
    EXPECT_EQ(illuminance_lx({around}), 0.0);
}

// A shape in the way of another hides nothing, a triangle does.
TEST(IntegrateLights, OnlyTrianglesCastShadows) {
    scene::Light far_light = light_of(LightType::sphere);
    scene::Light near_light = light_of(LightType::sphere, 1.3f);
    near_light.intensity = 1e-3f;
    scene::Scene s = scene_of(square(20.0f), grey(0.5f));
    s.lights = {far_light, near_light};
    const auto lx = [&](bool rays) {
        return mean(render(s, spot_meter(glm::normalize(glm::vec3(1.0f, 0.0f, 0.3f))),
                           {Strategy::both, rays, 16, 32}))
                   .x *
               kPi / 0.5;
    };
    const double open = 1000.0 * kPi * 0.25 / 4.0;
    EXPECT_NEAR(lx(true) / open, 1.0, 0.005);
    s.meshes.push_back({"screen", {square(1.0f)}});
    s.instances.push_back({"screen", 1, glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, 0.5f))});
    EXPECT_EQ(lx(true), 0.0);
    EXPECT_NEAR(lx(false) / open, 1.0, 0.005);
    s.lights[0].casts_shadow = false;
    EXPECT_NEAR(lx(true) / open, 1.0, 0.005);
    // Half of the light goes through a pane of alpha 1/2.
    s.lights[0].casts_shadow = true;
    scene::Material pane = grey(0.5f);
    pane.base_color.a = 0.5f;
    pane.alpha_mode = scene::AlphaMode::blend;
    s.materials.push_back(pane);
    s.meshes[1].primitives[0].material = 1;
    EXPECT_NEAR(lx(true) / open, 0.5, 0.0025);
}

TEST(IntegrateLights, EachStrategyAloneConvergesToTheSamePicture) {
    scene::Material glossy = grey(0.6f);
    glossy.metallic = 1.0f;
    glossy.perceptual_roughness = 0.5f;
    scene::Scene s = scene_of(square(20.0f), glossy);
    s.lights = {light_of(LightType::sphere), light_of(LightType::disk), light_of(LightType::rectangle),
                light_of(LightType::tube), light_of(LightType::sun)};
    for (std::size_t i = 0; i < s.lights.size(); ++i) {
        const float across = 1.1f * (static_cast<float>(i) - 2.0f);
        s.lights[i].position = {-1.0f, across, 1.5f};
        s.lights[i].direction = -glm::normalize(s.lights[i].position);
        s.lights[i].right = glm::normalize(glm::cross(s.lights[i].direction, glm::vec3(0.0f, 0.3f, 1.0f)));
    }
    s.lights.back().angular_diameter_rad = 0.4f;
    const auto seen = [&](Strategy strategy) {
        return mean(render(s, spot_meter(glm::normalize(glm::vec3(0.6f, 0.0f, 0.8f))),
                           {strategy, false, 32, 64}))
            .x;
    };
    const double both = seen(Strategy::both);
    EXPECT_NEAR(seen(Strategy::light) / both, 1.0, 0.01);
    EXPECT_NEAR(seen(Strategy::bsdf) / both, 1.0, 0.01);
}

TEST(IntegrateLights, AnEmissiveSquareIsARectangleLight) {
    scene::Scene lit = scene_of(square(20.0f), grey(0.5f));
    scene::Light rectangle = light_of(LightType::rectangle);
    rectangle.half_width_m = rectangle.half_height_m = 0.5f;
    lit.lights = {rectangle};
    scene::Scene glowing = scene_of(square(20.0f), grey(0.5f));
    scene::Material lamp = grey(0.0f);
    lamp.emissive_nit = glm::vec3(1000.0f);
    glowing.materials.push_back(lamp);
    glowing.meshes.push_back({"lamp", {square(0.5f, 1)}});
    glowing.instances.push_back(
        {"lamp", 1,
         glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, 2)), 3.14159265f, glm::vec3(1, 0, 0))});
    const scene::Camera aside = spot_meter(glm::normalize(glm::vec3(1.0f, 0.0f, 0.3f)));
    const double expected = 1000.0 * rectangle_sr(0.5, 0.5, 2.0) * 0.5 / kPi;
    for (const Strategy strategy : {Strategy::both, Strategy::light, Strategy::bsdf}) {
        EXPECT_NEAR(mean(render(glowing, aside, {strategy, true})).x / expected, 1.0, 0.01)
            << "strategy " << static_cast<int>(strategy);
    }
    EXPECT_NEAR(mean(render(lit, aside, {Strategy::both, true})).x / expected, 1.0, 0.005);
}

// More lights than are asked one by one are drawn from; what they give together is the sum of what they give
// apart.
TEST(IntegrateLights, ManyLightsAreTheSumOfThem) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    const std::array types{LightType::point,  LightType::spot, LightType::frustum,   LightType::line,
                           LightType::sphere, LightType::disk, LightType::rectangle, LightType::tube};
    std::vector<scene::Light> all;
    for (std::size_t i = 0; i < 200; ++i) {
        scene::Light light = light_of(types[i % types.size()]);
        light.position = {6.0f * uniform(random) - 3.0f, 6.0f * uniform(random) - 3.0f,
                          0.5f + uniform(random)};
        light.direction = glm::normalize(glm::vec3(uniform(random) - 0.5f, uniform(random) - 0.5f, -1.0f));
        light.right = glm::normalize(glm::cross(light.direction, glm::vec3(0.2f, 1.0f, 0.0f)));
        light.radius_m = light.half_width_m = light.half_height_m = 0.1f;
        light.intensity = scene::is_shape(light.type) ? 3000.0f * uniform(random) : 100.0f * uniform(random);
        light.range_m = 1.0f + 2.0f * uniform(random);
        all.push_back(light);
    }
    double apart = 0.0;
    for (std::size_t i = 0; i < all.size(); i += 40) {
        apart += illuminance_lx(
            {all.begin() + static_cast<std::ptrdiff_t>(i), all.begin() + static_cast<std::ptrdiff_t>(i + 40)},
            {Strategy::both, false, 16, 64});
    }
    EXPECT_NEAR(illuminance_lx(all, {Strategy::both, false, 32, 128}) / apart, 1.0, 0.01);
}
