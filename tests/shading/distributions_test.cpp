#include <gtest/gtest.h>

#include "directions.hpp"
#include "shading/anisotropy.glsl"
#include "shading/microfacet.glsl"
#include "shading/sheen.glsl"

namespace candela::shading {
namespace {

/// Integral over the hemisphere of a function of x = tan^2(theta), spaced in log x, times NoH.
template <class F>
double integrate_over_tangent(F density) {
    const int steps = 20000;
    const double low = -30.0;
    const double high = 30.0;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double x = std::exp(low + (high - low) * (i + 0.5) / steps);
        sum += density(x) * x / ((1.0 + x) * (1.0 + x));
    }
    return sum * (high - low) / steps * M_PI;
}

TEST(D_GGX, IntegratesToOneOverProjectedHemisphere) {
    for (const float alpha : {0.002f, 0.01f, 0.03f, 0.1f, 0.3f, 0.6f, 1.0f}) {
        const double integral = integrate_over_tangent(
            [&](double x) { return D_GGX_cos2_sin2(float(1.0 / (1.0 + x)), float(x / (1.0 + x)), alpha); });
        EXPECT_NEAR(integral, 1.0, 1e-3) << "alpha " << alpha;
        const double from_vectors = integrate_over_tangent([&](double x) {
            const vec3 h(float(std::sqrt(x / (1.0 + x))), 0.0f, float(std::sqrt(1.0 / (1.0 + x))));
            return D_GGX(vec3(0, 0, 1), h, alpha);
        });
        EXPECT_NEAR(from_vectors, 1.0, 1e-3) << "alpha " << alpha;
    }
}

TEST(D_GGX, FromTheCosineAloneIntegratesToOneFromAlphaOneHundredth) {
    for (const float alpha : {0.01f, 0.03f, 0.1f, 0.3f, 0.6f, 1.0f}) {
        const double integral =
            integrate_over_tangent([&](double x) { return D_GGX(float(std::sqrt(1.0 / (1.0 + x))), alpha); });
        EXPECT_NEAR(integral, 1.0, 1e-3) << "alpha " << alpha;
    }
}

TEST(D_GGX, VectorFormKeepsItsDigitsAtTheSmallestAlpha) {
    // The closed form in double precision, at 0 to 6 widths from the peak.
    for (int i = 0; i <= 60; ++i) {
        const double angle = 0.1 * i * double(kMinAlpha);
        const double a2 = double(kMinAlpha) * double(kMinAlpha);
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        const double exact = a2 / (M_PI * std::pow(s * s + a2 * c * c, 2));
        const vec3 n = normalize(vec3(0.3f, -0.5f, 0.7f));
        vec3 t;
        vec3 b;
        orthonormal_basis(n, t, b);
        const vec3 h = normalize(n * float(c) + t * float(s));
        EXPECT_NEAR(D_GGX(n, h, kMinAlpha) / exact, 1.0, 2e-3) << i;
    }
}

TEST(D_GGXAnisotropic, IntegratesToOneOverProjectedHemisphere) {
    const vec2 widths[] = {{0.01f, 0.01f}, {0.01f, 0.3f}, {0.1f, 1.0f}, {0.5f, 0.05f}, {1.0f, 1.0f}};
    for (const vec2& alpha : widths) {
        // Over slopes p = (alpha_t r cos, alpha_b r sin): D NoH dw = D NoH^4 dp.
        const int steps = 2000;
        const int turns = 64;
        double sum = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double r2 = std::exp(-25.0 + 50.0 * (i + 0.5) / steps);
            for (int j = 0; j < turns; ++j) {
                const double phi = 2.0 * M_PI * (j + 0.5) / turns;
                const double x = alpha.x * std::sqrt(r2) * std::cos(phi);
                const double y = alpha.y * std::sqrt(r2) * std::sin(phi);
                const double z = 1.0 / std::sqrt(1.0 + x * x + y * y);
                const double d = D_GGXAnisotropic(float(z), float(x * z), float(y * z), alpha.x, alpha.y);
                sum += d * z * z * z * z * alpha.x * alpha.y * 0.5 * r2;
            }
        }
        EXPECT_NEAR(sum * 50.0 / steps * 2.0 * M_PI / turns, 1.0, 1e-3) << alpha.x << ' ' << alpha.y;
    }
}

TEST(D_GGXAnisotropic, IsTheIsotropicOneForEqualWidths) {
    Uniform u(1);
    for (int i = 0; i < 1000; ++i) {
        const vec3 h = u.hemisphere();
        const vec3 v = u.hemisphere();
        const vec3 l = u.hemisphere();
        const float alpha = 0.05f + 0.95f * u();
        const float d = D_GGX(h.z, alpha);
        EXPECT_NEAR(D_GGXAnisotropic(h.z, h.x, h.y, alpha, alpha), d, 2e-5f * d);
        const float smith = V_SmithGGXCorrelated(v.z, l.z, alpha);
        EXPECT_NEAR(V_SmithGGXCorrelatedAnisotropic(v.z, v.x, v.y, l.z, l.x, l.y, alpha, alpha), smith,
                    2e-5f * smith);
        EXPECT_NEAR(G1_SmithGGXAnisotropic(v, vec2(alpha)), G1_SmithGGX(v.z, alpha), 1e-5f);
    }
}

