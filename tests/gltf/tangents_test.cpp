#include "candela/io/tangents.hpp"

#include <gtest/gtest.h>

#include "gltf_builder.hpp"

using namespace candela;
using candela::test::near;

namespace {

/// All in the xy plane, facing +Z.
scene::Primitive flat(const std::vector<glm::vec3>& positions, const std::vector<glm::vec2>& uv,
                      const std::vector<std::uint32_t>& indices) {
    scene::Primitive p;
    p.positions = positions;
    p.uv[0] = uv;
    p.indices = indices;
    p.normals.assign(positions.size(), {0, 0, 1});
    return p;
}

glm::vec3 tangent_at(const scene::Primitive& p, std::size_t corner) {
    return glm::vec3(p.tangents[p.indices[corner]]);
}

}  // namespace

TEST(Tangents, NeighboursOfOneOrientationShareTheirVertices) {
    scene::Primitive p = flat({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                              {0, 1, 2, 0, 2, 3});
    io::add_tangents(p, 0);
    ASSERT_EQ(p.positions.size(), 4u);
    for (const glm::vec4& t : p.tangents) EXPECT_TRUE(near(glm::vec3(t), {1, 0, 0}));
}

TEST(Tangents, AMirroredUvSplitsTheSeam) {
    // u runs towards the seam x = 0 from both sides.
    scene::Primitive p = flat({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}, {{0, 0}, {1, 0}, {0, 1}, {1, 0}},
                              {0, 1, 2, 0, 2, 3});
    io::add_tangents(p, 0);
    ASSERT_EQ(p.positions.size(), 6u);
    EXPECT_TRUE(near(tangent_at(p, 0), {1, 0, 0}));
    EXPECT_TRUE(near(tangent_at(p, 3), {-1, 0, 0}));
    EXPECT_EQ(p.tangents[p.indices[0]].w, -p.tangents[p.indices[3]].w);
}

// MikkTSpace: the mean of the faces' tangents is weighted by the angle at the corner; here
// 90 degrees of (1, 0) and 135 degrees of (1, 1) / sqrt 2.
TEST(Tangents, AreMeansWeightedByAngle) {
    const glm::vec3 expected{0.889146f, 0.457623f, 0.0f};
    for (const float zero : {0.0f, -0.0f}) {
        // Six vertices of their own: what is equal is welded, and -0 equals 0.
        scene::Primitive p =
            flat({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {zero, zero, zero}, {zero, 1, 0}, {-1, -1, 0}},
                 {{0, 0}, {1, 0}, {0, 1}, {0, zero}, {zero, 1}, {-1, 0}}, {0, 1, 2, 3, 4, 5});
        io::add_tangents(p, 0);
        EXPECT_TRUE(near(tangent_at(p, 0), expected, 1e-4f))
            << tangent_at(p, 0).x << " " << tangent_at(p, 0).y;
        EXPECT_TRUE(near(tangent_at(p, 3), expected, 1e-4f));
        EXPECT_TRUE(near(tangent_at(p, 1), {1, 0, 0}));
    }
}

TEST(Tangents, ATriangleWithoutUvAreaTakesItsNeighbours) {
    // The second triangle's uvs lie on a line.
    for (const bool last : {true, false}) {
        const std::vector<std::uint32_t> order = last ? std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}
                                                      : std::vector<std::uint32_t>{0, 2, 3, 0, 1, 2};
        scene::Primitive p =
            flat({{0, 0, 0}, {1, -1, 0}, {0, 1, 0}, {-1, 0, 0}}, {{0, 0}, {1, 0}, {0, 1}, {0, 2}}, order);
        const std::size_t sound = last ? 0 : 3;
        io::add_tangents(p, 0);
        EXPECT_EQ(p.positions.size(), 4u);
        EXPECT_EQ(p.indices[0], p.indices[3]);
        const glm::vec3 alone = glm::normalize(glm::vec3(1, -1, 0));
        EXPECT_TRUE(near(tangent_at(p, sound), alone)) << "it must add nothing itself";
    }
}

TEST(Tangents, ATriangleOfTwoEqualPositionsBorrows) {
    scene::Primitive p = flat({{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 0}},
                              {{0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}}, {0, 3, 1, 0, 1, 2});
    io::add_tangents(p, 0);
    EXPECT_TRUE(near(tangent_at(p, 0), {0, 1, 0}));
    EXPECT_TRUE(near(tangent_at(p, 2), {0, 1, 0}));
}

// Opposite corners, two triangles that only touch in a vertex: no edge, no mean.
TEST(Tangents, TouchingInAVertexIsNotEnough) {
    scene::Primitive p = flat({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                              {{0, 0}, {1, 0}, {0, 1}, {0, 1}, {-1, 0}}, {0, 1, 2, 0, 3, 4});
    io::add_tangents(p, 0);
    EXPECT_EQ(p.positions.size(), 6u);
    EXPECT_TRUE(near(tangent_at(p, 0), {1, 0, 0}));
}
