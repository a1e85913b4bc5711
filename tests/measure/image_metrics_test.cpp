#include "candela/measure/image_metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "candela/measure/color_map.hpp"
#include "candela/measure/comparison.hpp"
#include "shading/exposure.glsl"
#include "test_pictures.hpp"

using namespace candela::measure;
using namespace candela::test;

TEST(ImageMetrics, ErrorsOfAConstantDifferenceAreThatDifference) {
    const Picture r = uniform(7, 5, {1.0f, 2.0f, 4.0f});
    const Picture x = uniform(7, 5, {1.5f, 1.0f, 4.0f});
    const Errors e = errors(x, r);
    EXPECT_NEAR(e.rmse, std::sqrt((0.25 + 1.0) / 3.0), 1e-7);
    EXPECT_NEAR(e.mae, 0.5, 1e-7);
    EXPECT_NEAR(e.max, 1.0, 1e-7);
    EXPECT_NEAR(e.bias[0], 0.5, 1e-7);
    EXPECT_NEAR(e.bias[1], -1.0, 1e-7);
    EXPECT_NEAR(e.bias[2], 0.0, 1e-7);
    EXPECT_NEAR(e.mean_reference[2], 4.0, 1e-7);
}

TEST(ImageMetrics, RelMseHasItsClosedForm) {
    EXPECT_NEAR(rel_mse(uniform(4, 4, glm::vec3(0.6f)), uniform(4, 4, glm::vec3(0.5f))), 0.01 / 0.26, 1e-7);
    EXPECT_NEAR(rel_mse(uniform(4, 4, glm::vec3(0.1f)), uniform(4, 4, glm::vec3(0.0f))), 1.0, 1e-6);
    // Luminance in cd/m^2 with its exposure is the same picture.
    EXPECT_NEAR(rel_mse(uniform(4, 4, glm::vec3(600.0f)), uniform(4, 4, glm::vec3(500.0f)), 0.001f),
                0.01 / 0.26, 1e-7);
}

TEST(ImageMetrics, PsnrOfATenthIsTwentyDecibels) {
    const Picture r = uniform(9, 3, glm::vec3(0.5f));
    EXPECT_NEAR(psnr_db(uniform(9, 3, glm::vec3(0.6f)), r), 20.0, 1e-5);
    EXPECT_TRUE(std::isinf(psnr_db(r, r)));
}

TEST(ImageMetrics, AMaskLeavesPixelsOut) {
    Picture x = uniform(4, 1, glm::vec3(0.0f)), r = x;
    x.pixels[2] = glm::vec3(100.0f);
    EXPECT_GT(errors(x, r).rmse, 1.0);
    EXPECT_EQ(errors(x, r, {1, 1, 0, 1}).rmse, 0.0);
    EXPECT_EQ(errors(x, r, {0, 0, 0, 0}).rmse, 0.0);
}

TEST(ImageMetrics, PicturesOfTwoSizesAreRefused) {
    EXPECT_THROW((void)errors(uniform(4, 3, {}), uniform(3, 4, {})), std::invalid_argument);
    EXPECT_THROW((void)ssim(uniform(4, 3, {}), uniform(3, 4, {})), std::invalid_argument);
}

// Without variance the structure term is 1 and the rest is (2 a b + C1) / (a^2 + b^2 + C1), C1 = 1e-4.
TEST(Ssim, OfConstantsIsTheLuminanceTerm) {
    const double expected = (2.0 * 0.2 * 0.6 + 1e-4) / (0.2 * 0.2 + 0.6 * 0.6 + 1e-4);
    for (const std::uint32_t size : {3u, 11u, 24u}) {
        EXPECT_NEAR(ssim(uniform(size, size, glm::vec3(0.2f)), uniform(size, size, glm::vec3(0.6f))),
                    expected, 1e-6)
            << size;
    }
}

// Far from the border of a step from 0 to 1 on a column of its own, one window sees: weights w(i) of the
// Gaussian, x = 1 on one column i = k. mean = w(k), variance = w(k) - w(k)^2, against black: covariance 0.
TEST(Ssim, OfALineAgainstBlackHasItsClosedForm) {
    double weights[11], sum = 0.0;
    for (int i = -5; i <= 5; ++i) sum += weights[i + 5] = std::exp(-i * i / 4.5);
    double expected = 0.0;
    for (const double weight : weights) {
        const double w = weight / sum, c1 = 1e-4, c2 = 9e-4;
        expected += c1 * c2 / ((w * w + c1) * (w - w * w + c2));
    }
    // 21 columns, the line in the middle: the 11 inner columns see it at each place of the window once.
    const Picture line = draw(21, 21, [](int x, int) { return glm::vec3(x == 10 ? 1.0f : 0.0f); });
    EXPECT_NEAR(ssim(line, uniform(21, 21, glm::vec3(0.0f))), expected / 11.0, 1e-6);
}

