#include "shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

namespace candela::scenes {
namespace {

double volume_m3(const Shape& s) {
    double sum = 0.0;
    for (std::size_t i = 0; i < s.indices.size(); i += 3) {
        const glm::dvec3 a(s.positions[s.indices[i]]), b(s.positions[s.indices[i + 1]]),
            c(s.positions[s.indices[i + 2]]);
        sum += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return sum;
}

/// The smallest cosine between a triangle's own normal and the normals at its corners.
float worst_agreement(const Shape& s) {
    float worst = 1.0f;
    for (std::size_t i = 0; i < s.indices.size(); i += 3) {
        const glm::vec3 a = s.positions[s.indices[i]], b = s.positions[s.indices[i + 1]],
                        c = s.positions[s.indices[i + 2]];
        const glm::vec3 n = glm::normalize(glm::cross(b - a, c - a));
        for (std::size_t k = 0; k < 3; ++k) worst = std::min(worst, glm::dot(n, s.normals[s.indices[i + k]]));
    }
    return worst;
}

void expect_sound(const Shape& s) {
    ASSERT_FALSE(s.indices.empty());
    EXPECT_EQ(s.normals.size(), s.positions.size());
    EXPECT_EQ(s.uv.size(), s.positions.size());
    EXPECT_LT(*std::max_element(s.indices.begin(), s.indices.end()), s.positions.size());
    for (const glm::vec3& n : s.normals) EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
    EXPECT_GT(worst_agreement(s), 0.5f);
}

TEST(Shapes, SphereHasItsTrianglesVolumeAndOutwardNormals) {
    const Shape s = sphere(0.5f, 64, 32);
    expect_sound(s);
    EXPECT_EQ(s.triangles(), 64u * 2u * 31u);
    EXPECT_NEAR(volume_m3(s), 4.0 / 3.0 * M_PI * 0.125, 0.003);
    EXPECT_GT(worst_agreement(s), 0.99f);
}

TEST(Shapes, BoxIsClosedAndFacesOutwards) {
    const Shape s = box({1.0f, 2.0f, 3.0f});
    expect_sound(s);
    EXPECT_NEAR(volume_m3(s), 6.0, 1e-5);
}

TEST(Shapes, TubesTurnTheirOutsideOutwards) {
    const Shape knot = torus_knot(2, 3, 0.062f, 0.026f, 0.0155f, 256, 16);
    expect_sound(knot);
    EXPECT_GT(volume_m3(knot), 0.0);
    const Shape rod = tube(
        {32, 4, true, false}, [](float v) { return glm::vec3(0, v, 0); },
        [](float) { return glm::vec3(1, 0, 0); }, [](float) { return 0.1f; });
    expect_sound(rod);
    for (std::size_t i = 0; i < rod.positions.size(); ++i)
        EXPECT_GT(glm::dot(rod.normals[i], rod.positions[i] * glm::vec3(10, 0, 10)), 0.99f);
}

TEST(Shapes, ThinLipsOfTurnedShapesDoNotFoldOver) {
    const Shape s = turned({{0.0f, 0.0f},
                            {0.1f, 0.0f},
                            {0.2f, 0.2f},
                            {0.203f, 0.204f},
                            {0.2f, 0.205f},
                            {0.09f, 0.02f},
                            {0.0f, 0.015f}},
                           32, 24);
    expect_sound(s);
    EXPECT_GT(volume_m3(s), 0.0);
}

TEST(Shapes, PlanesFaceUpAndTheCardFacesTheViewer) {
    for (const glm::vec3& n : ground(2.0f, 2.0f).normals) EXPECT_EQ(n, glm::vec3(0, 1, 0));
    for (const glm::vec3& n : card(2.0f, 2.0f).normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
    const Shape sweep = paper_sweep(4.0f, 2.0f, -1.0f, 2.0f, 0.5f);
    EXPECT_GT(sweep.normals.front().y, 0.99f);
    EXPECT_GT(sweep.normals.back().z, 0.99f);
}

}  // namespace
}  // namespace candela::scenes
