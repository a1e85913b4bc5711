#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "shading/dominant_direction.glsl"
#include "shading/octahedral.glsl"
#include "shading/probes/composition.glsl"
#include "shading/probes/parallax.glsl"
#include "shading/probes/volume.glsl"
#include "shading/sequence.glsl"
#include "shading/spherical_harmonics.glsl"

using namespace candela::shading;

namespace {

vec3 direction(uint i, uint count) {
    const float z = 1.0f - 2.0f * (float(i) + 0.5f) / float(count);
    const float turn = 2.399963f * float(i);
    const float r = std::sqrt(1.0f - z * z);
    return {r * std::cos(turn), r * std::sin(turn), z};
}

}  // namespace

// Frostbite 4.9.5, as corrected in version 2.0: overlapping probes see the same part of the lobe.
TEST(Composition, TenOverlappingProbesOfVisibilityOneTenthGiveOneTenth) {
    ProbeSum sum = empty_probe_sum();
    for (int i = 0; i < 10; ++i) add_probe(sum, vec3(100.0f), 0.1f);
    EXPECT_FLOAT_EQ(sum.alpha, 0.1f);
    EXPECT_FLOAT_EQ(sum.luminance_nit.x, 10.0f);
    EXPECT_FLOAT_EQ(add_distant(sum, vec3(1000.0f)).x, 10.0f + 900.0f);
}

TEST(Composition, NeverDarkensAndNeverBrightensWhatIsTheSameEverywhere) {
    for (uint i = 0; i < 256; ++i) {
        ProbeSum sum = empty_probe_sum();
        for (uint k = 0; k < 5; ++k) add_probe(sum, vec3(7.0f), sobol_owen(i, k).x);
        EXPECT_NEAR(add_distant(sum, vec3(7.0f)).x, 7.0f, 1e-5f);
    }
}

TEST(Composition, TheSmallerProbeHidesTheLargerOneWhereItSees) {
    ProbeSum sum = empty_probe_sum();
    add_probe(sum, vec3(1.0f, 0.0f, 0.0f), 0.75f);
    add_probe(sum, vec3(0.0f, 1.0f, 0.0f), 1.0f);
    EXPECT_FLOAT_EQ(sum.luminance_nit.x, 0.75f);
    EXPECT_FLOAT_EQ(sum.luminance_nit.y, 0.25f);
    add_probe(sum, vec3(0.0f, 0.0f, 1.0f), 1.0f);
    EXPECT_EQ(sum.luminance_nit.z, 0.0f);
}

TEST(Parallax, TheRayLeavesTheProxyOnItsSurface) {
    const vec3 half(2.0f, 1.0f, 3.0f);
    for (uint i = 0; i < 512; ++i) {
        const vec3 d = direction(i, 512);
        const vec3 from =
            (2.0f * vec3(sobol_owen(i, 1u).x, sobol_owen(i, 1u).y, sobol_owen(i, 2u).x) - 1.0f) * half;
        const vec3 face = glm::abs(from + box_exit_m(from, d, half) * d) / half;
        EXPECT_NEAR(std::max({face.x, face.y, face.z}), 1.0f, 1e-5f);
        const vec3 in_ball = from / glm::length(half) * 1.5f;
        EXPECT_NEAR(glm::length(in_ball + sphere_exit_m(in_ball, d, 1.5f) * d), 1.5f, 1e-5f);
    }
}

// From the probe's own place there is no parallax, and no other footprint.
TEST(Parallax, AtTheProbeNothingIsCorrected) {
    for (const int shape : {kProxySphere, kProxyBox}) {
        for (uint i = 0; i < 64; ++i) {
            const vec3 d = direction(i, 64);
            const vec3 capture(0.2f, -0.1f, 0.3f);
            const ProbeLookup at = probe_lookup(shape, vec3(2.0f), capture, capture, d, 0.3f);
            EXPECT_NEAR(glm::distance(glm::normalize(at.direction), d), 0.0f, 1e-5f);
            EXPECT_NEAR(at.perceptual_roughness, 0.3f, 1e-5f);
        }
    }
}

