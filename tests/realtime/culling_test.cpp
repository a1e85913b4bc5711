#include <gtest/gtest.h>

#include "render_scenes.hpp"
#include "shading/sequence.glsl"

using namespace candela;
using namespace candela::test;

namespace {

/// A ground, a ball, a blended pane in front of them, and lights of many kinds with short ranges.
scene::Scene crowded(int lights) {
    scene::Scene s = scene_of(square(10.0f), grey(0.5f));
    s.materials[0].specular = 1.0f;
    s.materials[0].perceptual_roughness = 0.4f;
    s.meshes.push_back({"ball", {test::sphere(1.0f)}});
    glm::mat4 up(1.0f);
    up[3] = glm::vec4(0, 0, 1, 1);
    s.instances.push_back({"ball", 1, up});
    scene::Material glass = s.materials[0];
    glass.alpha_mode = scene::AlphaMode::blend;
    glass.base_color.a = 0.4f;
    s.materials.push_back(glass);
    s.meshes.push_back({"pane", {square(3.0f, 1)}});
    up[3] = glm::vec4(2, 0, 2.5f, 1);
    s.instances.push_back({"pane", 2, up});
    const std::array types{scene::LightType::point, scene::LightType::spot, scene::LightType::sphere,
                           scene::LightType::rectangle};
    for (int i = 0; i < lights; ++i) {
        const glm::vec2 at = shading::sobol_owen(static_cast<std::uint32_t>(i), 1);
        const glm::vec2 number = shading::sobol_owen(static_cast<std::uint32_t>(i), 2);
        scene::Light light;
        light.type = types[static_cast<std::size_t>(i) % types.size()];
        light.position = glm::vec3(at * 16.0f - 8.0f, 0.3f + 2.5f * number.x);
        light.range_m = 0.8f + 1.5f * number.y;
        light.direction = glm::normalize(glm::vec3(number - 0.5f, -0.5f));
        light.right = glm::normalize(glm::cross(light.direction, glm::vec3(0, 1, 0)));
        light.outer_cone_rad = 0.6f;
        light.radius_m = 0.1f;
        light.half_width_m = 0.3f;
        light.half_height_m = 0.1f;
        light.color = glm::vec3(0.3f + number.x, 1.0f, 1.0f - 0.5f * number.y);
        light.intensity = scene::is_shape(light.type) ? 1000.0f : 100.0f;
        light.visible = false;
        s.lights.push_back(light);
    }
    s.lights.push_back(sun(5.0f));
    return s;
}

void expect_same_pictures(const scene::Scene& s, const scene::Camera& camera) {
    const gpu::Device device{validated()};
    realtime::RendererOptions o = options("ue4", 96);
    o.height = 72;
    std::array<realtime::Still, 2> stills;
    for (std::size_t i = 0; i < 2; ++i) {
        o.cull_lights = i == 0;
        realtime::Renderer renderer(device, s, o);
        stills[i] = renderer.render_still(camera, fixed_ev(6.0f));
    }
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    float sum = 0.0f;
    float worst = 0.0f;
    for (std::size_t p = 0; p < stills[0].planes.light_nit.size(); ++p) {
        const glm::vec3 a(stills[0].planes.light_nit[p]);
        const glm::vec3 b(stills[1].planes.light_nit[p]);
        sum += b.y;
        worst = std::max(worst, glm::length(a - b) / std::max(glm::length(b), 1e-3f));
    }
    EXPECT_GT(sum, 100.0f);
    EXPECT_LT(worst, 1e-3f) << "a half float's step";
}

}  // namespace

TEST(LightCulling, ThePictureIsThatOfEveryLightAskedEverywhere) {
    expect_same_pictures(crowded(200), scene::look_at({-4, -9, 6}, {0, 0, 0}, 0.8f));
}

TEST(LightCulling, AlsoThroughAnOrthographicCamera) {
    scene::Camera camera = scene::look_at({3, -9, 7}, {0, 0, 0}, 0.8f);
    camera.projection = scene::Projection::orthographic;
    camera.xmag_m = 8.0f;
    camera.ymag_m = 6.0f;
    camera.zfar_m = 40.0f;
    expect_same_pictures(crowded(60), camera);
}
