#include "shading/sampling.glsl"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "directions.hpp"
#include "shading/sheen.glsl"

namespace candela::shading {
namespace {

constexpr int kBins = 12;  // in the cosine; twice as many in azimuth

/// Fraction of the density's mass in a bin, by midpoints.
double mass(const std::function<double(vec3)>& pdf, double low, double high, int azimuth_bin) {
    const int side = 48;
    double sum = 0.0;
    for (int i = 0; i < side; ++i) {
        const float z = float(low + (high - low) * (i + 0.5) / side);
        for (int j = 0; j < side; ++j) {
            const double phi = 2.0 * M_PI * (azimuth_bin + (j + 0.5) / side) / (2 * kBins);
            sum += pdf(at_cosine(z, float(phi)));
        }
    }
    return sum / side / side * (high - low) * 2.0 * M_PI / (2 * kBins);
}

/// Pearson's chi-square of samples against their density over bins of equal cosine^power steps. Returns the
/// statistic minus its expectation, in standard deviations.
double chi_square(const std::function<vec3(vec2)>& sample, const std::function<double(vec3)>& pdf,
                  double power) {
    const int samples = 400000;
    std::vector<double> counts(kBins * kBins * 2);
    Uniform u(11);
    for (int i = 0; i < samples; ++i) {
        const vec3 d = sample(u.two());
        const double z = std::pow(1.0 - std::fmin(d.z, 1.0f), 1.0 / power);
        const double phi = std::atan2(d.y, d.x) / (2.0 * M_PI);
        const int a = std::min(int((phi < 0.0 ? phi + 1.0 : phi) * 2 * kBins), 2 * kBins - 1);
        counts[size_t(std::min(int(z * kBins), kBins - 1) * 2 * kBins + a)] += 1.0;
    }
    double statistic = 0.0;
    double freedom = -1.0;
    double pooled_expected = 0.0;
    double pooled_count = 0.0;
    for (int i = 0; i < kBins; ++i) {
        const double high = 1.0 - std::pow(double(i) / kBins, power);
        const double low = 1.0 - std::pow(double(i + 1) / kBins, power);
        for (int j = 0; j < 2 * kBins; ++j) {
            const double expected = samples * mass(pdf, low, high, j);
            const double count = counts[size_t(i * 2 * kBins + j)];
            if (expected < 10.0) {
                pooled_expected += expected;
                pooled_count += count;
                continue;
            }
            statistic += (count - expected) * (count - expected) / expected;
            freedom += 1.0;
        }
    }
    if (pooled_expected > 10.0) {
        statistic += std::pow(pooled_count - pooled_expected, 2) / pooled_expected;
        freedom += 1.0;
    }
    return (statistic - freedom) / std::sqrt(2.0 * freedom);
}

/// Integral of a density over the upper hemisphere, over bins that narrow towards the pole.
double total(const std::function<double(vec3)>& pdf, double power) {
    double sum = 0.0;
    for (int i = 0; i < kBins; ++i) {
        const double high = 1.0 - std::pow(double(i) / kBins, power);
        const double low = 1.0 - std::pow(double(i + 1) / kBins, power);
        for (int j = 0; j < 2 * kBins; ++j) sum += mass(pdf, low, high, j);
    }
    return sum;
}

void expect_agreement(const std::function<vec3(vec2)>& sample, const std::function<double(vec3)>& pdf,
                      double power, const std::string& what) {
    EXPECT_NEAR(total(pdf, power), 1.0, 2e-3) << what;
    EXPECT_LT(chi_square(sample, pdf, power), 5.0) << what;
}

TEST(Sampling, HemispheresFollowTheirDensities) {
    expect_agreement(
        sample_uniform_hemisphere, [](vec3) { return double(pdf_uniform_hemisphere()); }, 1.0, "uniform");
    expect_agreement(
        sample_cosine_hemisphere, [](vec3 d) { return double(pdf_cosine_hemisphere(d.z)); }, 1.0, "cosine");
}

TEST(Sampling, NormalsOfGgxFollowTheirDensity) {
    for (const vec2& alpha : {vec2(0.1f), vec2(0.5f), vec2(1.0f), vec2(0.2f, 0.6f)}) {
        expect_agreement([&](vec2 u) { return sample_ggx_ndf(u, alpha); },
                         [&](vec3 h) { return double(pdf_ggx_ndf(h, alpha)); }, 3.0, "ndf");
    }
}

TEST(Sampling, VisibleNormalsOfGgxFollowTheirDensity) {
    for (const vec2& alpha : {vec2(0.1f), vec2(0.5f), vec2(1.0f), vec2(0.2f, 0.6f)}) {
        for (const float NoV : {0.05f, 0.5f, 1.0f}) {
            const vec3 v = at_cosine(NoV, 0.7f);
            expect_agreement([&](vec2 u) { return sample_ggx_vndf(u, v, alpha); },
                             [&](vec3 h) { return double(pdf_ggx_vndf(v, h, alpha)); }, 3.0,
                             "vndf " + std::to_string(alpha.x) + " " + std::to_string(NoV));
        }
    }
}

TEST(Sampling, NormalsOfCharlieFollowTheirDensity) {
    for (const float roughness : {0.3f, 0.6f, 1.0f}) {
        const float alpha = sheen_alpha(roughness);
        expect_agreement([&](vec2 u) { return sample_charlie_ndf(u, alpha); },
                         [&](vec3 h) { return double(D_Charlie(h.z, alpha) * h.z); }, 1.0, "charlie");
    }
}

TEST(Sampling, ReflectedDirectionsHaveDensityOne) {
    // Light directions from visible normals: those below the horizon are part of the density.
    for (const float alpha : {0.2f, 0.8f}) {
        const vec3 v = at_cosine(0.4f, 0.3f);
        double sum = 0.0;
        const int side = 1500;
        for (int i = 0; i < side; ++i) {
            const float z = -1.0f + 2.0f * (float(i) + 0.5f) / float(side);
            for (int j = 0; j < side; ++j) {
                const vec3 l = at_cosine(z, TWO_PI * (float(j) + 0.5f) / float(side));
                const vec3 h = normalize(v + l);
                sum += pdf_reflected(pdf_ggx_vndf(v, h, alpha), dot(v, h));
            }
        }
        EXPECT_NEAR(sum * 4.0 * M_PI / side / side, 1.0, 2e-3) << alpha;
    }
}

TEST(Sampling, ExtremeNumbersGiveUnitVectors) {
    const float last = unit_float(0xffffffffu);
    ASSERT_LT(last, 1.0f);
    for (const float x : {0.0f, 0.5f, last}) {
        for (const float y : {0.0f, 0.5f, last}) {
            const vec2 u(x, y);
            for (const float alpha : {kMinAlpha, 1.0f}) {
                for (const float NoV : {1e-4f, 0.5f, 1.0f}) {
                    EXPECT_NEAR(length(sample_ggx_vndf(u, at_cosine(NoV), alpha)), 1.0f, 1e-5f);
                }
                EXPECT_NEAR(length(sample_ggx_ndf(u, alpha)), 1.0f, 1e-5f);
                EXPECT_NEAR(length(sample_charlie_ndf(u, alpha)), 1.0f, 1e-5f);
            }
            EXPECT_NEAR(length(sample_cosine_hemisphere(u)), 1.0f, 1e-5f);
            EXPECT_NEAR(length(sample_uniform_hemisphere(u)), 1.0f, 1e-5f);
        }
    }
}

}  // namespace
}  // namespace candela::shading
