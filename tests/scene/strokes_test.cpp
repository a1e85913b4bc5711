// Points and lines become surfaces of a width in pixels.
#include "candela/scene/strokes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

using namespace candela::scene;

namespace {

constexpr std::uint32_t kWidth = 640;
constexpr std::uint32_t kHeight = 360;

Scene strokes(StrokeKind kind, const std::vector<glm::vec3>& positions, const glm::mat4& world) {
    Scene s;
    s.materials.emplace_back();
    Stroke stroke;
    stroke.kind = kind;
    stroke.geometry.positions = positions;
    stroke.geometry.material = 0;
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        stroke.geometry.indices.push_back(i);
        stroke.geometry.bounds.extend(positions[i]);
    }
    s.meshes.push_back({"mesh", {}, {stroke}});
    s.instances.push_back({"node", 0, world});
    return s;
}

glm::vec2 pixel(const Camera& camera, const glm::vec3& p) {
    const glm::vec4 clip = view_projection(camera, float(kWidth) / float(kHeight)) * glm::vec4(p, 1.0f);
    return (0.5f * glm::vec2(clip) / clip.w + 0.5f) * glm::vec2(kWidth, kHeight);
}

Camera orthographic() {
    Camera camera = look_at({1, 2, 5}, {0, 0, 0}, 0.7f);
    camera.projection = Projection::orthographic;
    camera.ymag_m = 2.0f;
    camera.xmag_m = 2.0f * float(kWidth) / float(kHeight);
    camera.znear_m = 0.0f;
    camera.zfar_m = 100.0f;
    return camera;
}

const glm::mat4 kPlace =
    glm::scale(glm::rotate(glm::translate(glm::mat4(1.0f), {0.3f, -0.2f, 0.1f}), 0.6f, {0, 1, 0}), {1, 2, 1});

}  // namespace

TEST(Strokes, ALineIsAsWideAsAskedForAtBothOfItsEnds) {
    for (const Camera& camera : {look_at({1, 2, 5}, {0, 0, 0}, 0.7f), orthographic()}) {
        for (const float width_px : {1.0f, 6.0f}) {
            Scene s = strokes(StrokeKind::lines, {{-1, 0, 0}, {0.5f, 0.3f, 2}}, kPlace);
            widen_strokes(s, camera, kWidth, kHeight, width_px);
            ASSERT_EQ(s.instances.size(), 2u);
            EXPECT_EQ(s.instances[1].world, glm::mat4(1.0f));
            const Primitive& p = s.meshes[s.instances[1].mesh].primitives.at(0);
            ASSERT_EQ(p.positions.size(), 4u);
            // Corners 0 and 3 are of the first end, 1 and 2 of the second.
            for (const auto& [a, b] : {std::pair{0, 3}, {1, 2}}) {
                const glm::vec2 across =
                    pixel(camera, p.positions[std::size_t(a)]) - pixel(camera, p.positions[std::size_t(b)]);
                EXPECT_NEAR(glm::length(across), width_px, 0.02f * width_px);
            }
            EXPECT_EQ(p.indices.size(), 6u);
            for (const glm::vec3& n : p.normals) EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
        }
    }
}

TEST(Strokes, APointIsASquareAndFacesTheCamera) {
    const Camera camera = look_at({1, 2, 5}, {0, 0, 0}, 0.7f);
    Scene s = strokes(StrokeKind::points, {{0, 0, 0}, {0.5f, 0.3f, 1}}, kPlace);
    EXPECT_EQ(count_strokes(s).points, 2u);
    widen_strokes(s, camera, kWidth, kHeight, 5.0f);
    EXPECT_EQ(count_strokes(s).points, 0u);
    const Primitive& p = s.meshes[1].primitives.at(0);
    ASSERT_EQ(p.positions.size(), 8u);
    for (std::size_t first : {0u, 4u}) {
        const glm::vec2 x = pixel(camera, p.positions[first + 1]) - pixel(camera, p.positions[first]);
        const glm::vec2 y = pixel(camera, p.positions[first + 2]) - pixel(camera, p.positions[first + 1]);
        EXPECT_NEAR(glm::length(x), 5.0f, 0.1f);
        EXPECT_NEAR(glm::length(y), 5.0f, 0.1f);
    }
    for (std::size_t i = 0; i < p.indices.size(); i += 3) {
        const glm::vec3 a = p.positions[p.indices[i]];
        const glm::vec3 n = glm::cross(p.positions[p.indices[i + 1]] - a, p.positions[p.indices[i + 2]] - a);
        EXPECT_GT(glm::dot(n, glm::vec3(camera.world[3]) - a), 0.0f);
    }
}

// A line that passes the camera is linear in depth on either side of it only: it must not be wide in front.
TEST(Strokes, ALineThroughTheCamerasPlaneKeepsItsWidthBeforeIt) {
    const Camera camera = look_at({0, 0, 0}, {0, 0, -1}, 0.7f);
    Scene s = strokes(StrokeKind::lines, {{0.1f, -0.2f, -10}, {0.1f, -0.2f, 10}}, glm::mat4(1.0f));
    widen_strokes(s, camera, kWidth, kHeight, 2.0f);
    const Primitive& p = s.meshes[1].primitives.at(0);
    ASSERT_EQ(p.positions.size(), 8u);
    const glm::vec2 across = pixel(camera, p.positions[0]) - pixel(camera, p.positions[3]);
    EXPECT_NEAR(glm::length(across), 2.0f, 0.05f);
    for (const glm::vec3& x : p.positions) EXPECT_LT(std::abs(x.x - 0.1f), 0.05f);
}

TEST(Strokes, BoundsKnowThemBeforeTheyHaveAWidth) {
    const Scene s = strokes(StrokeKind::lines, {{-1, 0, 0}, {1, 3, 0}}, glm::mat4(1.0f));
    const Aabb bounds = world_bounds(s);
    EXPECT_EQ(bounds.min, glm::vec3(-1, 0, 0));
    EXPECT_EQ(bounds.max, glm::vec3(1, 3, 0));
}
