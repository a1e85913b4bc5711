#include "shading/environment.glsl"

#include <gtest/gtest.h>

namespace candela::shading {
namespace {

void expect_near(const vec3& actual, const vec3& expected, float tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << "component " << i;
}

vec3 some_direction(int i) {
    const float z = 1.0f - 2.0f * (float(i) + 0.5f) / 4096.0f;
    const float r = std::sqrt(1.0f - z * z);
    const float a = 2.399963f * float(i);
    return {r * std::cos(a), z, r * std::sin(a)};
}

TEST(Environment, AxesLieWhereSceneHppSays) {
    EXPECT_NEAR(equirect_uv(vec3(0, 0, -1)).x, 0.5f, 1e-7f);
    EXPECT_NEAR(equirect_uv(vec3(0, 0, -1)).y, 0.5f, 1e-7f);
    EXPECT_NEAR(equirect_uv(vec3(1, 0, 0)).x, 0.75f, 1e-7f);
    EXPECT_NEAR(equirect_uv(vec3(-1, 0, 0)).x, 0.25f, 1e-7f);
    EXPECT_NEAR(equirect_uv(vec3(0, 1, 0)).y, 0.0f, 1e-7f);
    EXPECT_NEAR(equirect_uv(vec3(0, -1, 0)).y, 1.0f, 1e-7f);
    expect_near(equirect_direction(vec2(0.5f, 0.5f)), vec3(0, 0, -1), 1e-6f);
    expect_near(equirect_direction(vec2(0.75f, 0.5f)), vec3(1, 0, 0), 1e-6f);
}

TEST(Environment, DirectionAndUvAreInverse) {
    for (int i = 0; i < 4096; ++i) {
        const vec3 d = some_direction(i);
        const vec2 uv = equirect_uv(d);
        EXPECT_GE(uv.x, 0.0f);
        EXPECT_LE(uv.x, 1.0f);
        expect_near(equirect_direction(uv), d, 2e-6f);
    }
}

TEST(Environment, TexelsCoverTheSphereOnce) {
    for (const uint height : {1u, 4u, 64u, 1024u}) {
        double sum = 0.0;
        for (uint row = 0; row < height; ++row)
            sum += 2.0 * height * double(equirect_texel_solid_angle(row, 2 * height, height));
        EXPECT_NEAR(sum, 4.0 * M_PI, 1e-4) << height;
    }
}

TEST(Environment, UpFacingIlluminanceOfAConstantSkyIsPiTimesLuminance) {
    const uint width = 256, height = 128;
    double lux = 0.0;
    for (uint row = 0; row < height / 2; ++row) {
        const vec3 d = equirect_direction(vec2(0.5f, (float(row) + 0.5f) / float(height)));
        lux += width * double(d.y) * double(equirect_texel_solid_angle(row, width, height)) * 1000.0;
    }
    EXPECT_NEAR(lux, M_PI * 1000.0, 0.5);
}

TEST(Environment, RotationIsCounterClockwiseSeenFromAbove) {
    // From above with +X to the right, -Z is up: a quarter turn counter-clockwise takes +X to -Z.
    expect_near(rotate_about_y(vec3(1, 0, 0), 0.5f * PI), vec3(0, 0, -1), 1e-6f);
    expect_near(rotate_about_y(vec3(0, 0, -1), 0.5f * PI), vec3(-1, 0, 0), 1e-6f);
    expect_near(rotate_about_y(vec3(0.3f, 0.8f, -0.2f), 0.0f), vec3(0.3f, 0.8f, -0.2f), 1e-7f);
}

TEST(Environment, FastMappingIsNearTheExactOne) {
    for (int i = 0; i < 20000; ++i) {
        const float a = (float(i) / 10000.0f - 1.0f) * PI;
        EXPECT_NEAR(atan2_fast(std::sin(a), std::cos(a)), std::atan2(std::sin(a), std::cos(a)), 1.3e-5f);
    }
    EXPECT_EQ(atan2_fast(0.0f, 0.0f), 0.0f);
    for (int i = 0; i < 4096; ++i) {
        const vec2 fast = equirect_uv_fast(some_direction(i));
        const vec2 exact = equirect_uv(some_direction(i));
        EXPECT_NEAR(fast.x, exact.x, 2.1e-6f);
        EXPECT_NEAR(fast.y, exact.y, 4.1e-6f);
    }
}

}  // namespace
}  // namespace candela::shading
