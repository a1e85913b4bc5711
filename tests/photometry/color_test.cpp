#include <gtest/gtest.h>

#include "shading/color_temperature.glsl"
#include "shading/transfer.glsl"

namespace candela::shading {
namespace {

TEST(ColorTemperature, BlackBodyFollowsThePlanckianLocus) {
    // Wyszecki & Stiles, "Color Science" (2nd ed.), Table 1(3.11), to four digits; 2856 K is CIE illuminant
    // A.
    struct {
        float kelvin, x, y;
    } const rows[] = {{2000, 0.5267f, 0.4133f}, {2700, 0.4599f, 0.4106f}, {2855.5f, 0.44757f, 0.40745f},
                      {4000, 0.3805f, 0.3768f}, {5000, 0.3451f, 0.3516f}, {6500, 0.3135f, 0.3237f},
                      {10000, 0.2807f, 0.2884f}};
    for (const auto& row : rows) {
        const vec2 xy = black_body_xy(row.kelvin);
        EXPECT_NEAR(xy.x, row.x, 3e-4f) << row.kelvin << " K";
        EXPECT_NEAR(xy.y, row.y, 3e-4f) << row.kelvin << " K";
    }
}

TEST(ColorTemperature, DaylightHasThePublishedIlluminants) {
    struct {
        float kelvin, x, y;
    } const rows[] = {{5003, 0.3457f, 0.3585f},
                      {5503, 0.3324f, 0.3474f},
                      {6504, 0.3127f, 0.3290f},
                      {7504, 0.2990f, 0.3149f}};
    for (const auto& row : rows) {
        const vec2 xy = daylight_xy(row.kelvin);
        EXPECT_NEAR(xy.x, row.x, 2e-4f) << row.kelvin << " K";
        EXPECT_NEAR(xy.y, row.y, 2e-4f) << row.kelvin << " K";
    }
    EXPECT_NEAR(daylight_xy(6999.9f).x, daylight_xy(7000.1f).x, 1e-4f);
    EXPECT_EQ(daylight_xy(1000.0f), daylight_xy(4000.0f));
}

TEST(ColorTemperature, D65IsWhite) {
    const vec3 white = rec709_from_daylight(6504.0f);
    EXPECT_NEAR(white.x, 1.0f, 2e-3f);
    EXPECT_NEAR(white.y, 1.0f, 2e-3f);
    EXPECT_NEAR(white.z, 1.0f, 2e-3f);
}

TEST(ColorTemperature, LuminanceIsOneAndNoChannelIsNegative) {
    for (float kelvin = 800.0f; kelvin < 40000.0f; kelvin *= 1.05f) {
        for (const vec3 c : {rec709_from_black_body(kelvin), rec709_from_daylight(kelvin),
                             rec709_from_temperature(kelvin)}) {
            EXPECT_NEAR(luminance(c), 1.0f, 1e-5f) << kelvin;
            EXPECT_GE(std::min(c.x, std::min(c.y, c.z)), 0.0f) << kelvin;
        }
    }
}

TEST(ColorTemperature, HotterIsBluer) {
    float last = 0.0f;
    for (float kelvin = 2000.0f; kelvin < 25000.0f; kelvin *= 1.1f) {
        const vec3 c = rec709_from_temperature(kelvin);
        EXPECT_GT(c.z / c.x, last) << kelvin;
        last = c.z / c.x;
    }
}

TEST(Transfer, TheFastSrgbCurveIsWithinATenthOfACode) {
    for (int i = 0; i <= 100000; ++i) {
        const float x = float(i) / 100000.0f;
        ASSERT_NEAR(255.0f * srgb_from_linear_8bit(x), 255.0f * srgb_from_linear(x), 0.1f) << x;
    }
}

TEST(Transfer, SrgbHasTheStandardsValues) {
    // IEC 61966-2-1: code 128 of 255 is 0.2158605 of linear light; 0.18 encodes to 0.4613561.
    EXPECT_NEAR(linear_from_srgb(128.0f / 255.0f), 0.2158605f, 1e-6f);
    EXPECT_NEAR(srgb_from_linear(0.18f), 0.4613561f, 1e-6f);
    EXPECT_FLOAT_EQ(srgb_from_linear(0.001f), 0.01292f);
    EXPECT_FLOAT_EQ(linear_from_srgb(1.0f), 1.0f);
}

TEST(Transfer, Rec709HasTheStandardsValues) {
    EXPECT_NEAR(rec709_oetf_from_linear(0.18f), 0.4090f, 1e-4f);
    EXPECT_FLOAT_EQ(rec709_oetf_from_linear(0.01f), 0.045f);
    EXPECT_NEAR(rec709_oetf_from_linear(1.0f), 1.0f, 1e-6f);
}

TEST(Transfer, EveryCodeValueSurvivesTheRoundTrip) {
    for (int code = 0; code < 65536; code += 7) {
        const float v = float(code) / 65535.0f;
        EXPECT_NEAR(srgb_from_linear(linear_from_srgb(v)), v, 2e-6f) << code;
        // 0.018 and 1.099 are rounded: the pieces of BT.709 miss each other by 2.4e-4 between 0.081 and
        // 0.0813.
        EXPECT_NEAR(rec709_oetf_from_linear(linear_from_rec709_oetf(v)), v,
                    v > 0.0809f && v < 0.0814f ? 3e-4f : 2e-6f);
    }
    const vec3 c(0.001f, 0.2f, 0.9f);
    EXPECT_NEAR(length(linear_from_srgb(srgb_from_linear(c)) - c), 0.0f, 1e-6f);
    EXPECT_NEAR(length(linear_from_rec709_oetf(rec709_oetf_from_linear(c)) - c), 0.0f, 1e-6f);
}

}  // namespace
}  // namespace candela::shading
