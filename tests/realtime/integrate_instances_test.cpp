// Instances that share a tree cast the shadows of their copies in the mode integrate.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "render_scenes.hpp"

using namespace candela;
using namespace candela::test;

namespace {

/// Nine balls over a plane, turned, scaled unevenly and mirrored; every third lets light through.
scene::Scene balls() {
    scene::Scene s = scene_of(square(4.0f), grey(0.5f));
    scene::Material glass = grey(0.5f);
    glass.base_color.a = 0.5f;
    glass.alpha_mode = scene::AlphaMode::blend;
    s.materials.push_back(glass);
    s.materials.push_back(grey(0.8f));
    s.meshes.push_back({"glass", {sphere(0.4f, 1, 32, 16)}});
    s.meshes.push_back({"ball", {sphere(0.4f, 2, 32, 16)}});
    for (int i = 0; i < 9; ++i) {
        const auto x = static_cast<float>(i % 3 - 1), y = static_cast<float>(i / 3 - 1);
        glm::mat4 m = glm::translate(glm::mat4(1.0f), {1.3f * x, 1.3f * y, 0.7f});
        m = glm::rotate(m, static_cast<float>(i), glm::vec3(0.0f, 0.6f, 0.8f));
        m = glm::scale(m, {i % 2 ? -1.0f : 1.0f, 0.7f, 1.2f});
        s.instances.push_back({"ball", i % 3 == 0 ? 1u : 2u, m});
    }
    scene::Light lamp;
    lamp.type = scene::LightType::sphere;
    lamp.position = {2.0f, 1.0f, 4.0f};
    lamp.radius_m = 0.3f;
    lamp.intensity = 1000.0f;
    lamp.visible = false;
    scene::Light light = sun(100.0f);
    light.direction = glm::normalize(glm::vec3(-0.4f, 0.2f, -1.0f));
    s.lights = {lamp, light};
    return s;
}

realtime::Still render(const scene::Scene& s, std::size_t max_copied_triangles) {
    realtime::RendererOptions o = options("best", 48, 2);
    o.integrate.emplace();
    o.integrate->ray_shadows = true;
    o.integrate->max_copied_triangles = max_copied_triangles;
    const gpu::Device device{validated()};
    realtime::Still still;
    {
        realtime::Renderer renderer(device, s, o);
        still = renderer.render_still(scene::look_at({0.0f, -4.0f, 5.0f}, {0, 0, 0}, 0.7f), fixed_ev(5.0f));
    }
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
    return still;
}

}  // namespace

TEST(IntegrateInstances, SharedTreesCastTheShadowsOfCopies) {
    const scene::Scene s = balls();
    const auto copied = render(s, std::numeric_limits<std::size_t>::max()).planes.light_nit;
    const auto shared = render(s, 0).planes.light_nit;
    double sum = 0.0, off = 0.0;
    int different = 0;
    for (std::size_t i = 0; i < copied.size(); ++i) {
        sum += double(copied[i].x);
        off += std::abs(double(copied[i].x) - double(shared[i].x));
        different += std::abs(copied[i].x - shared[i].x) > 0.02f * copied[i].x ? 1 : 0;
    }
    EXPECT_GT(sum, 0.0);
    // Single pixels at silhouettes may see the other side of an edge.
    EXPECT_LT(off / sum, 1e-3);
    EXPECT_LT(different, static_cast<int>(copied.size() / 200));
}
