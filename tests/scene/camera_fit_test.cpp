#include <gtest/gtest.h>

#include <cmath>

#include "candela/scene/camera.hpp"

using namespace candela::scene;

namespace {

/// Where a point on the view's middle plane, 1 m before the camera, is in the picture: +-1 at its edges.
glm::vec2 seen(const Camera& camera, float aspect, const glm::vec2& at) {
    const glm::vec4 clip = view_projection(camera, aspect) * glm::vec4(at, -1.0f, 1.0f);
    return glm::vec2(clip) / clip.w;
}

}  // namespace

// glTF 2.0, 3.10.3: a client should not crop what the author's viewport shows.
TEST(FittedCamera, ShowsAllOfTheAuthorsViewport) {
    for (const float author : {0.5f, 1.0f, 2.0f}) {
        Camera perspective;
        perspective.aspect = author;
        perspective.yfov_rad = 0.9f;
        const float half = std::tan(0.45f);
        Camera orthographic;
        orthographic.projection = Projection::orthographic;
        orthographic.ymag_m = half;
        orthographic.xmag_m = half * author;
        orthographic.zfar_m = 10.0f;
        for (const float picture : {0.4f, 1.0f, 1.7f, 3.0f}) {
            for (const Camera& camera : {perspective, orthographic}) {
                const glm::vec2 corner = seen(camera, picture, {half * author, -half});
                EXPECT_LE(corner.x, 1.0f + 1e-5f) << author << " in " << picture;
                EXPECT_LE(corner.y, 1.0f + 1e-5f) << author << " in " << picture;
                EXPECT_NEAR(std::max(corner.x, corner.y), 1.0f, 1e-5f) << "and no smaller than it can be";
            }
        }
    }
}

TEST(FittedCamera, KeepsTheVerticalFieldOfViewWithoutAnAspect) {
    Camera camera;
    camera.yfov_rad = 0.9f;
    EXPECT_FLOAT_EQ(fitted(camera, 0.3f).yfov_rad, 0.9f);
    EXPECT_FLOAT_EQ(fitted(camera, 3.0f).yfov_rad, 0.9f);
}

TEST(FittedCamera, FittingTwiceChangesNothing) {
    Camera camera;
    camera.aspect = 2.0f;
    const Camera once = fitted(camera, 0.7f);
    EXPECT_FLOAT_EQ(fitted(once, 0.7f).yfov_rad, once.yfov_rad);
    camera.projection = Projection::orthographic;
    camera.xmag_m = 3.0f;
    EXPECT_FLOAT_EQ(fitted(fitted(camera, 0.7f), 0.7f).ymag_m, fitted(camera, 0.7f).ymag_m);
}
