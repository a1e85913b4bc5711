#include "shading/occlusion.glsl"

#include <gtest/gtest.h>

#include "shading/bsdf.glsl"
#include "shading/fully_rough.glsl"
#include "shading/spherical_gaussian_lobe.glsl"

namespace candela::shading {
namespace {

// Lagarde & de Rousiers 2014, section 4.10.2, listing 26 and Figure 65.
TEST(Occlusion, RoughSurfacesHaveTheAmbientOcclusionAndSmoothOnesDependOnTheView) {
    for (float ao = 0.0f; ao <= 1.0f; ao += 0.125f) {
        for (float NoV = 0.0f; NoV <= 1.0f; NoV += 0.125f) {
            EXPECT_NEAR(specular_occlusion(NoV, ao, 1.0f), ao, 2e-5f);
            EXPECT_GE(specular_occlusion(NoV, ao, 0.05f), 0.0f);
            EXPECT_LE(specular_occlusion(NoV, ao, 0.05f), 1.0f);
            if (ao < 1.0f && NoV < 1.0f) {
                EXPECT_GE(specular_occlusion(NoV + 0.125f, ao, 0.05f), specular_occlusion(NoV, ao, 0.05f));
                EXPECT_GE(specular_occlusion(NoV, ao + 0.125f, 0.05f), specular_occlusion(NoV, ao, 0.05f));
            }
        }
        EXPECT_NEAR(specular_occlusion(1.0f - ao, ao, 0.3f), ao, 1e-6f) << "the power of 1";
    }
    EXPECT_NEAR(specular_occlusion(1.0f, 0.5f, 0.0f), std::sqrt(1.5f) - 0.5f, 1e-6f);
    EXPECT_NEAR(specular_occlusion(0.0f, 0.5f, 0.0f), std::sqrt(0.5f) - 0.5f, 1e-6f);
    EXPECT_EQ(specular_occlusion(0.3f, 1.0f, 0.2f), 1.0f);
}

Surface metal(float base) {
    Surface s{};
    s.base_color = vec3(base);
    s.metallic = 1.0f;
    s.perceptual_roughness = 0.3f;
    s.dielectric_f0 = vec3(0.04f);
    s.dielectric_f90 = vec3(1.0f);
    return s;
}

// Lagarde & de Rousiers 2014, listing 27; "used for both dielectric and metal materials" (corrections,
// section 3.2.1).
TEST(MicroOcclusion, LowersTheGrazingReflectanceOfMetals) {
    const auto f90 = [](float base, const BsdfTechniques& t) {
        return prepare_surface(metal(base), t, 0.5f, vec4(1.0f)).specular_f90.x;
    };
    EXPECT_NEAR(f90(0.005f, techniques_frostbite()), 0.2475f, 1e-5f);
    EXPECT_EQ(f90(0.5f, techniques_frostbite()), 1.0f);
    EXPECT_EQ(f90(0.005f, techniques_best()), 1.0f);
}

// Karis 2014, "Environment BRDF".
TEST(FullyRough, HasNoSpecularLobeUnderAnyLight) {
    for (const float metallic : {0.0f, 0.5f, 1.0f}) {
        Surface s = metal(0.6f);
        s.metallic = metallic;
        s.coat = 1.0f;
        s.anisotropy = 0.5f;
        const Surface r = fully_rough_surface(s);
        for (const BsdfTechniques& t : {techniques_best(), techniques_frostbite(), techniques_ue4()}) {
            vec3 diffuse;
            vec3 specular;
            const vec3 n(0.0f, 0.0f, 1.0f);
            evaluate_layered(r, t, n, vec3(1, 0, 0), vec3(0, 1, 0), n, normalize(vec3(-0.5f, 0.2f, 1.0f)),
                             normalize(vec3(0.6f, 0.0f, 0.7f)), vec4(0.5f), diffuse, specular);
            EXPECT_EQ(specular, vec3(0.0f));
        }
        const float f0 = 0.04f * (1.0f - metallic) + 0.6f * metallic;
        EXPECT_NEAR(r.base_color.x, 0.6f * (1.0f - metallic) + 0.45f * f0, 1e-6f);
        EXPECT_EQ(r.perceptual_roughness, 1.0f);
        EXPECT_EQ(r.metallic, 0.0f);
    }
}

TEST(SunLobe, HasTheEnergyOfOneAndEndsAtTheHorizon) {
    for (const float alpha : {0.02f, 0.1f, 0.2f}) {
        double sum = 0.0;
        constexpr int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            // RoL = 1 - x^2 / 2 about the mirror direction.
            const double x = 2.0 * (i + 0.5) / steps;
            sum += double(sun_lobe_gaussian(alpha, float(1.0 - 0.5 * x * x), 1.0f)) * x * 2.0 / steps;
        }
        EXPECT_NEAR(sum * 2.0 * 3.14159265, 1.0, 0.04) << alpha;
    }
    EXPECT_EQ(sun_lobe_gaussian(1.0f, 1.0f, 0.0f), 0.0f);
}

}  // namespace
}  // namespace candela::shading
