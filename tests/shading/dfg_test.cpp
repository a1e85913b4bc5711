#include "shading/dfg.glsl"

#include <gtest/gtest.h>

#include "directions.hpp"

namespace candela::shading {
namespace {

constexpr float kCosines[] = {0.01f, 0.02f, 0.05f, 0.1f, 0.2f, 0.4f, 0.6f, 0.8f, 1.0f};

/// Scale and bias by integrating f(v,l) NoL over the hemisphere with D and a visibility.
template <class Visibility>
glm::dvec2 integral(float NoV, float perceptual_roughness, Visibility visibility) {
    const float alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    const vec3 v = at_cosine(NoV);
    return integrate_hemisphere<glm::dvec2>(v, {alpha}, 512, [&](const vec3& l) {
        const vec3 h = normalize(v + l);
        const double fresnel = pow5(1.0f - dot(l, h));
        return glm::dvec2(1.0 - fresnel, fresnel) *
               double(D_GGX(vec3(0, 0, 1), h, alpha) * visibility(NoV, l.z, alpha));
    });
}

TEST(Dfg, IsTheIntegralWithinOneThousandth) {
    for (const float roughness : {0.05f, 0.1f, 0.2f, 0.4f, 0.6f, 0.8f, 1.0f}) {
        for (const float NoV : kCosines) {
            const glm::dvec2 expected = integral(NoV, roughness, V_SmithGGXCorrelated);
            const vec4 dfg = integrate_dfg(NoV, roughness, 1024);
            EXPECT_NEAR(dfg.x, expected.x, 1e-3) << roughness << ' ' << NoV;
            EXPECT_NEAR(dfg.y, expected.y, 1e-3) << roughness << ' ' << NoV;
        }
    }
}

TEST(Dfg, Ue4IsTheIntegralOfItsOwnModel) {
    for (const float roughness : {0.1f, 0.3f, 0.6f, 1.0f}) {
        for (const float NoV : {0.05f, 0.2f, 0.6f, 1.0f}) {
            const glm::dvec2 expected = integral(NoV, roughness, [](float a, float b, float alpha) {
                return V_SchlickSmith(a, b, k_image_based(alpha));
            });
            const vec4 dfg = integrate_dfg_ue4(NoV, roughness, 1024);
            EXPECT_NEAR(dfg.x, expected.x, 2e-3) << roughness << ' ' << NoV;
            EXPECT_NEAR(dfg.y, expected.y, 2e-3) << roughness << ' ' << NoV;
        }
    }
}

TEST(Dfg, ConvergesWithMorePoints) {
    double last = 1.0;
    for (const uint n : {64u, 256u, 1024u}) {
        double worst = 0.0;
        for (const float roughness : {0.05f, 0.1f, 0.3f, 0.6f, 1.0f}) {
            for (const float NoV : kCosines) {
                const vec4 difference =
                    integrate_dfg(NoV, roughness, n) - integrate_dfg(NoV, roughness, 8192);
                worst = std::max({worst, double(std::abs(difference.x)), double(std::abs(difference.y)),
                                  double(std::abs(difference.w))});
            }
        }
        EXPECT_LT(worst, last / 2.0) << n;
        last = worst;
    }
    EXPECT_LT(last, 1e-3);
}

TEST(Dfg, TextureCoordinatesAndParametersAreInverse) {
    for (uint y = 0; y < uint(kDfgSize); ++y) {
        for (uint x = 0; x < uint(kDfgSize); ++x) {
            const vec2 at = dfg_parameters(x, y);
            const vec2 texel = dfg_uv(at.x, at.y) * float(kDfgSize) - vec2(0.5f);
            EXPECT_NEAR(texel.x, float(x), 1e-4f);
            EXPECT_NEAR(texel.y, float(y), 1e-4f);
        }
    }
    EXPECT_EQ(dfg_parameters(0, 0), vec2(0.0f));
    EXPECT_EQ(dfg_parameters(uint(kDfgSize) - 1u, uint(kDfgSize) - 1u), vec2(1.0f));
    EXPECT_EQ(dfg_uv(-1.0f, 2.0f), dfg_uv(0.0f, 1.0f));
}

TEST(Dfg, ApproximationFollowsTheUe4Table) {
    // Two straight lines in roughness: within 0.18 for metals; for dielectrics within 0.04, but 0.13 at
    // grazing angles.
    for (float roughness = 0.1f; roughness <= 1.0f; roughness += 0.1f) {
        for (float NoV = 0.1f; NoV <= 1.0f; NoV += 0.1f) {
            const vec4 dfg = integrate_dfg_ue4(NoV, roughness, 512);
            const vec3 gold(1.0f, 0.77f, 0.34f);
            const vec3 approximation = EnvBRDFApprox(gold, roughness, NoV);
            for (int i = 0; i < 3; ++i) {
                EXPECT_NEAR(approximation[i], gold[i] * dfg.x + dfg.y, 0.18f) << roughness << ' ' << NoV;
            }
            EXPECT_NEAR(EnvBRDFApprox(vec3(0.04f), roughness, NoV).x, 0.04f * dfg.x + dfg.y,
                        NoV < 0.35f ? 0.14f : 0.04f)
                << roughness << ' ' << NoV;
        }
    }
    const vec4 all = dfg_approx(0.5f, 0.5f);
    EXPECT_FLOAT_EQ(all.z, albedo_DisneyRenormalized(0.5f, 0.5f));
    EXPECT_FLOAT_EQ(all.x + all.y, EnvBRDFApprox(vec3(1.0f), 0.5f, 0.5f).x);
}

}  // namespace
}  // namespace candela::shading