TEST(Ssim, IsOneForEqualSymmetricAndFallsWithBlur) {
    const Picture r = motley(48, 40);
    EXPECT_DOUBLE_EQ(ssim(r, r), 1.0);
    double before = 1.0;
    for (int radius = 1; radius <= 4; ++radius) {
        const Picture x = blurred(r, radius);
        const double now = ssim(x, r);
        EXPECT_LT(now, before) << radius;
        EXPECT_NEAR(now, ssim(r, x), 1e-12);
        before = now;
    }
    const Picture negative = draw(48, 40, [&](int x, int y) {
        return glm::vec3(1.0f) - r.pixels[std::size_t(y) * 48 + std::size_t(x)];
    });
    EXPECT_LT(ssim(negative, r), 0.0);
    EXPECT_GE(ssim(negative, r), -1.0);
}

TEST(Comparison, PixelsWithoutAValueAreCountedAndLeftOut) {
    const float nan = std::nanf("");
    const Picture r = motley(32, 24);
    Picture x = blurred(r, 1);
    ComparisonOptions options;
    const Comparison whole = compare(x, r, options);
    Picture same = x;
    same.pixels[100] = r.pixels[100];  // what the rule puts there
    x.pixels[100].y = nan;
    const Comparison holed = compare(x, r, options);
    EXPECT_EQ(whole.metrics.nonfinite, 0u);
    EXPECT_EQ(holed.metrics.nonfinite, 1u);
    EXPECT_TRUE(std::isnan(holed.flip.values[100]));
    EXPECT_TRUE(std::isnan(holed.hdr_flip.values[100]));
    const double pixels = 32 * 24;
    EXPECT_NEAR(holed.metrics.flip, compare(same, r, options).metrics.flip * pixels / (pixels - 1), 1e-2);
    for (const std::string& name : metric_names()) {
        const auto value = metric_value(holed.metrics, name);
        ASSERT_TRUE(value) << name;
        EXPECT_TRUE(std::isfinite(*value)) << name;
    }
    x.pixels[100] = glm::vec3(std::numeric_limits<float>::infinity());
    EXPECT_EQ(compare(x, r, options).metrics.nonfinite, 1u);
    Picture none = uniform(32, 24, glm::vec3(nan));
    EXPECT_EQ(compare(none, r, options).metrics.nonfinite, 32u * 24u);
    EXPECT_EQ(compare(none, r, options).metrics.errors.rmse, 0.0);
}

TEST(Comparison, EqualPicturesHaveNoErrorAndUnitsFollow) {
    const Picture r = motley(24, 16);
    ComparisonOptions options;
    const Metrics equal = compare(r, r, options).metrics;
    for (const std::string& name : metric_names()) {
        if (name == "psnr") continue;
        EXPECT_DOUBLE_EQ(*metric_value(equal, name), name == "ssim" ? 1.0 : 0.0) << name;
    }
    // A thousand times the light at a thousandth of the exposure looks the same; RMSE in cd/m^2 does not.
    Picture bright_r = r, bright_x = blurred(r, 2);
    const Metrics dim = compare(bright_x, r, options).metrics;
    for (Picture* p : {&bright_r, &bright_x})
        for (glm::vec3& v : p->pixels) v *= 1000.0f;
    options.exposure = 0.001f;
    const Metrics bright = compare(bright_x, bright_r, options).metrics;
    for (const char* name : {"relmse", "flip", "hdr-flip", "ssim", "psnr"})
        EXPECT_NEAR(*metric_value(bright, name) / *metric_value(dim, name), 1.0, 1e-3) << name;
    EXPECT_NEAR(bright.errors.rmse / dim.errors.rmse, 1000.0, 1e-2);
}

TEST(Comparison, DisplayPicturesHaveNoHdrFlip) {
    ComparisonOptions options;
    options.meaning = PixelMeaning::display;
    const Picture r = motley(16, 16);
    const Comparison c = compare(blurred(r, 1), r, options);
    EXPECT_FALSE(metric_value(c.metrics, "hdr-flip"));
    EXPECT_TRUE(c.hdr_flip.values.empty());
    EXPECT_GT(c.metrics.flip, 0.0);
}

TEST(Comparison, MetersAsTheAutomaticExposureDoes) {
    Picture p = uniform(4, 1, glm::vec3(100.0f));
    p.pixels[0] = glm::vec3(1.0f);
    p.pixels[1] = glm::vec3(0.0f);
    p.pixels[2] = glm::vec3(std::nanf(""));
    // 1 and 100 are left: the logarithmic mean is 10 cd/m^2, without the darkest tenth a little more.
    EXPECT_NEAR(*metered_ev100(p), candela::shading::ev100_from_luminance(10.0f), 0.3f);
    EXPECT_FALSE(metered_ev100(uniform(2, 2, glm::vec3(0.0f))));
}

TEST(ColorMap, RunsFromBlackToPaleWithRisingLightness) {
    int before = -1;
    for (int i = 0; i <= 100; ++i) {
        const Rgb8 c = magma(float(i) / 100.0f);
        const int lightness = 2126 * c[0] + 7152 * c[1] + 722 * c[2];
        EXPECT_GE(lightness, before) << i;
        before = lightness;
    }
    EXPECT_EQ(magma(-1.0f), magma(0.0f));
    EXPECT_EQ(magma(2.0f), (Rgb8{252, 253, 191}));
    EXPECT_EQ(magma(std::nanf("")), (Rgb8{0, 255, 0}));
}
