#include "candela/measure/flip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "shading/color_temperature.glsl"
#include "test_pictures.hpp"

using namespace candela::measure;
using namespace candela::test;

namespace {

const double kPpd = pixels_per_degree();

/// What section 4.1.3 makes of a HyAB distance. Green and blue of Rec.709 in L*a*b* (D65): (87.737, -86.184,
/// 83.179) and (32.297, 79.188, -107.860); Hunt: (87.737, -75.615, 72.979) and (32.297, 25.575, -34.836);
/// HyAB 55.440 + hypot(101.190, 107.815) = 203.30, to the power of 0.7: 41.276.
double error_of(double hyab) {
    const double most = 41.276, knee = 0.4 * most, d = std::pow(hyab, 0.7);
    return d < knee ? 0.95 / knee * d : 0.95 + 0.05 * (d - knee) / (most - knee);
}

double linear_of_lightness(double lightness) {
    return std::pow((lightness + 16.0) / 116.0, 3.0);
}

Picture grey_of_lightness(double lightness) {
    return uniform(40, 30, glm::vec3(static_cast<float>(linear_of_lightness(lightness))));
}

double cie_f(double t) {
    return t > 216.0 / 24389.0 ? std::cbrt(t) : t * 841.0 / 108.0 + 4.0 / 29.0;
}

struct Gaussian {
    double a, b;
};

/// What a line of one pixel keeps of its height in the middle, under the sum of a sqrt(pi / b) exp(-pi^2 d^2
/// / b) over d in degrees (table 1), cut at three deviations of the widest, sum 1.
double kept_of_a_line(const std::vector<Gaussian>& filter) {
    const double pi = std::acos(-1.0);
    const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / 2.0) / pi * kPpd));
    double column = 0.0, all = 0.0;
    for (const Gaussian& g : filter) {
        double line = 0.0;
        for (int i = -radius; i <= radius; ++i) line += std::exp(-pi * pi * i * i / (kPpd * kPpd * g.b));
        column += g.a * std::sqrt(pi / g.b) * line;
        all += g.a * std::sqrt(pi / g.b) * line * line;
    }
    return column / all;
}

/// FLIP in the middle of a vertical line of one pixel whose XYZ (relative to white) is `line`, on `ground`.
double flip_of_a_line(glm::vec3 ground, glm::vec3 line) {
    const glm::vec3 white_xyz(0.950456f, 1.0f, 1.089058f);
    const auto rgb = [&](glm::vec3 xyz) { return candela::shading::rec709_from_xyz(xyz * white_xyz); };
    const Picture r = uniform(61, 41, rgb(ground));
    const Picture x = draw(61, 41, [&](int i, int) { return rgb(i == 30 ? line : ground); });
    return double(flip(x, r, kPpd).values[20 * 61 + 30]);
}

}  // namespace

TEST(Flip, PixelsPerDegreeOfTheDefaultMonitor) {
    EXPECT_NEAR(kPpd, 67.0206, 1e-3);
}

TEST(Flip, OfBlackAgainstWhiteIsTheErrorOfHundredLightnesses) {
    const ErrorMap map = flip(uniform(40, 30, glm::vec3(0.0f)), uniform(40, 30, glm::vec3(1.0f)), kPpd);
    EXPECT_NEAR(error_of(100.0), 0.9674, 1e-4);
    for (const float v : map.values) EXPECT_NEAR(v, error_of(100.0), 2e-4);
}

TEST(Flip, OfGreenAgainstBlueIsOne) {
    EXPECT_NEAR(mean(flip(uniform(20, 20, {0, 1, 0}), uniform(20, 20, {0, 0, 1}), kPpd)), 1.0, 1e-5);
}

// Greys have no chroma: the distance is the difference in lightness, whatever the lightness.
TEST(Flip, OfTwoGreysDependsOnTheirLightnessesOnly) {
    for (const double low : {20.0, 50.0, 80.0}) {
        EXPECT_NEAR(mean(flip(grey_of_lightness(low), grey_of_lightness(low + 10.0), kPpd)), error_of(10.0),
                    5e-4)
            << low;
    }
}

