#include "shading/lights/units.glsl"

#include <gtest/gtest.h>

#include "shading/lights/punctual.glsl"
#include "shading/photometry.glsl"

namespace candela::shading {
namespace {

TEST(Units, PowerAndEfficacy) {
    EXPECT_FLOAT_EQ(lm_from_watt(1.0f, kMaxLuminousEfficacy), 683.0f);
    EXPECT_FLOAT_EQ(watt_from_lm(1366.0f, kMaxLuminousEfficacy), 2.0f);
    // Frostbite Table 6 in its own words: an efficiency of 100 % is 683 lm/W.
    EXPECT_FLOAT_EQ(efficacy_from_efficiency(1.0f), 683.0f);
}

TEST(Units, PointLightsGiveTheIlluminanceOfFrostbiteTable10) {
    struct {
        float power_lm, distance_m, illuminance_lx;
    } const rows[] = {{625, 1, 50},         {625, 0.5f, 199}, {625, 0.25f, 796}, {625, 0.1f, 4973},
                      {625, 0.055f, 16441}, {1200, 1, 95},    {1200, 0.5f, 382}, {1200, 0.055f, 31568}};
    for (const auto& row : rows)
        EXPECT_NEAR(lx_from_cd(point_cd_from_lm(row.power_lm), row.distance_m), row.illuminance_lx,
                    0.55f + 1e-4f * row.illuminance_lx)
            << row.power_lm << " lm at " << row.distance_m << " m";
}

TEST(Units, IlluminanceStopsGrowingWithinTheOneCentimetreOfThePunctualLight) {
    EXPECT_FLOAT_EQ(lx_from_cd(2.0f, 0.001f), 20000.0f);
    EXPECT_FLOAT_EQ(lx_from_cd(2.0f, 0.0f), 20000.0f);
    EXPECT_FLOAT_EQ(cd_from_lx(lx_from_cd(2.0f, 0.001f), 0.001f), 2.0f);
}

TEST(Units, SpotLightsBothWays) {
    EXPECT_FLOAT_EQ(spot_cd_from_lm(PI), 1.0f);
    // A cone of half angle 180 degrees is a point light; of 60 degrees, where 1 - cos = 1/2, a quarter of it.
    EXPECT_FLOAT_EQ(spot_cd_from_lm_exact(100.0f, PI), point_cd_from_lm(100.0f));
    EXPECT_NEAR(spot_cd_from_lm_exact(100.0f, PI / 3.0f), 4.0f * point_cd_from_lm(100.0f), 1e-4f);
    // At a half angle of 60 degrees 2 pi (1 - cos) is pi: Frostbite's convention is exact there.
    EXPECT_NEAR(spot_cd_from_lm_exact(100.0f, PI / 3.0f), spot_cd_from_lm(100.0f), 1e-4f);
}

TEST(Units, FrustumOfSixRightAnglesIsTheSphere) {
    // Six pyramids of 90 x 90 degrees tile the sphere.
    EXPECT_NEAR(frustum_solid_angle(0.5f * PI, 0.5f * PI), 4.0f * PI / 6.0f, 1e-5f);
    EXPECT_NEAR(frustum_cd_from_lm(100.0f, 0.5f * PI, 0.5f * PI), 6.0f * point_cd_from_lm(100.0f), 1e-3f);
}

TEST(Units, SmoothSpotPowerIsTheIntegralOfItsAngleAttenuation) {
    const float inner = 0.2f, outer = 0.7f;
    const int steps = 20000;
    double flux = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double theta = (i + 0.5) * outer / steps;
        const double a = angle_attenuation(float(std::cos(theta)), std::cos(inner), std::cos(outer));
        flux += 2.0 * M_PI * std::sin(theta) * a * outer / steps;
    }
    EXPECT_NEAR(spot_lm_from_cd_smooth(1.0f, inner, outer), flux, 1e-4 * flux);
    EXPECT_FLOAT_EQ(spot_lm_from_cd_smooth(3.0f, outer, outer), spot_lm_from_cd_exact(3.0f, outer));
}

TEST(Units, AreaLightsOfFrostbiteTable12) {
    // The example below Table 12: a sphere of radius 15 cm and 1500 lm.
    EXPECT_NEAR(sphere_nit_from_lm(1500.0f, 0.15f), 1688.0f, 1.0f);
    EXPECT_NEAR(disk_nit_from_lm(1500.0f, 0.15f), 4.0f * 1688.7f, 1.0f);
    EXPECT_FLOAT_EQ(rectangle_nit_from_lm(PI, 1.0f, 2.0f), 0.5f);
    EXPECT_FLOAT_EQ(tube_nit_from_lm(1500.0f, 0.15f, 0.0f), sphere_nit_from_lm(1500.0f, 0.15f));
    EXPECT_NEAR(tube_nit_from_lm(1000.0f, 0.02f, 1.2f), 1000.0f / (0.155823f * PI), 0.5f);
}

TEST(Units, EveryConversionHasItsInverse) {
    EXPECT_FLOAT_EQ(point_lm_from_cd(point_cd_from_lm(800.0f)), 800.0f);
    EXPECT_FLOAT_EQ(spot_lm_from_cd(spot_cd_from_lm(800.0f)), 800.0f);
    EXPECT_FLOAT_EQ(spot_lm_from_cd_exact(spot_cd_from_lm_exact(800.0f, 0.3f), 0.3f), 800.0f);
    EXPECT_FLOAT_EQ(frustum_lm_from_cd(frustum_cd_from_lm(800.0f, 0.3f, 0.5f), 0.3f, 0.5f), 800.0f);
    EXPECT_FLOAT_EQ(sphere_lm_from_nit(sphere_nit_from_lm(800.0f, 0.1f), 0.1f), 800.0f);
    EXPECT_FLOAT_EQ(disk_lm_from_nit(disk_nit_from_lm(800.0f, 0.1f), 0.1f), 800.0f);
    EXPECT_FLOAT_EQ(tube_lm_from_nit(tube_nit_from_lm(800.0f, 0.1f, 0.6f), 0.1f, 0.6f), 800.0f);
    EXPECT_FLOAT_EQ(rectangle_lm_from_nit(rectangle_nit_from_lm(800.0f, 0.1f, 0.6f), 0.1f, 0.6f), 800.0f);
}

TEST(Units, AreaLightsFarAwayAreTheirProjectedAreaTimesLuminance) {
    // A sphere shines like a point light of the same power at every distance outside of it.
    EXPECT_NEAR(sphere_lx_from_nit(sphere_nit_from_lm(1500.0f, 0.15f), 0.15f, 2.0f),
                lx_from_cd(point_cd_from_lm(1500.0f), 2.0f), 1e-3f);
    // A disk too near to be told from a plane gives pi L.
    EXPECT_NEAR(disk_lx_from_nit(100.0f, 1.0f, 1e-3f), lx_from_uniform_sky(100.0f), 1e-2f);
    EXPECT_NEAR(disk_lx_from_nit(100.0f, 0.1f, 10.0f), 100.0f * disk_area(0.1f) / 100.0f, 1e-4f);
}

TEST(Punctual, WindowIsOneNearAndZeroFromTheRangeOn) {
    EXPECT_FLOAT_EQ(window_attenuation(0.0f, 10.0f), 1.0f);
    EXPECT_FLOAT_EQ(window_attenuation(10.0f, 10.0f), 0.0f);
    EXPECT_FLOAT_EQ(window_attenuation(1000.0f, 10.0f), 0.0f);
    EXPECT_FLOAT_EQ(window_attenuation(5.0f, 10.0f), square(1.0f - 1.0f / 16.0f));
    EXPECT_FLOAT_EQ(window_attenuation(1e6f, std::numeric_limits<float>::infinity()), 1.0f);
    // Zero slope at the range (Frostbite Figure 25, Window1).
    EXPECT_LT(window_attenuation(9.99f, 10.0f) / 0.01f, 2e-3f);
}

TEST(Punctual, DistanceAttenuationIsInverseSquareTimesWindow) {
    const vec3 to_light(1.0f, 2.0f, -2.0f);
    EXPECT_FLOAT_EQ(distance_attenuation(to_light, std::numeric_limits<float>::infinity()), 1.0f / 9.0f);
    EXPECT_FLOAT_EQ(distance_attenuation(to_light, 5.0f), window_attenuation(3.0f, 5.0f) / 9.0f);
    EXPECT_FLOAT_EQ(distance_attenuation(vec3(0.0f), 5.0f), 10000.0f);
}

TEST(Punctual, AngleAttenuationAtTheConesAndAtASharpEdge) {
    const float ci = std::cos(0.3f), co = std::cos(0.5f);
    EXPECT_FLOAT_EQ(angle_attenuation(1.0f, ci, co), 1.0f);
    EXPECT_FLOAT_EQ(angle_attenuation(ci, ci, co), 1.0f);
    EXPECT_FLOAT_EQ(angle_attenuation(co, ci, co), 0.0f);
    EXPECT_FLOAT_EQ(angle_attenuation(-1.0f, ci, co), 0.0f);
    EXPECT_NEAR(angle_attenuation(0.5f * (ci + co), ci, co), 0.25f, 1e-5f);
    EXPECT_FLOAT_EQ(angle_attenuation(std::cos(0.49f), co, co), 1.0f);
    EXPECT_FLOAT_EQ(angle_attenuation(std::cos(0.51f), co, co), 0.0f);
    // The centre of a beam of 1 degree stays at full intensity (Frostbite's guard of 1e-3 would dim it to 2
    // %).
    EXPECT_FLOAT_EQ(angle_attenuation(1.0f, 1.0f, std::cos(0.0174533f)), 1.0f);
}

}  // namespace
}  // namespace candela::shading
