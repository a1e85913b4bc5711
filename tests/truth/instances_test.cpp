// Primitives that instances share in one tree are met as copies of them are.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "candela/truth/geometry.hpp"
#include "candela/truth/surface_point.hpp"
#include "trace.hpp"

using namespace candela;
using namespace candela::test;

namespace {

/// Balls, turned, scaled unevenly and mirrored, on a floor that only one instance shows.
scene::Scene balls(std::uint32_t count) {
    scene::Scene s;
    place(s, flat_square(20.0f, glm::vec3(0.0f), true), grey(0.5f));
    place(s, sphere(0.5f), grey(0.7f), glm::translate(glm::mat4(1.0f), {0.0f, 0.6f, 0.0f}));
    const std::uint32_t mesh = s.instances.back().mesh;
    for (std::uint32_t i = 1; i < count; ++i) {
        const auto x = static_cast<float>(i);
        glm::mat4 m = glm::translate(glm::mat4(1.0f), {1.5f * x, 0.6f, -0.7f * x});
        m = glm::rotate(m, x, glm::vec3(0.0f, 0.6f, 0.8f));
        m = glm::scale(m, {i % 2 ? -1.0f : 1.0f, 0.8f, 1.0f + 0.1f * x});
        s.instances.push_back({"ball", mesh, m});
    }
    return s;
}

}  // namespace

TEST(SharedPrimitives, AreThoseWithManyCopies) {
    const scene::Scene s = balls(9);
    const std::size_t triangles = s.meshes[1].primitives[0].indices.size() / 3;
    ASSERT_GT(triangles, 256u);
    EXPECT_TRUE(scene::shared_primitives(s, 8 * triangles).empty());
    const auto shared = scene::shared_primitives(s, 8 * triangles - 1);
    EXPECT_EQ(shared.size(), 1u);
    EXPECT_TRUE(shared.contains(&s.meshes[1].primitives[0]));
    EXPECT_EQ(scene::stored_triangles(s, shared), triangles + 2);
    EXPECT_EQ(scene::stored_triangles(s, {}), 9 * triangles + 2);
}

TEST(SharedPrimitives, WithoutAnInverseAreCopied) {
    scene::Scene s = balls(9);
    s.instances.back().world[0] = glm::vec4(0.0f);
    EXPECT_TRUE(scene::shared_primitives(s, 0).empty());
}

TEST(SharedPrimitives, AreMetWhereTheirCopiesAre) {
    const scene::Scene s = balls(9);
    const truth::Geometry copied(s, std::numeric_limits<std::size_t>::max());
    const truth::Geometry shared(s, 0);
    const truth::SurfaceReader of_copied(s, copied), of_shared(s, shared);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> u(-1.0f, 1.0f);
    int hits = 0, balls_met = 0;
    for (int i = 0; i < 4000; ++i) {
        truth::Ray ray;
        ray.origin = glm::vec3(6.0f, 2.0f, -2.0f) + 6.0f * glm::vec3(u(random), 0.2f * u(random), u(random));
        ray.direction = glm::normalize(glm::vec3(u(random), u(random) - 0.3f, u(random)));
        truth::Hit a, b;
        const bool met = copied.intersect(ray, a);
        ASSERT_EQ(shared.intersect(ray, b), met);
        EXPECT_EQ(shared.occluded(ray), met);
        if (!met) continue;
        ++hits;
        balls_met += a.part > 0 ? 1 : 0;
        EXPECT_EQ(a.part, b.part);
        EXPECT_NEAR(a.t, b.t, 1e-4f * a.t);
        if (a.part != b.part || a.triangle != b.triangle) continue;  // on an edge, either triangle
        const truth::SurfacePoint p = of_copied.read(ray, a), q = of_shared.read(ray, b);
        EXPECT_LT(glm::length(p.position - q.position), 1e-4f);
        EXPECT_LT(glm::length(p.normal - q.normal), 1e-3f);
        EXPECT_EQ(p.front, q.front);
    }
    EXPECT_GT(hits, 1000);
    EXPECT_GT(balls_met, 100);
}
