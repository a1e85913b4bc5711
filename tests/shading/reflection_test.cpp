#include <gtest/gtest.h>

#include "directions.hpp"
#include "shading/dfg.glsl"
#include "shading/dominant_direction.glsl"
#include "shading/layer_reflection.glsl"

namespace candela::shading {
namespace {

const vec3 kNormal(0.0f, 0.0f, 1.0f);
constexpr float kCosines[] = {0.001f, 0.02f, 0.1f, 0.3f, 0.6f, 0.9f, 1.0f};
constexpr float kRoughness[] = {0.0f, 0.05f, 0.1f, 0.2f, 0.4f, 0.6f, 0.8f, 1.0f};

std::vector<LobeRead> reads_of(int count, const vec3& v, float roughness, float share) {
    std::vector<LobeRead> out(static_cast<std::size_t>(count));
    if (count == 1) out[0] = fitted_reflection(kNormal, v, v.z, roughness, share);
    if (count == 2) stretched_reflection_2(kNormal, v, v.z, roughness, share, out[0], out[1]);
    if (count == 3) stretched_reflection_3(kNormal, v, v.z, roughness, share, out[0], out[1], out[2]);
    return out;
}

/// First moment of the lobe that a read of a prefiltered map is: D cos, about its direction.
double mean_cosine(float perceptual_roughness) {
    const float alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    double sum = 0.0;
    double first = 0.0;
    constexpr int points = 4096;
    for (int i = 0; i < points; ++i) {
        const double u = (i + 0.5) / points;
        const double tangent2 = double(alpha) * double(alpha) * u / (1.0 - u);
        const double cosine = 2.0 / (1.0 + tangent2) - 1.0;
        if (cosine <= 0.0) continue;
        sum += cosine;
        first += cosine * cosine;
    }
    return first / sum;
}

glm::dvec3 first_moment(const std::vector<LobeRead>& reads) {
    glm::dvec3 sum(0.0);
    for (const LobeRead& r : reads)
        sum += double(r.weight) * mean_cosine(r.perceptual_roughness) * glm::dvec3(r.direction);
    return sum;
}

/// Of D V F cos over its albedo, by quadrature.
glm::dvec3 first_moment_of_lobe(const vec3& v, float perceptual_roughness, float f0) {
    const float alpha = alpha_from_perceptual_roughness(perceptual_roughness);
    const glm::dvec4 sum = integrate_hemisphere<glm::dvec4>(v, {alpha}, 96, [&](const vec3& l) {
        const vec3 h = normalize(v + l);
        const double lobe = double(D_GGX(kNormal, h, alpha) * V_SmithGGXCorrelated(v.z, l.z, alpha) *
                                   F_Schlick(f0, 1.0f, dot(v, h)));
        return glm::dvec4(glm::dvec3(l), 1.0) * lobe;
    });
    return glm::dvec3(sum) / sum.w;
}

TEST(StretchedReflection, IsAMeanOfUnitDirections) {
    for (const int count : {1, 2, 3})
        for (const float NoV : kCosines)
            for (const float roughness : kRoughness)
                for (const float share : {0.0f, 0.3f, 1.0f}) {
                    float weights = 0.0f;
                    for (const LobeRead& r : reads_of(count, at_cosine(NoV, 1.0f), roughness, share)) {
                        EXPECT_GE(r.weight, 0.0f);
                        EXPECT_GE(r.perceptual_roughness, 0.0f);
                        EXPECT_LE(r.perceptual_roughness, 1.0f);
                        EXPECT_NEAR(length(r.direction), 1.0f, 1e-5f) << NoV << ' ' << roughness;
                        weights += r.weight;
                    }
                    EXPECT_NEAR(weights, 1.0f, 1e-6f) << count << ' ' << NoV << ' ' << roughness;
                }
}

TEST(StretchedReflection, LooksAlongTheNormalAtNormalIncidence) {
    for (const int count : {1, 2, 3})
        for (const float roughness : kRoughness)
            for (const LobeRead& r : reads_of(count, kNormal, roughness, 0.0f))
                EXPECT_NEAR(r.direction.z, 1.0f, 1e-6f) << count << ' ' << roughness;
}

TEST(StretchedReflection, StaysInThePlaneOfIncidence) {
    for (const int count : {1, 2, 3})
        for (const float roughness : kRoughness) {
            const vec3 v = at_cosine(0.3f, 2.0f);
            for (const LobeRead& r : reads_of(count, v, roughness, 0.5f))
                EXPECT_NEAR(dot(r.direction, normalize(cross(kNormal, v))), 0.0f, 1e-6f);
        }
}

TEST(StretchedReflection, OfASmoothSurfaceIsTheMirror) {
    for (const int count : {1, 2, 3})
        for (const float NoV : {0.1f, 0.3f, 0.6f, 0.9f}) {
            const vec3 v = at_cosine(NoV, 1.0f);
            for (const LobeRead& r : reads_of(count, v, 0.0f, 0.0f)) {
                EXPECT_EQ(r.perceptual_roughness, 0.0f);
                EXPECT_GT(dot(r.direction, reflect(-v, kNormal)), 0.9995f) << count << ' ' << NoV;
            }
        }
}

// The mean direction is what a gradient of light sees: no read knows of Fresnel but by the share.
TEST(StretchedReflection, HasTheMeanDirectionOfTheLobe) {
    double worst = 0.0;
    double worst_mirror = 0.0;
    for (const float f0 : {1.0f, 0.04f})
        for (const float roughness : {0.2f, 0.4f, 0.6f, 0.8f, 1.0f})
            for (const float NoV : {0.1f, 0.2f, 0.4f, 0.6f, 0.8f, 1.0f}) {
                const vec3 v = at_cosine(NoV);
                const glm::dvec3 truth = first_moment_of_lobe(v, roughness, f0);
                const vec2 ab = integrate_ggx_albedo(NoV, roughness, 256);
                const float share = fresnel_share(f0, 1.0f, ab);
                const std::vector<LobeRead> mirror{{reflect(-v, kNormal), roughness, 1.0f}};
                worst_mirror = std::max(worst_mirror, glm::distance(first_moment(mirror), truth));
                for (const int count : {1, 2, 3}) {
                    const double off =
                        glm::distance(first_moment(reads_of(count, v, roughness, share)), truth);
                    EXPECT_LT(off, 0.17) << count << ' ' << f0 << ' ' << roughness << ' ' << NoV;
                    if (count > 1) worst = std::max(worst, off);
                }
            }
    EXPECT_LT(worst, 0.105);
    EXPECT_GT(worst_mirror, 0.4);
}

// The lobe ends there, also of what was not fitted: f0 of nearly nothing, whose light is all Fresnel's rise.
TEST(StretchedReflection, DoesNotLookBelowTheHorizon) {
    for (const float roughness : kRoughness)
        for (const float NoV : kCosines)
            for (const float share : {0.0f, 0.3f, 0.7f, 1.0f})
                for (const int count : {1, 2, 3})
                    for (const LobeRead& read : reads_of(count, at_cosine(NoV, 1.0f), roughness, share)) {
                        EXPECT_GE(read.direction.z, -1e-6f) << count << ' ' << roughness << ' ' << NoV;
                        EXPECT_NEAR(length(read.direction), 1.0f, 1e-5f);
                    }
}

TEST(FresnelShare, IsWhatTheRiseReflects) {
    EXPECT_FLOAT_EQ(fresnel_share(0.5f, 1.0f, vec2(0.4f, 0.1f)), 0.1f / 0.3f);
    EXPECT_EQ(fresnel_share(0.0f, 0.0f, vec2(0.4f, 0.1f)), 0.0f);
}

TEST(AnisotropicReads, LieAlongTheTangentSeenFromAbove) {
    const vec2 alpha(0.5f, 0.05f);
    const AnisotropicLobe lobe =
        anisotropic_lobe(kNormal, vec3(1, 0, 0), vec3(0, 1, 0), kNormal, 1.0f, alpha);
    float x = -2.0f;
    for (int i = 0; i < kAnisotropicReads; ++i) {
        const LobeRead read = anisotropic_read(lobe, i);
        EXPECT_NEAR(read.direction.y, 0.0f, 1e-5f);
        EXPECT_GT(read.direction.x, x);
        EXPECT_LT(read.perceptual_roughness, std::sqrt(0.2f));
        x = read.direction.x;
    }
    EXPECT_GT(x, 0.8f);
}

TEST(AnisotropicReads, AreOneOfAnIsotropicSurfaceSeenFromAbove) {
    const AnisotropicLobe lobe =
        anisotropic_lobe(kNormal, vec3(1, 0, 0), vec3(0, 1, 0), kNormal, 1.0f, vec2(0.25f));
    for (int i = 0; i < kAnisotropicReads; ++i) {
        EXPECT_NEAR(anisotropic_read(lobe, i).direction.z, 1.0f, 1e-6f);
        EXPECT_NEAR(anisotropic_read(lobe, i).perceptual_roughness, 0.5f, 1e-5f);
    }
}

TEST(AnisotropicReads, HaveWeightAndAreFiniteAtEveryAngle) {
    Uniform u(7);
    for (int i = 0; i < 20000; ++i) {
        const vec3 v = at_cosine(std::max(u() * u(), 1e-4f), TWO_PI * u());
        const AnisotropicLobe lobe =
            anisotropic_lobe(kNormal, vec3(1, 0, 0), vec3(0, 1, 0), v, v.z, anisotropic_alpha(u(), u()));
        float weights = 0.0f;
        for (int k = 0; k < kAnisotropicReads; ++k) {
            const LobeRead read = anisotropic_read(lobe, k);
            EXPECT_GE(read.weight, 0.0f);
            EXPECT_NEAR(length(read.direction), 1.0f, 1e-4f);
            EXPECT_GE(read.perceptual_roughness, 0.0f);
            EXPECT_LE(read.perceptual_roughness, 1.0f);
            weights += read.weight;
        }
        EXPECT_GT(weights, 1e-4f);
    }
}

TEST(SheenRead, LeansToTheViewerAndNowhereFromAbove) {
    EXPECT_NEAR(sheen_read(kNormal, kNormal, 1.0f, 0.3f).direction.z, 1.0f, 1e-6f);
    for (const float roughness : {0.1f, 0.3f, 0.6f, 1.0f}) {
        const vec3 v = at_cosine(0.4f, 1.0f);
        const vec3 d = sheen_read(kNormal, v, 0.4f, roughness).direction;
        EXPECT_GT(dot(d, normalize(v - 0.4f * kNormal)), 0.1f) << roughness;
        EXPECT_GT(d.z, 0.0f) << roughness;
    }
}

TEST(EnvBrdfApprox, OfANonmetalFoldsThePaperConstants) {
    for (const float roughness : {0.0f, 0.3f, 0.7f, 1.0f})
        for (const float NoV : {0.0f, 0.2f, 0.6f, 1.0f})
            EXPECT_NEAR(env_brdf_approx_nonmetal(roughness, NoV),
                        EnvBRDFApprox(vec3(0.04f), roughness, NoV).x, 0.0025f);
    EXPECT_EQ(fully_rough_color(vec3(0.2f), vec3(1.0f)), vec3(0.65f));
}

// A matt surface has no retro-reflection from above, and some towards a viewer who grazes it.
TEST(DiffuseDominantDirection, LeansToTheViewerAtGrazingAngles) {
    EXPECT_EQ(diffuse_dominant_direction(kNormal, kNormal, 1.0f, 1.0f), kNormal);
    const vec3 v = at_cosine(0.1f);
    EXPECT_EQ(diffuse_dominant_direction(kNormal, v, 0.1f, 0.0f), kNormal);
    EXPECT_GT(diffuse_dominant_direction(kNormal, v, 0.1f, 1.0f).x, 0.15f);
}

}  // namespace
}  // namespace candela::shading