// A step from black to white against black. At the first white column the achromatic filter (sigma 1.0342
// pixels, centre weight 0.38575) sees 0.5 + 0.38575 / 2 = 0.6929 of white, lightness 86.65. The edge detector
// sees all of its weights of one sign: 1, so the feature is (1 / sqrt 2)^0.5 = 0.8409 and the error
// error_of(86.65)^(1 - 0.8409) = 0.9940; without the feature it would be 0.9625.
TEST(Flip, AnEdgeThatAppearsRaisesTheError) {
    const Picture step = draw(80, 40, [](int x, int) { return glm::vec3(x >= 40 ? 1.0f : 0.0f); });
    const ErrorMap map = flip(step, uniform(80, 40, glm::vec3(0.0f)), kPpd);
    const double at_edge = double(map.values[20 * 80 + 40]);
    EXPECT_NEAR(at_edge, std::pow(error_of(86.65), 1.0 - std::sqrt(std::sqrt(0.5))), 3e-4);
    EXPECT_GT(at_edge, error_of(86.65) + 0.02);
    EXPECT_NEAR(map.values[20 * 80 + 79], error_of(100.0), 1e-3) << "far from the edge nothing appears";
    EXPECT_NEAR(map.values[20 * 80 + 0], 0.0, 1e-6);
}

// A faint line: the achromatic filter keeps 0.38575 of it. The edge detector sees nothing in its middle, the
// point detector its centre weight: with a deviation of 0.041 degrees = 2.7478 pixels that is 1 / (1 + 2
// (0.8120 + 0.3606)) = 0.2990 of its height.
TEST(Flip, OfAFaintLineFollowsTheAchromaticFilterAndThePointDetector) {
    const double height = 0.1, kept = kept_of_a_line({{1.0, 0.0047}});
    EXPECT_NEAR(kept, 0.38575, 1e-4);
    const double distance = 116.0 * (cie_f(0.5 + height * kept) - cie_f(0.5));
    const double feature = std::sqrt(0.2990 * height / std::sqrt(2.0));
    EXPECT_NEAR(flip_of_a_line(glm::vec3(0.5f), glm::vec3(0.6f)), std::pow(error_of(distance), 1.0 - feature),
                1e-3);
}

// Lines that differ in X alone, or in Z alone, change a* or b* and no lightness: no feature, and the
// chromatic filters decide. The Hunt effect multiplies by L* / 100.
TEST(Flip, OfColouredLinesFollowsTheChromaticFilters) {
    const double hunt = (116.0 * cie_f(0.4) - 16.0) / 100.0;
    const double a = 500.0 * (cie_f(0.4 + 0.02 * kept_of_a_line({{1.0, 0.0053}})) - cie_f(0.4));
    EXPECT_NEAR(flip_of_a_line(glm::vec3(0.4f), {0.42f, 0.4f, 0.4f}), error_of(hunt * a), 2e-3);
    const double b = 200.0 * (cie_f(0.4 + 0.2 * kept_of_a_line({{34.1, 0.04}, {13.5, 0.025}})) - cie_f(0.4));
    EXPECT_NEAR(flip_of_a_line(glm::vec3(0.4f), {0.4f, 0.4f, 0.6f}), error_of(hunt * b), 2e-3);
}

TEST(Flip, IsZeroForEqualSymmetricBoundedAndRisesWithBlur) {
    const Picture r = motley(64, 48);
    for (const float v : flip(r, r, kPpd).values) EXPECT_EQ(v, 0.0f);
    double before = 0.0;
    for (int radius = 1; radius <= 5; ++radius) {
        const Picture x = blurred(r, radius);
        const ErrorMap map = flip(x, r, kPpd), mirrored = flip(r, x, kPpd);
        EXPECT_EQ(map.values, mirrored.values);
        const auto [low, high] = std::minmax_element(map.values.begin(), map.values.end());
        EXPECT_GE(*low, 0.0f);
        EXPECT_LE(*high, 1.0f);
        EXPECT_GT(mean(map), before) << radius;
        before = mean(map);
    }
}