TEST(D_Charlie, IntegratesToOneOverProjectedHemisphere) {
    for (const float roughness : {0.07f, 0.2f, 0.5f, 1.0f}) {
        const int steps = 200000;
        double sum = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double theta = 0.5 * M_PI * (i + 0.5) / steps;
            sum +=
                D_Charlie(float(std::cos(theta)), sheen_alpha(roughness)) * std::cos(theta) * std::sin(theta);
        }
        EXPECT_NEAR(sum * 0.5 * M_PI / steps * 2.0 * M_PI, 1.0, 1e-3) << roughness;
    }
}

TEST(Visibility, SmithMaskingConservesTheProjectedAreaOfVisibleNormals) {
    // Heitz 2014, equation 16: the visible normals cover the cosine of the view.
    for (const float alpha : {0.05f, 0.3f, 1.0f}) {
        for (const float NoV : {0.05f, 0.3f, 0.9f}) {
            const vec3 v = at_cosine(NoV);
            const int steps = 1000;
            double sum = 0.0;
            for (int i = 0; i < steps; ++i) {
                const double x = std::exp(-25.0 + 50.0 * (i + 0.5) / steps);
                const float z = float(1.0 / std::sqrt(1.0 + x));
                for (int j = 0; j < 256; ++j) {
                    const vec3 h = at_cosine(z, TWO_PI * (float(j) + 0.5f) / 256.0f);
                    const double d = D_GGX_cos2_sin2(float(1.0 / (1.0 + x)), float(x / (1.0 + x)), alpha);
                    sum += d * std::fmax(dot(v, h), 0.0f) * 0.5 * x / std::pow(1.0 + x, 1.5);
                }
            }
            sum *= 50.0 / steps * 2.0 * M_PI / 256.0;
            EXPECT_NEAR(sum * G1_SmithGGX(NoV, alpha) / NoV, 1.0, 2e-3) << alpha << ' ' << NoV;
        }
    }
}

TEST(Visibility, FormsAgreeWhereTheyMust) {
    Uniform u(2);
    for (int i = 0; i < 1000; ++i) {
        const float NoV = 0.01f + 0.99f * u();
        const float NoL = 0.01f + 0.99f * u();
        const float alpha = 0.01f + 0.99f * u();
        const float g1g1 = G1_SmithGGX(NoV, alpha) * G1_SmithGGX(NoL, alpha) / (4.0f * NoV * NoL);
        EXPECT_NEAR(V_SmithGGXUncorrelated(NoV, NoL, alpha) / g1g1, 1.0f, 1e-5f);
        // Correlation only ever makes a lit facet more likely to be seen.
        EXPECT_GE(V_SmithGGXCorrelated(NoV, NoL, alpha), V_SmithGGXUncorrelated(NoV, NoL, alpha) * 0.99999f);
        EXPECT_LE(V_SmithGGXCorrelated(NoV, NoL, alpha) * 4.0f * NoV * NoL, 1.00001f);
    }
    EXPECT_NEAR(V_SmithGGXCorrelated(0.5f, 0.7f, kMinAlpha) * 4.0f * 0.5f * 0.7f, 1.0f, 1e-4f);
    EXPECT_FLOAT_EQ(k_analytic(1.0f), 0.5f);
    EXPECT_FLOAT_EQ(k_analytic(0.0f), 0.125f);
    EXPECT_FLOAT_EQ(k_image_based(0.5f), 0.25f);
    // Karis 2013: k = alpha / 2 equals Smith at alpha = 1.
    for (float c = 0.05f; c <= 1.0f; c += 0.05f) {
        EXPECT_NEAR(V_SchlickSmith(c, 0.4f, k_image_based(1.0f)), V_SmithGGXUncorrelated(c, 0.4f, 1.0f),
                    1e-4f)
            << c;
    }
}

TEST(Visibility, StaysFiniteAtTheHorizon) {
    for (const float alpha : {kMinAlpha, 0.5f, 1.0f}) {
        EXPECT_TRUE(std::isfinite(V_SmithGGXCorrelated(0.0f, 0.0f, alpha) * D_GGX(1.0f, alpha)));
        EXPECT_TRUE(std::isfinite(V_SmithGGXUncorrelated(0.0f, 0.0f, alpha)));
        EXPECT_TRUE(std::isfinite(V_Charlie(0.0f, 0.0f, alpha)));
    }
    EXPECT_TRUE(std::isfinite(V_SchlickSmith(0.0f, 0.0f, 0.0f)));
}

}  // namespace
}  // namespace candela::shading