TEST(Parallax, AMirrorLooksAtTheVeryPointOfTheProxyThatItReflects) {
    const vec3 half(2.0f);
    const vec3 position(1.5f, -2.0f, 0.5f);
    const vec3 d = glm::normalize(vec3(-1.0f, 2.0f, 0.3f));
    const vec3 point = position + box_exit_m(position, d, half) * d;
    const vec3 capture(0.0f, 0.5f, 0.0f);
    const ProbeLookup at = probe_lookup(kProxyBox, half, capture, position, d, 0.0f);
    EXPECT_NEAR(glm::distance(at.direction, glm::normalize(point - capture)), 0.0f, 1e-6f);
    EXPECT_EQ(at.perceptual_roughness, 0.0f);
}

TEST(Parallax, AFullyRoughSurfaceTakesTheDirectionAsItIs) {
    const vec3 d = glm::normalize(vec3(-1.0f, 2.0f, 0.3f));
    const ProbeLookup at = probe_lookup(kProxyBox, vec3(2.0f), vec3(0.0f), vec3(1.5f, -1.9f, 0.0f), d, 1.0f);
    EXPECT_NEAR(glm::distance(at.direction, d), 0.0f, 1e-6f);
    EXPECT_FLOAT_EQ(at.perceptual_roughness, 1.0f);
}

// Changed from the paper: a room twice as large in every measure reflects the same.
TEST(Parallax, DoesNotDependOnTheUnitOfLength) {
    const vec3 d = direction(17, 64);
    const vec3 position(0.5f, -0.9f, 0.2f);
    const ProbeLookup small = probe_lookup(kProxyBox, vec3(1.0f), vec3(0.1f), position, d, 0.4f);
    const ProbeLookup large = probe_lookup(kProxyBox, vec3(10.0f), vec3(1.0f), 10.0f * position, d, 0.4f);
    EXPECT_NEAR(glm::distance(small.direction, large.direction), 0.0f, 1e-5f);
    EXPECT_NEAR(small.perceptual_roughness, large.perceptual_roughness, 1e-5f);
}

TEST(Parallax, GoesOnWithoutAStepBehindTheProxy) {
    const vec3 d = glm::normalize(vec3(0.3f, 1.0f, -0.2f));
    for (const int shape : {kProxySphere, kProxyBox}) {
        const ProbeLookup in =
            probe_lookup(shape, vec3(1.0f), vec3(0.0f), vec3(0.0f, -0.999f, 0.0f), d, 0.2f);
        const ProbeLookup out =
            probe_lookup(shape, vec3(1.0f), vec3(0.0f), vec3(0.0f, -1.001f, 0.0f), d, 0.2f);
        EXPECT_NEAR(glm::distance(in.direction, out.direction), 0.0f, 4e-3f);
        EXPECT_NEAR(in.perceptual_roughness, out.perceptual_roughness, 4e-3f);
    }
}

TEST(DistanceBasedRoughness, IsSharpUpCloseAndNeverAboveWhatItWas) {
    for (const float roughness : {0.0f, 0.1f, 0.4f, 0.8f, 1.0f}) {
        float before = 0.0f;
        for (float ratio = 0.0f; ratio < 3.0f; ratio += 0.05f) {
            const float r = distance_based_roughness(ratio, 1.0f, roughness);
            EXPECT_GE(r, before);
            EXPECT_LE(r, roughness + 1e-6f);
            before = r;
        }
        EXPECT_NEAR(before, roughness, 1e-6f);
    }
    EXPECT_LT(distance_based_roughness(0.1f, 1.0f, 0.3f), 0.15f);
}

