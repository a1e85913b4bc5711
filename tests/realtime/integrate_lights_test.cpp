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