// From farther away (more pixels a degree) the same dither is harder to see.
TEST(Flip, FinePatternsVanishFromAfar) {
    const Picture dither = draw(64, 64, [](int x, int y) { return glm::vec3((x + y) % 2 ? 0.6f : 0.4f); });
    const Picture flat = uniform(64, 64, glm::vec3(0.5f));
    const double near_by = mean(flip(dither, flat, 15.0)), far = mean(flip(dither, flat, 150.0));
    EXPECT_LT(far, 0.25 * near_by);
}

TEST(Flip, OnePixelAndRequestsWithoutSense) {
    EXPECT_NEAR(flip(uniform(1, 1, glm::vec3(0.0f)), uniform(1, 1, glm::vec3(1.0f)), kPpd).values[0],
                error_of(100.0), 2e-4);
    EXPECT_THROW((void)flip(uniform(2, 1, {}), uniform(1, 2, {}), kPpd), std::invalid_argument);
    EXPECT_THROW((void)flip(uniform(2, 2, {}), uniform(2, 2, {}), 0.0), std::invalid_argument);
}

// The curve reaches 0.85 where 0.16002 x^2 - 0.28290 x - 0.11900 = 0: x = 2.1189.
TEST(HdrFlip, ExposuresRunFromTheBrightestToTheMedian) {
    Picture r = uniform(16, 16, glm::vec3(10.0f));
    r.pixels[7] = glm::vec3(80.0f);
    const ExposureRange range = hdr_flip_exposures(r);
    EXPECT_NEAR(range.start, std::log2(2.1189 / 80.0), 1e-3);
    EXPECT_NEAR(range.stop, std::log2(2.1189 / 10.0), 1e-3);
    EXPECT_EQ(range.count, 3);
}

TEST(HdrFlip, ABlackBackgroundDoesNotStretchTheRange) {
    Picture r = uniform(16, 16, glm::vec3(0.0f));
    r.pixels[7] = glm::vec3(80.0f);
    EXPECT_EQ(hdr_flip_exposures(r).count, 2);
    EXPECT_EQ(hdr_flip_exposures(uniform(4, 4, glm::vec3(0.0f))).count, 1);
    r.pixels[8] = glm::vec3(1e-30f);
    r.pixels[9] = glm::vec3(1e-30f);
    r.pixels[10] = glm::vec3(1e-30f);
    EXPECT_LE(hdr_flip_exposures(r).count, 40);
}

TEST(HdrFlip, DoesNotDependOnTheUnitAndBoundsEachExposure) {
    const Picture r = motley(40, 32);
    const Picture x = blurred(r, 2);
    Picture bright_r = r, bright_x = x;
    for (Picture* p : {&bright_r, &bright_x})
        for (glm::vec3& v : p->pixels) v *= 4096.0f;
    const ErrorMap a = hdr_flip(x, r, kPpd, hdr_flip_exposures(r));
    const ErrorMap b = hdr_flip(bright_x, bright_r, kPpd, hdr_flip_exposures(bright_r));
    for (std::size_t i = 0; i < a.values.size(); ++i) EXPECT_NEAR(a.values[i], b.values[i], 2e-4);
    for (const float v : hdr_flip(r, r, kPpd, hdr_flip_exposures(r)).values) EXPECT_EQ(v, 0.0f);
    const ExposureRange range = hdr_flip_exposures(r);
    const ErrorMap one = hdr_flip(x, r, kPpd, {range.start, range.start, 1});
    for (std::size_t i = 0; i < a.values.size(); ++i) EXPECT_GE(a.values[i], one.values[i]);
}

// What differs only above the display's white is lost on LDR-FLIP.
TEST(HdrFlip, SeesHighlightsThatTheDisplayClips) {
    const Picture r = draw(48, 48, [](int x, int) { return glm::vec3(x < 8 ? 50.0f : 0.2f); });
    const Picture x = draw(48, 48, [](int i, int) { return glm::vec3(i < 8 ? 5.0f : 0.2f); });
    EXPECT_EQ(mean(flip(x, r, kPpd)), 0.0);
    EXPECT_GT(mean(hdr_flip(x, r, kPpd, hdr_flip_exposures(r))), 0.05);
}
