#include <gtest/gtest.h>

#include <cmath>

#include "candela/scene/scene.hpp"

using namespace candela::scene;

TEST(Camera, FocalLengthGivesTheFieldOfViewOfA24MillimetreSensor) {
    EXPECT_NEAR(yfov_from_focal_mm(50.0f), 2.0f * std::atan(12.0f / 50.0f), 1e-6f);
    EXPECT_NEAR(yfov_from_focal_mm(12.0f), 2.0f * std::atan(1.0f), 1e-6f);
}

TEST(Camera, DepthIsReversedAndClipSpaceIsVulkans) {
    Camera camera = look_at({0, 0, 5}, {0, 0, 0}, 1.0f);
    camera.znear_m = 0.1f;
    camera.zfar_m = 100.0f;
    const glm::mat4 vp = view_projection(camera, 2.0f);
    const auto depth = [&](float z) {
        const glm::vec4 clip = vp * glm::vec4(0, 0, z, 1);
        return clip.z / clip.w;
    };
    EXPECT_NEAR(depth(5.0f - 0.1f), 1.0f, 1e-5f);
    EXPECT_NEAR(depth(5.0f - 100.0f), 0.0f, 1e-5f);
    EXPECT_GT(depth(0.0f), depth(-1.0f));
    const glm::vec4 above = vp * glm::vec4(0, 1, 0, 1);
    EXPECT_LT(above.y / above.w, 0.0f) << "+Y of the world is up, which is -y in Vulkan's clip space";
}

TEST(Camera, TheFramedCameraSeesEveryCornerOfTheBounds) {
    Aabb bounds;
    bounds.extend(glm::vec3(-3, 0, 2));
    bounds.extend(glm::vec3(8, 1, 4));
    for (const float aspect : {0.5f, 1.0f, 2.4f}) {
        const glm::mat4 vp = view_projection(frame_bounds(bounds, aspect), aspect);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec4 p = vp * glm::vec4(corner & 1 ? bounds.max.x : bounds.min.x,
                                               corner & 2 ? bounds.max.y : bounds.min.y,
                                               corner & 4 ? bounds.max.z : bounds.min.z, 1.0f);
            EXPECT_LT(std::abs(p.x / p.w), 1.0f);
            EXPECT_LT(std::abs(p.y / p.w), 1.0f);
            EXPECT_GT(p.z, 0.0f);
            EXPECT_LE(p.z / p.w, 1.0f);
        }
    }
}
