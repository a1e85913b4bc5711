// shading/sky: the parts of a clear sky, each against what it must be by itself.
#include <gtest/gtest.h>

#include <cmath>

#include "shading/sky/scattering.glsl"

namespace {

using namespace candela::shading;

/// Columns of air, aerosol and ozone in double precision, by many small steps of a straight ray.
glm::dvec3 columns_of(double altitude_m, double mu) {
    const double r = double(kEarthRadius_m) + altitude_m;
    const double top = double(kEarthRadius_m) + double(kAirTop_m);
    const double length = -r * mu + std::sqrt(top * top - r * r * (1.0 - mu * mu));
    constexpr int steps = 200000;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < steps; ++i) {
        const double t = length * (i + 0.5) / steps;
        sum += glm::dvec3(
            sky_density(float(std::sqrt(r * r + t * (2.0 * r * mu + t)) - double(kEarthRadius_m))));
    }
    return sum * (length / steps);
}

double rising_integral(double (*f)(double)) {
    constexpr int steps = 20000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) sum += f(-1.0 + 2.0 * (i + 0.5) / steps);
    return sum * 2.0 / steps;
}

TEST(SkyFormulas, ColumnsAreTheIntegralsOfTheDensities) {
    for (const auto& [altitude, mu] :
         {std::pair{0.0, 1.0}, std::pair{0.0, 0.5}, std::pair{0.0, 0.0}, std::pair{2.0, 0.05},
          std::pair{3000.0, -0.01}, std::pair{20000.0, -0.05}, std::pair{60000.0, 0.3}}) {
        const glm::dvec3 truth = columns_of(altitude, mu);
        const vec3 got = sky_columns_m(float(altitude), float(mu));
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(double(got[i]), truth[i], 0.004 * truth[i] + 0.05)
                << altitude << " m, mu " << mu << ", " << i;
    }
    EXPECT_NEAR(columns_of(0.0, 1.0).x, double(kAirColumn_m), 1.0);
}

TEST(SkyFormulas, TheAirMassOfASettingSunIsThatOfASphericalEarth) {
    // Without refraction; Kasten & Young's 38 has it.
    const float zenith = sky_columns_m(0.0f, 1.0f).x;
    EXPECT_NEAR(sky_columns_m(0.0f, 0.0f).x / zenith, 35.0f, 1.5f);
    EXPECT_NEAR(sky_columns_m(0.0f, 0.5f).x / zenith, 2.0f, 0.01f);
}

TEST(SkyFormulas, PhaseFunctionsScatterAllOfTheLight) {
    const double air =
        rising_integral([](double c) { return 2.0 * M_PI * double(rayleigh_phase(float(c))); });
    const double aerosol =
        rising_integral([](double c) { return 2.0 * M_PI * double(aerosol_phase(float(c))); });
    const double forward =
        rising_integral([](double c) { return 2.0 * M_PI * c * double(aerosol_phase(float(c))); });
    const double twice =
        rising_integral([](double c) { return 2.0 * M_PI * c * double(forward_phase(float(c), 1)); });
    EXPECT_NEAR(air, 1.0, 1e-4);
    EXPECT_NEAR(aerosol, 1.0, 1e-4);
    EXPECT_NEAR(forward, double(kAerosolAsymmetry), 1e-3);
    EXPECT_NEAR(twice, double(square(kAerosolAsymmetry)), 1e-3);
}

TEST(SkyFormulas, SharesOfForwardScatteringAddUp) {
    const vec4 thin = forward_shares(0.0f);
    EXPECT_NEAR(thin.x, 1.0f, 1e-6f);
    EXPECT_NEAR(thin.y + thin.z + thin.w, 0.0f, 1e-6f);
    for (const float y : {0.01f, 0.3f, 1.0f, 4.0f, 20.0f}) {
        const vec4 s = forward_shares(y);
        const float all = 1.0f - kForwardShare + kForwardShare * (1.0f - std::exp(-y)) / y;
        EXPECT_NEAR(s.x + s.y + s.z + s.w, all, 1e-5f) << y;
        for (int i = 0; i < 4; ++i) EXPECT_GE(s[i], 0.0f) << y;
    }
}

TEST(SkyFormulas, TheFastExponentialIsOne) {
    for (float x = 0.0f; x > -80.0f; x -= 0.0371f)
        EXPECT_NEAR(exp_of_negative(x) / std::exp(x), 1.0f, 1e-5f) << x;
    EXPECT_EQ(exp_of_negative(0.0f), 1.0f);
    EXPECT_LT(exp_of_negative(-1e6f), 1e-35f);
}

TEST(SkyFormulas, OpticalDepthsArePublishedOnes) {
    // Bucholtz 1995, Table 3 (sea level, 1013.25 hPa): 0.0973 at 550 nm, 0.3615 at 400 nm.
    EXPECT_NEAR(rayleigh_optical_depth(0.55f), 0.0973f, 0.001f);
    EXPECT_NEAR(rayleigh_optical_depth(0.40f), 0.3615f, 0.004f);
    // Turbidity is the ratio of all to the air alone (Preetham et al.), at 550 nm within their fit.
    EXPECT_NEAR(1.0f + aerosol_optical_depth(0.55f, 3.0f) / rayleigh_optical_depth(0.55f), 3.0f, 0.15f);
    EXPECT_EQ(aerosol_optical_depth(0.55f, 1.0f), 0.0f);
}

TEST(SkyFormulas, TheSunsDiscSetsByItsSegment) {
    EXPECT_NEAR(sun_visible_share(0.0f, 0.0f), 0.5f, 1e-5f);
    EXPECT_EQ(sun_visible_share(0.0f, 0.01f), 1.0f);
    EXPECT_EQ(sun_visible_share(0.0f, -0.01f), 0.0f);
    // Half a radius above the centre: 0.8045 of a circle (segment of half height).
    EXPECT_NEAR(sun_visible_share(0.0f, 0.5f * kSunAngularRadius_rad), 0.8045f, 1e-3f);
}

TEST(SkyFormulas, SunlightHasTheSolarConstant) {
    SkyAtmosphere air;
    sky_atmosphere(2.0f, 300.0f, 0.2f, air);
    float lx = 0.0f;
    for (const vec3& band : air.rec709_lx) lx += luminance(band);
    EXPECT_GT(lx, 127500.0f);
    EXPECT_LT(lx, 134500.0f);
}

}  // namespace
