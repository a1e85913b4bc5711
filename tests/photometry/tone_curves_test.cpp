#include "shading/tone_curves.glsl"

#include <gtest/gtest.h>

namespace candela::shading {
namespace {

void expect_near(const vec3& actual, const vec3& expected, float tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << "channel " << i;
}

TEST(ToneCurves, EveryCurveKeeps18PercentGrey) {
    for (const int kind : {kToneNone, kToneAces, kToneAgx, kToneNeutral})
        expect_near(display_from_exposed(kind, vec3(0.18f)), vec3(0.18f), 1e-4f);
}

TEST(ToneCurves, UnlitColoursAreAddedAfterTheCurve) {
    const vec3 orange(1.0f, 0.2158605f, 0.0f);
    for (const int kind : {kToneNone, kToneAces, kToneAgx, kToneNeutral}) {
        EXPECT_EQ(display_with_unlit(kind, vec4(0.0f), orange), orange);
        expect_near(display_with_unlit(kind, vec4(0.09f, 0.09f, 0.09f, 0.5f), 0.5f * orange),
                    vec3(0.09f) + 0.5f * orange, 1e-4f);
    }
}

TEST(ToneCurves, AllStayInTheDisplayRangeAndGreysRise) {
    for (int kind = kToneNone; kind <= kToneNeutral; ++kind) {
        float last = -1.0f;
        for (float stops = -16.0f; stops < 17.0f; stops += 0.01f) {
            const vec3 out = tone_curve(kind, vec3(std::exp2(stops)));
            for (int i = 0; i < 3; ++i) {
                ASSERT_GE(out[i], 0.0f) << kind << " at " << stops;
                ASSERT_LE(out[i], 1.0f) << kind << " at " << stops;
            }
            ASSERT_GE(out.y, last - 1e-6f) << kind << " at " << stops;
            last = out.y;
        }
        expect_near(tone_curve(kind, vec3(0.0f)), vec3(0.0f), 1e-4f);
        EXPECT_GT(tone_curve(kind, vec3(1000.0f)).y, 0.98f) << kind;
    }
}

TEST(ToneCurves, ExtremeAndNegativeInputStaysFinite) {
    for (int kind = kToneNone; kind <= kToneNeutral; ++kind)
        for (const vec3 c :
             {vec3(1e30f), vec3(-1.0f, 0.5f, 2.0f), vec3(1e6f, 0.0f, 0.0f), vec3(0.0f, 0.0f, 1e-30f)})
            for (int i = 0; i < 3; ++i) {
                EXPECT_GE(tone_curve(kind, c)[i], 0.0f) << kind;
                EXPECT_LE(tone_curve(kind, c)[i], 1.0f) << kind;
            }
}

TEST(ToneCurves, NoneClips) {
    EXPECT_EQ(tone_curve(kToneNone, vec3(0.25f, 1.5f, -0.5f)), vec3(0.25f, 1.0f, 0.0f));
}

TEST(ToneCurves, NeutralKeepsColoursBelowItsCompressionAsTheSpecificationSays) {
    // Every channel in [0.08, 0.8]: the input less 0.04, exactly.
    for (const vec3 c : {vec3(0.08f), vec3(0.18f), vec3(0.8f, 0.1f, 0.3f), vec3(0.5f, 0.79f, 0.08f)})
        expect_near(tone_curve(kToneNeutral, c), c - vec3(0.04f), 1e-6f);
    // The toe: a colour with a black channel is untouched; below 0.08 the smallest channel goes as 6.25 x^2.
    expect_near(tone_curve(kToneNeutral, vec3(0.76f, 0.3f, 0.0f)), vec3(0.76f, 0.3f, 0.0f), 1e-6f);
    expect_near(tone_curve(kToneNeutral, vec3(0.04f)), vec3(0.01f), 1e-6f);
}

TEST(ToneCurves, NeutralKeepsHueAndIsSmoothWhereCompressionStarts) {
    const vec3 c(6.0f, 3.0f, 1.0f);
    const vec3 out = tone_curve(kToneNeutral, c);
    // The middle channel stays at the same place between the smallest and the largest.
    EXPECT_NEAR((out.y - out.z) / (out.x - out.z), (c.y - c.z) / (c.x - c.z), 1e-5f);
    const float below = tone_curve(kToneNeutral, vec3(0.8f)).x - tone_curve(kToneNeutral, vec3(0.799f)).x;
    const float above = tone_curve(kToneNeutral, vec3(0.801f)).x - tone_curve(kToneNeutral, vec3(0.8f)).x;
    EXPECT_NEAR(below, above, 1e-5f);
    // p = 2, p_n = 1 - 0.24^2 / 1.48, g = 1 / (0.15 (p - p_n) + 1) by hand.
    expect_near(tone_curve(kToneNeutral, vec3(2.0f, 0.5f, 0.0f)), vec3(0.961081f, 0.337455f, 0.129579f),
                1e-5f);
    // p = 1 - 0.04, p_n = 1 - 0.24^2 / (0.96 + 0.24 - 0.76) by hand.
    EXPECT_NEAR(tone_curve(kToneNeutral, vec3(1.0f)).x, 0.8690909f, 1e-6f);
}

TEST(ToneCurves, AcesFitHasItsPublishedValues) {
    // (v (v + 0.0245786) - 0.000090537) / (v (0.983729 v + 0.4329510) + 0.238081) by hand; both matrices keep
    // grey.
    expect_near(tone_curve(kToneAces, vec3(0.18f)), vec3(0.105593f), 2e-5f);
    expect_near(tone_curve(kToneAces, vec3(1.0f)), vec3(0.619117f), 2e-5f);
    expect_near(tone_curve(kToneAces, vec3(8.0f)), vec3(0.960f), 5e-3f);
    // A saturated red: rows of the input matrix give v = (0.59719, 0.076, 0.0284).
    expect_near(tone_curve(kToneAces, vec3(1.0f, 0.0f, 0.0f)), vec3(0.688028f, 0.000000f, 0.002639f), 1e-5f);
}

// The sixth-degree polynomial by which Wrensch 2023 approximates AgX's sigmoid, stated there with a mean
// squared error of 3.7e-6.
float wrensch_contrast(float t) {
    return (((((15.5f * t - 40.14f) * t + 31.96f) * t - 6.868f) * t + 0.4298f) * t + 0.1191f) * t - 0.00232f;
}

TEST(ToneCurves, AgxSigmoidAgreesWithItsPublishedApproximation) {
    double sum2 = 0.0;
    for (int i = 0; i <= 1000; ++i) {
        const float t = float(i) / 1000.0f;
        EXPECT_NEAR(agx_contrast(t), wrensch_contrast(t), 0.012f) << t;
        sum2 += square(agx_contrast(t) - wrensch_contrast(t));
    }
    EXPECT_LT(sum2 / 1001.0, 8e-6);
    EXPECT_NEAR(agx_contrast(0.0f), 0.0f, 1e-5f);
    EXPECT_NEAR(agx_contrast(1.0f), 1.0f, 1e-5f);
    const float pivot = 10.0f / 16.5f;
    EXPECT_NEAR(agx_contrast(pivot), 0.5f, 1e-6f);
    EXPECT_NEAR((agx_contrast(pivot + 1e-3f) - agx_contrast(pivot - 1e-3f)) / 2e-3f, 2.0f, 1e-3f);
}

TEST(ToneCurves, AgxPutsMiddleGreyAtHalfOfTheCodeRangeAndDesaturatesHighlights) {
    expect_near(tone_curve(kToneAgx, vec3(0.18f)), vec3(std::pow(0.5f, 2.2f)), 1e-3f);
    const vec3 bright = tone_curve(kToneAgx, vec3(16.0f, 0.2f, 0.2f));
    EXPECT_GT(bright.y / bright.x, 0.2f);
    // 6.5 stops over middle grey is white, 10 under is black.
    EXPECT_GT(tone_curve(kToneAgx, vec3(0.18f * std::exp2(6.5f))).x, 0.995f);
    EXPECT_LT(tone_curve(kToneAgx, vec3(0.18f * std::exp2(-10.0f))).x, 1e-4f);
}

}  // namespace
}  // namespace candela::shading
