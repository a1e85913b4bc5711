#include <gtest/gtest.h>

#include "directions.hpp"
#include "shading/bsdf_sampling.glsl"
#include "shading/dfg.glsl"

namespace candela::shading {
namespace {

Surface coated(float coat_perceptual_roughness) {
    Surface s{};
    s.base_color = vec3(0.5f);
    s.perceptual_roughness = 0.3f;
    s.dielectric_f0 = vec3(0.04f);
    s.dielectric_f90 = vec3(1.0f);
    s.coat = 1.0f;
    s.coat_perceptual_roughness = coat_perceptual_roughness;
    return s;
}

}  // namespace

// A draw that weighs thousands is a firefly in every picture. Smooth lobes seen at grazing angles and from
// behind their normal are where half-vectors lose their digits.
TEST(Grazing, NoDrawWeighsMuchMoreThanOne) {
    Uniform u(5);
    const BsdfTechniques t = techniques_best();
    float heaviest = 0.0f;
    for (int i = 0; i < 100000; ++i) {
        const Surface s = coated(0.2f * u());
        const vec3 interpolated = normalize(sample_uniform_hemisphere(u.two()) + vec3(0.0f, 0.0f, -0.5f));
        vec3 tangent;
        vec3 bitangent;
        orthonormal_basis(interpolated, tangent, bitangent);
        const bool behind = u() < 0.3f;
        const float cosine = behind ? -0.3f * u() : 0.5f * std::pow(10.0f, -4.0f * u());
        const vec3 v = to_world(at_cosine(cosine, TWO_PI * u()), tangent, bitangent, interpolated);

        const vec3 n = normal_facing(interpolated, v);
        ASSERT_GE(dot(n, v), 0.99e-4f);
        orthonormal_basis(n, tangent, bitangent);
        const float NoV = dot(n, v);
        const vec4 dfg = integrate_dfg(NoV, s.perceptual_roughness, 8);
        const vec4 coat_dfg = integrate_dfg(NoV, s.coat_perceptual_roughness, 8);
        const BsdfLobes lobes = bsdf_lobes(s, t, NoV, NoV, dfg, coat_dfg);
        const float choice = u();
        const vec3 l = sample_bsdf(lobes, s, n, tangent, bitangent, n, v, choice, u.two());
        const float NoL = dot(n, l);
        if (NoL <= 0.0f) continue;
        const float pdf = pdf_bsdf(lobes, s, n, tangent, bitangent, n, v, l);
        ASSERT_GT(pdf, 0.0f);
        const vec3 f = evaluate_layered(s, t, n, tangent, bitangent, n, v, l, dfg);
        heaviest = std::max(heaviest, f.x * NoL / pdf);
    }
    EXPECT_LT(heaviest, 3.0f);
}

TEST(Grazing, ANormalThatIsSeenStaysAsItIs) {
    const vec3 n = at_cosine(0.3f, 1.0f);
    EXPECT_EQ(normal_facing(n, vec3(0.0f, 0.0f, 1.0f)), n);
    EXPECT_NEAR(length(normal_facing(n, -n)), 1.0f, 1e-6f);
    EXPECT_GT(dot(normal_facing(n, -n), -n), 0.0f);
}

}  // namespace candela::shading
