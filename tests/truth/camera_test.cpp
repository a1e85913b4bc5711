#include <gtest/gtest.h>

#include "trace.hpp"

using namespace candela;
using namespace candela::test;

namespace {

/// Luminous squares across the view, `nit` cd/m^2 at each z.
scene::Scene squares(std::initializer_list<std::pair<float, float>> z_and_nit) {
    scene::Scene s;
    for (const auto& [z, nit] : z_and_nit) {
        scene::Primitive p = square(20.0f);
        for (glm::vec3& at : p.positions) at.z = z;
        place(s, p, lamp(nit));
    }
    return s;
}

scene::Camera camera(scene::Projection projection) {
    scene::Camera c;
    c.projection = projection;
    c.yfov_rad = 1.2f;
    c.znear_m = 2.0f;
    c.zfar_m = 5.0f;
    return c;
}

float depth_at(const scene::Scene& s, const scene::Camera& c, const glm::vec2& pixel) {
    const truth::PathIntegrator integrator(s, path_options());
    const truth::CameraRays rays(c, 16, 16);
    const truth::Ray ray = rays.through(pixel, glm::vec2(0.5f));
    return rays.depth_m(ray, integrator.trace(ray, {{0, 0}, 0, 0}).distance_m);
}

}  // namespace

TEST(PathCamera, SeesBetweenItsPlanesOnly) {
    for (const auto projection : {scene::Projection::perspective, scene::Projection::orthographic}) {
        const scene::Camera c = camera(projection);
        const auto seen = [&](const scene::Scene& s) { return mean_luminance(s, c, path_options(), 16).y; };
        EXPECT_FLOAT_EQ(static_cast<float>(seen(squares({{-1.99f, 10.0f}, {-3.0f, 20.0f}}))), 20.0f);
        EXPECT_FLOAT_EQ(static_cast<float>(seen(squares({{-2.01f, 10.0f}, {-3.0f, 20.0f}}))), 10.0f);
        EXPECT_FLOAT_EQ(static_cast<float>(seen(squares({{-4.99f, 30.0f}}))), 30.0f);
        EXPECT_EQ(seen(squares({{-5.01f, 30.0f}})), 0.0);
    }
}

TEST(PathCamera, TheFarPlaneEndsWhatTransparentSurfacesLetThrough) {
    scene::Scene s = squares({{-3.0f, 0.0f}, {-5.01f, 30.0f}});
    s.materials[0].alpha_mode = scene::AlphaMode::mask;
    s.materials[0].base_color.a = 0.0f;
    EXPECT_EQ(mean_luminance(s, camera(scene::Projection::perspective), path_options(), 16).y, 0.0);
}

TEST(PathCamera, TheFarPlaneEndsLightsThatItSees) {
    scene::Scene s;
    scene::Light ball;
    ball.type = scene::LightType::sphere;
    ball.radius_m = 1.0f;
    ball.intensity = 40.0f;
    ball.visible = true;
    ball.position = {0, 0, -4.5f};
    s.lights = {ball};
    scene::Camera c = camera(scene::Projection::perspective);
    c.yfov_rad = 0.01f;
    EXPECT_GT(mean_luminance(s, c, path_options(), 16).y, 1.0);
    s.lights[0].position.z = -6.5f;
    EXPECT_EQ(mean_luminance(s, c, path_options(), 16).y, 0.0);
}

TEST(PathCamera, DepthIsAlongTheViewAxisFromTheCamera) {
    const scene::Scene s = squares({{-3.0f, 1.0f}});
    for (const auto projection : {scene::Projection::perspective, scene::Projection::orthographic}) {
        for (const glm::vec2& pixel : {glm::vec2(8, 8), glm::vec2(1, 2), glm::vec2(15, 3)})
            EXPECT_NEAR(depth_at(s, camera(projection), pixel), 3.0f, 1e-5f);
    }
}
