#include "shading/fresnel.glsl"

#include <gtest/gtest.h>

#include <complex>

namespace candela::shading {
namespace {

TEST(Fresnel, DielectricHasItsKnownValues) {
    EXPECT_NEAR(F_DielectricExact(1.0f, 1.5f), 0.04f, 1e-6f);
    EXPECT_NEAR(F_DielectricExact(0.0f, 1.5f), 1.0f, 1e-6f);
    // At Brewster's angle only the perpendicular part is left: ((n^2 - 1) / (n^2 + 1))^2 / 2.
    const float brewster = std::cos(std::atan(1.5f));
    EXPECT_NEAR(F_DielectricExact(brewster, 1.5f), 0.5f * square(1.25f / 3.25f), 1e-5f);
    // From inside glass nothing leaves beyond asin(1 / 1.5) = 41.8 degrees.
    EXPECT_EQ(F_DielectricExact(std::cos(0.74f), 1.0f / 1.5f), 1.0f);
    EXPECT_LT(F_DielectricExact(std::cos(0.72f), 1.0f / 1.5f), 1.0f);
}

TEST(Fresnel, DielectricIsTheSameFromBothSidesAlongOneRay) {
    for (float cos_i = 0.05f; cos_i < 1.0f; cos_i += 0.05f) {
        const float cos_t = std::sqrt(1.0f - (1.0f - cos_i * cos_i) / (1.5f * 1.5f));
        EXPECT_NEAR(F_DielectricExact(cos_i, 1.5f), F_DielectricExact(cos_t, 1.0f / 1.5f), 1e-5f);
    }
}

TEST(Fresnel, ConductorWithoutAbsorptionIsADielectric) {
    for (float cos_i = 0.0f; cos_i <= 1.0f; cos_i += 0.0625f) {
        const float f = F_ConductorExact(cos_i, vec3(1.5f, 1.33f, 2.4f), vec3(0.0f)).x;
        EXPECT_NEAR(f, F_DielectricExact(cos_i, 1.5f), 1e-5f) << cos_i;
    }
}

TEST(Fresnel, ConductorHasItsKnownNormalReflectance) {
    // ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2), with the constants of gold at 650, 550 and 450 nm.
    const vec3 eta(0.16f, 0.42f, 1.51f);
    const vec3 k(3.48f, 2.35f, 1.88f);
    for (int i = 0; i < 3; ++i) {
        const float expected =
            (square(eta[i] - 1.0f) + square(k[i])) / (square(eta[i] + 1.0f) + square(k[i]));
        EXPECT_NEAR(F_ConductorExact(1.0f, eta, k)[i], expected, 1e-5f);
        EXPECT_NEAR(F_ConductorExact(0.0f, eta, k)[i], 1.0f, 1e-5f);
    }
}

TEST(Fresnel, ConductorIsTheComplexAmplitudesSquared) {
    for (float cos_i = 0.05f; cos_i <= 1.0f; cos_i += 0.19f) {
        for (const float eta : {0.05f, 0.5f, 1.2f, 3.0f}) {
            for (const float k : {0.1f, 0.9f, 2.0f, 6.0f}) {
                const std::complex<double> n(eta, k);
                const double c = cos_i;
                const std::complex<double> root = std::sqrt(n * n - (1.0 - c * c));
                const double perpendicular = std::norm((c - root) / (c + root));
                const double parallel = std::norm((n * n * c - root) / (n * n * c + root));
                EXPECT_NEAR(F_ConductorExact(cos_i, vec3(eta), vec3(k)).x, 0.5 * (perpendicular + parallel),
                            2e-6)
                    << cos_i << ' ' << eta << ' ' << k;
            }
        }
    }
}

TEST(Fresnel, SchlickFollowsTheExactForm) {
    for (float cos_i = 0.0f; cos_i <= 1.0f; cos_i += 0.02f) {
        EXPECT_NEAR(F_Schlick(0.04f, 1.0f, cos_i), F_DielectricExact(cos_i, 1.5f), 0.036f) << cos_i;
        // Karis 2013: "the difference is imperceptible".
        EXPECT_NEAR(F_SphericalGaussian(vec3(0.04f), cos_i).x, F_Schlick(0.04f, 1.0f, cos_i), 0.01f) << cos_i;
    }
    EXPECT_EQ(F_Schlick(vec3(0.0f), vec3(0.0f), 0.1f), vec3(0.0f));
    EXPECT_EQ(F_SphericalGaussian(vec3(0.0f), vec3(0.0f), 0.1f), vec3(0.0f));
}

TEST(Fresnel, ReflectanceConversions) {
    EXPECT_NEAR(f0_from_ior(1.5f), 0.04f, 1e-6f);
    EXPECT_NEAR(f0_from_ior(1.33f), 0.02f, 1e-4f);
    EXPECT_FLOAT_EQ(f0_from_ior(0.0f), 1.0f);
    EXPECT_FLOAT_EQ(f0_from_reflectance(0.5f), 0.04f);
    EXPECT_FLOAT_EQ(f0_from_reflectance(1.0f), 0.16f);
    // Micro-occlusion begins below 2 % and ends in no reflection at all.
    EXPECT_FLOAT_EQ(f90_from_f0(vec3(0.04f)), 1.0f);
    EXPECT_NEAR(f90_from_f0(vec3(0.0201f)), 1.0f, 0.01f);
    EXPECT_NEAR(f90_from_f0(vec3(0.01f)), 0.5f, 0.01f);
    EXPECT_FLOAT_EQ(f90_from_f0(vec3(0.0f)), 0.0f);
}

}  // namespace
}  // namespace candela::shading
