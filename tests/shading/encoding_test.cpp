#include <gtest/gtest.h>

#include "directions.hpp"
#include "shading/basis.glsl"
#include "shading/cube.glsl"
#include "shading/footprint.glsl"
#include "shading/octahedral.glsl"

namespace candela::shading {
namespace {

vec3 on_sphere(Uniform& u) {
    const vec3 d = u.hemisphere();
    return u() < 0.5f ? d : -d;
}

TEST(Basis, IsOrthonormalAndRightHandedEverywhere) {
    Uniform u(21);
    for (int i = 0; i < 10000; ++i) {
        vec3 n = on_sphere(u);
        if (i == 0) n = vec3(0, 0, 1);
        if (i == 1) n = vec3(0, 0, -1);
        if (i == 2) n = normalize(vec3(1e-4f, 1e-4f, -1.0f));
        vec3 t;
        vec3 b;
        orthonormal_basis(n, t, b);
        EXPECT_NEAR(length(t), 1.0f, 1e-5f);
        EXPECT_NEAR(length(b), 1.0f, 1e-5f);
        EXPECT_NEAR(dot(t, b), 0.0f, 1e-5f);
        EXPECT_NEAR(dot(t, n), 0.0f, 1e-5f);
        EXPECT_LT(distance(cross(t, b), n), 1e-5f);
        const vec3 w = on_sphere(u);
        EXPECT_LT(distance(to_world(to_local(w, t, b, n), t, b, n), w), 1e-5f);
    }
}

TEST(Octahedral, DecodeInvertsEncode) {
    Uniform u(22);
    for (int i = 0; i < 20000; ++i) {
        vec3 v = on_sphere(u);
        const vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
        if (i < 6) v = axes[i];
        const vec2 e = octahedral_encode(v);
        EXPECT_LE(std::abs(e.x), 1.0f);
        EXPECT_LE(std::abs(e.y), 1.0f);
        EXPECT_LT(distance(octahedral_decode(e), v), 1e-6f);
        EXPECT_LT(distance(octahedral_encode(v * 7.0f), e), 1e-6f);
        // As the G-buffer stores it, 16 bits each: under a hundredth of a degree.
        EXPECT_LT(distance(octahedral_decode(unpackSnorm2x16(packSnorm2x16(e))), v), 1e-4f);
    }
}

TEST(Cube, FaceAndPointInvertEachOtherAndTexelsFillTheSphere) {
    Uniform u(23);
    for (int i = 0; i < 20000; ++i) {
        const vec3 v = on_sphere(u);
        const vec3 at = cube_uv_face(v * 3.0f);
        EXPECT_LT(distance(normalize(cube_point(static_cast<int>(at.z), vec2(at))), v), 1e-6f);
    }
    // The middles of the faces, and the upper left corner of +Z: seen from inside, left-handed.
    const vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int face = 0; face < 6; ++face) EXPECT_EQ(cube_point(face, vec2(0.5f)), axes[face]);
    EXPECT_EQ(cube_point(4, vec2(0.0f)), vec3(-1, 1, 1));
    double sum = 0.0;
    for (uint y = 0; y < 16; ++y) {
        for (uint x = 0; x < 16; ++x) sum += 6.0 * static_cast<double>(cube_texel_solid_angle(x, y, 16));
    }
    EXPECT_NEAR(sum, 4.0 * M_PI, 1e-5);
    EXPECT_NEAR(cube_texel_solid_angle(0, 0, 1), 4.0f * PI / 6.0f, 1e-6f);
}

TEST(Footprint, WidensByTheSpreadOfNormalsAndNoMoreThanItsLimit) {
    const vec3 none(0.0f);
    EXPECT_FLOAT_EQ(alpha_filtered(0.3f, none, none), 0.3f);
    // A normal turning by 0.1 per pixel, seen through a filter of variance 1/4: slope variance 0.0025, and
    // alpha^2 is twice a slope variance.
    EXPECT_NEAR(square(alpha_filtered(0.1f, vec3(0.1f, 0, 0), none)), 0.01f + 2.0f * 0.0025f, 1e-6f);
    EXPECT_FLOAT_EQ(alpha_filtered(0.01f, vec3(0.1f, 0, 0), none),
                    alpha_filtered(0.01f, none, vec3(0, 0.1f, 0)));
    EXPECT_NEAR(alpha_filtered(0.0f, vec3(9.0f), vec3(9.0f)), std::sqrt(kMaxFootprintAlpha2), 1e-6f);
    EXPECT_LE(alpha_filtered(1.0f, vec3(9.0f), vec3(9.0f)), 1.0f);
}

TEST(Footprint, AverageNormalsFollowListing32) {
    EXPECT_FLOAT_EQ(alpha_from_average_normal(0.2f, 1.0f), 0.2f);
    EXPECT_FLOAT_EQ(alpha_from_average_normal(0.2f, 1.2f), 0.2f);
    const float length = 0.9f;
    const float kappa = (3.0f * length - length * length * length) / (1.0f - length * length);
    EXPECT_NEAR(alpha_from_average_normal(0.2f, length), std::sqrt(0.04f + 0.5f / kappa), 1e-6f);
    EXPECT_FLOAT_EQ(alpha_from_average_normal(0.2f, 0.0f), 1.0f);
    EXPECT_NEAR(perceptual_roughness_from_average_normal(0.5f, length),
                std::sqrt(alpha_from_average_normal(0.25f, length)), 1e-6f);
    for (float l = 0.1f; l < 1.0f; l += 0.1f) {
        EXPECT_GE(alpha_from_average_normal(0.2f, l - 0.05f), alpha_from_average_normal(0.2f, l));
    }
}

}  // namespace
}  // namespace candela::shading
