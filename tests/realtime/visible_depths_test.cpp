// Between which depths a camera sees boxes: what shadow cascades share.
#include "candela/realtime/visible_depths.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "candela/scene/camera.hpp"

using namespace candela;

namespace {

scene::Camera camera_at(const glm::vec3& eye, const glm::vec3& target, float yfov_rad) {
    scene::Camera camera;
    camera.world = glm::inverse(glm::lookAt(eye, target, glm::vec3(0.0f, 1.0f, 0.0f)));
    camera.yfov_rad = yfov_rad;
    return camera;
}

scene::Aabb box(const glm::vec3& a, const glm::vec3& b) {
    scene::Aabb out;
    out.extend(a);
    out.extend(b);
    return out;
}

glm::vec2 depths(const scene::Camera& camera, const scene::Aabb& of) {
    return realtime::visible_depths_m(camera, 1.5f, std::array{of});
}

}  // namespace

// Down on a ground of 200 m that fills the picture: 30 degrees below the horizon, 40 degrees of field of
// view.
TEST(VisibleDepths, AGroundEndsWhereThePictureCutsItOff) {
    const scene::Camera camera =
        camera_at({0, 2, 0}, {0, 2 - std::tan(glm::radians(30.0f)), -1}, glm::radians(40.0f));
    const glm::vec2 range = depths(camera, box({-100, -0.001f, -100}, {100, 0, 100}));
    // A ray at an angle from the axis meets the ground at the depth height x cos / sin of its slope.
    const auto depth = [](float from_axis_deg) {
        return 2.0f * std::cos(glm::radians(from_axis_deg)) / std::sin(glm::radians(30.0f + from_axis_deg));
    };
    EXPECT_NEAR(range.x, depth(20.0f), 0.01f);
    EXPECT_NEAR(range.y, depth(-20.0f), 0.01f);
}

TEST(VisibleDepths, FromWithinABoxTheyBeginAtTheNearPlane) {
    const glm::vec2 range = depths(camera_at({0, 0, 0}, {0, 0, -1}, 0.7f), box({-2, -2, -2}, {2, 2, 2}));
    EXPECT_FLOAT_EQ(range.x, 0.01f);
    EXPECT_NEAR(range.y, 2.0f, 1e-4f);
}

TEST(VisibleDepths, OutOfViewIsNothing) {
    const scene::Camera camera = camera_at({0, 0, 0}, {0, 0, -1}, 0.7f);
    EXPECT_EQ(depths(camera, box({-1, -1, 1}, {1, 1, 2})), glm::vec2(camera.znear_m));
    EXPECT_EQ(depths(camera, box({50, -1, -3}, {60, 1, -2})), glm::vec2(camera.znear_m));
    EXPECT_EQ(realtime::visible_depths_m(camera, 1.0f, {}), glm::vec2(camera.znear_m));
}

// Of random boxes, beside the points of each that lie in the frustum.
TEST(VisibleDepths, HoldWhatIsSeenAndLittleMore) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    int seen = 0;
    for (int i = 0; i < 60; ++i) {
        const auto point = [&](float scale) {
            return scale * glm::vec3(unit(random), unit(random), unit(random));
        };
        scene::Camera camera = camera_at(point(3.0f), point(1.0f), 0.8f);
        if (i % 3 == 0) {
            camera.projection = scene::Projection::orthographic;
            camera.ymag_m = 0.8f;
            camera.xmag_m = 1.2f;
        }
        camera.znear_m = 0.3f;
        if (i % 2 == 0) camera.zfar_m = 4.0f;
        const scene::Aabb of = box(point(2.0f), point(2.0f));
        const glm::vec2 range = depths(camera, of);
        glm::vec2 sampled(1e9f, -1e9f);
        const glm::mat4 to_camera = glm::inverse(camera.world);
        constexpr int points = 81;
        for (int k = 0; k < points * points * points; ++k) {
            const glm::vec3 t(k % points, k / points % points, k / points / points);
            const glm::vec3 p(to_camera *
                              glm::vec4(of.min + t / float(points - 1) * (of.max - of.min), 1.0f));
            const float depth = -p.z;
            if (depth < camera.znear_m || depth > camera.zfar_m) continue;
            const float half_y =
                camera.projection == scene::Projection::orthographic ? 0.8f : depth * std::tan(0.4f);
            if (std::abs(p.y) > half_y || std::abs(p.x) > 1.5f * half_y) continue;
            sampled = {std::min(sampled.x, depth), std::max(sampled.y, depth)};
        }
        if (sampled.x > sampled.y) continue;
        ++seen;
        EXPECT_LE(range.x, sampled.x + 1e-4f) << i;
        EXPECT_GE(range.y, sampled.y - 1e-4f) << i;
        EXPECT_NEAR(range.x, sampled.x, 0.12f) << i;
        EXPECT_NEAR(range.y, sampled.y, 0.12f) << i;
    }
    EXPECT_GT(seen, 25);
}