TEST(Influence, IsWholeInsideNothingAtItsLimitAndSmoothBetween) {
    const vec3 half(2.0f, 1.0f, 3.0f);
    for (const int shape : {kProxySphere, kProxyBox}) {
        // With margin 0 the paper's: it fades within the proxy.
        EXPECT_EQ(probe_influence(shape, vec3(0.0f), half, 0.0f, 0.5f), 1.0f);
        EXPECT_EQ(probe_influence(shape, vec3(2.0f, 0.0f, 0.0f), half, 0.0f, 0.5f), 0.0f);
        // With a margin of the fade the whole proxy is lit in full.
        EXPECT_EQ(probe_influence(shape, vec3(1.999f, 0.0f, 0.0f), half, 0.5f, 0.5f), 1.0f);
        EXPECT_EQ(probe_influence(shape, vec3(2.5f, 0.0f, 0.0f), half, 0.5f, 0.5f), 0.0f);
        float before = 1.0f;
        for (float x = 1.9f; x < 2.6f; x += 0.005f) {
            const float w = probe_influence(shape, vec3(x, 0.0f, 0.0f), half, 0.5f, 0.5f);
            EXPECT_LE(w, before);
            EXPECT_LT(before - w, 0.02f);
            before = w;
        }
    }
}

TEST(Harmonics, AreOrthonormal) {
    constexpr uint count = 20000;
    for (int a = 0; a < kShCoefficients; ++a) {
        for (int b = 0; b <= a; ++b) {
            double sum = 0.0;
            for (uint i = 0; i < count; ++i)
                sum += double(sh_basis(a, direction(i, count)) * sh_basis(b, direction(i, count)));
            EXPECT_NEAR(sum * 4.0 * double(PI) / count, a == b ? 1.0 : 0.0, 2e-3) << a << ' ' << b;
        }
    }
}

// Light of bands 0 to 2 has exactly the irradiance that the cosine lobe says.
TEST(Harmonics, IrradianceOfSmoothLightIsExact) {
    const vec3 n = glm::normalize(vec3(0.3f, 0.8f, -0.5f));
    constexpr uint count = 40000;
    for (int k = 0; k < kShCoefficients; ++k) {
        double irradiance = 0.0;
        for (uint i = 0; i < count; ++i) {
            const vec3 l = direction(i, count);
            irradiance += double(sh_basis(k, l) * std::max(glm::dot(n, l), 0.0f));
        }
        irradiance *= 4.0 / count;  // over pi
        EXPECT_NEAR(irradiance, double(sh_cosine_over_pi(k) * sh_basis(k, n)), 1e-3) << k;
    }
}

TEST(DiffuseDirection, LeansToTheViewerOnlyWhenRoughAndGrazing) {
    const vec3 n(0.0f, 0.0f, 1.0f);
    const vec3 v = glm::normalize(vec3(1.0f, 0.0f, 0.3f));
    EXPECT_EQ(diffuse_dominant_direction(n, v, v.z, 0.0f), n);
    EXPECT_GT(diffuse_dominant_direction(n, v, v.z, 1.0f).x, 0.05f);
    EXPECT_NEAR(glm::distance(diffuse_dominant_direction(n, n, 1.0f, 1.0f), n), 0.0f, 1e-6f);
}

TEST(VolumeWeights, WallsHideProbesAndOpenAirDoesNot) {
    EXPECT_EQ(distance_visibility(2.0f, 4.0f, 1.5f, 0.01f), 1.0f);
    EXPECT_LT(distance_visibility(1.0f, 1.0f, 1.5f, 0.02f), 1e-6f);
    EXPECT_GT(probe_weight(facing_weight(vec3(0, 0, 1), vec3(0, 0, 1)), 1.0f),
              2.0f * probe_weight(facing_weight(vec3(0, 0, 1), vec3(0, 0, -1)), 1.0f));
    EXPECT_GT(probe_weight(0.0f, 0.0f), 0.0f);
}

// The texel beyond an edge is the one whose directions go on there.
TEST(OctahedralFold, NeighboursAcrossEdgesLookTheSameWay) {
    constexpr int size = kDistanceSize;
    const auto looks = [&](const ivec2& t) {
        return octahedral_decode((vec2(t) + 0.5f) / float(size) * 2.0f - 1.0f);
    };
    for (int i = 0; i < size; ++i) {
        for (const ivec2 outside : {ivec2(-1, i), ivec2(size, i), ivec2(i, -1), ivec2(i, size)}) {
            const ivec2 inside = clamp(outside, ivec2(0), ivec2(size - 1));
            EXPECT_LT(glm::distance(looks(octahedral_fold(outside, size)), looks(inside)), 0.3f);
        }
    }
}
