#include "candela/scene/light_units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "candela/scene/error.hpp"

using namespace candela;
using namespace candela::scene;

namespace {

constexpr LightUnit kUnits[] = {LightUnit::candela, LightUnit::lumen, LightUnit::lux,
                                LightUnit::nit,     LightUnit::ev100, LightUnit::watt};

Light shape(LightType type) {
    Light l;
    l.type = type;
    l.radius_m = 0.2f;
    l.half_width_m = 0.3f;
    l.half_height_m = 0.1f;
    l.inner_cone_rad = 0.3f;
    return l;
}

std::optional<float> in(const LightQuantities& q, LightUnit unit) {
    switch (unit) {
        case LightUnit::candela:
            return q.intensity_cd;
        case LightUnit::lumen:
            return q.power_lm;
        case LightUnit::lux:
            return q.illuminance_lx;
        case LightUnit::nit:
            return q.luminance_nit;
        case LightUnit::ev100:
            return q.ev100;
        case LightUnit::watt:
            return q.power_w;
    }
    return {};
}

/// A Lambertian rectangle's illuminance at 1 m, summed over its area.
double summed_lx(const Light& l, double nit) {
    constexpr int n = 200;
    const double w = 2.0 * static_cast<double>(l.half_width_m),
                 h = 2.0 * static_cast<double>(l.half_height_m);
    double lx = 0.0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const double x = ((i + 0.5) / n - 0.5) * w, y = ((j + 0.5) / n - 0.5) * h;
            const double d2 = x * x + y * y + 1.0;
            lx += nit * w * h / (n * n) / (d2 * d2);
        }
    }
    return lx;
}

}  // namespace

TEST(LightUnits, EveryUnitOfATypeComesBackAsItWasStated) {
    for (int t = 0; t <= static_cast<int>(LightType::tube); ++t) {
        for (const bool variant : {false, true}) {
            Light light = shape(static_cast<LightType>(t));
            light.spot_power = variant ? SpotPower::exact : SpotPower::frostbite;
            light.two_sided = variant;
            for (const LightUnit unit : kUnits) {
                SCOPED_TRACE(std::string(name_of(light.type)) + " in " + name_of(unit));
                const LightStrength stated{7.5f, unit, 90.0f};
                if (!accepts(light.type, unit)) {
                    EXPECT_THROW((void)intensity_from(light, stated, "here"), Error);
                    continue;
                }
                light.intensity = intensity_from(light, stated, "here");
                light.efficacy_lm_per_w = unit == LightUnit::watt ? 90.0f : 0.0f;
                const std::optional<float> back = in(quantities(light), unit);
                ASSERT_TRUE(back.has_value());
                EXPECT_NEAR(*back, 7.5f, 1e-4f);
            }
        }
    }
}

TEST(LightUnits, FrostbiteTable8) {
    EXPECT_EQ(accepted_units(LightType::point), "lm, cd or W");
    EXPECT_EQ(accepted_units(LightType::sphere), "lm, nit, EV100 or W");
    EXPECT_EQ(accepted_units(LightType::directional), "lx");
    EXPECT_EQ(accepted_units(LightType::sun), "lx, nit or EV100");
}

TEST(LightUnits, TwoSidesEmitTwice) {
    for (const LightType type : {LightType::disk, LightType::rectangle}) {
        Light light = shape(type);
        const float one = *power_lm(light);
        light.two_sided = true;
        EXPECT_FLOAT_EQ(*power_lm(light), 2.0f * one);
    }
}

TEST(LightUnits, IlluminanceAtOneMetre) {
    Light rectangle = shape(LightType::rectangle);
    rectangle.intensity = 1000.0f;
    const double expected = summed_lx(rectangle, 1000.0);
    EXPECT_NEAR(*quantities(rectangle).illuminance_at_1m_lx, expected, 1e-4 * expected);
    // From afar, a shape is its projected area: 10 mm seen at 1 m.
    for (const LightType type : {LightType::sphere, LightType::disk}) {
        Light light = shape(type);
        light.radius_m = 0.01f;
        const LightQuantities q = quantities(light);
        EXPECT_NEAR(*q.illuminance_at_1m_lx, *q.intensity_cd, 2e-4f * *q.intensity_cd);
    }
    Light inside = shape(LightType::sphere);
    inside.radius_m = 1.5f;
    EXPECT_FALSE(quantities(inside).illuminance_at_1m_lx.has_value());
}

TEST(LightUnits, ALineAtOneMetreIsTheSumOfItsElements) {
    Light line = shape(LightType::line);
    line.intensity = 100.0f;
    constexpr int n = 2000;
    const double length = 2.0 * static_cast<double>(line.half_width_m);
    double lx = 0.0;
    for (int i = 0; i < n; ++i) {
        const double x = ((i + 0.5) / n - 0.5) * length, r2 = x * x + 1.0;
        lx += 100.0 / n / (r2 * r2);  // sin of emission, cos of incidence: 1 / r each
    }
    EXPECT_NEAR(*quantities(line).illuminance_at_1m_lx, lx, 1e-4 * lx);
}

TEST(LightUnits, ALineIsAThinTube) {
    Light tube = shape(LightType::tube), line = shape(LightType::line);
    tube.radius_m = 1e-4f;
    tube.intensity = intensity_from(tube, {1000.0f, LightUnit::lumen}, "here");
    line.intensity = intensity_from(line, {1000.0f, LightUnit::lumen}, "here");
    EXPECT_NEAR(*quantities(tube).intensity_cd, line.intensity, 1e-3f * line.intensity);
    const float line_lx = *quantities(line).illuminance_at_1m_lx;
    EXPECT_NEAR(*quantities(tube).illuminance_at_1m_lx, line_lx, 2e-3f * line_lx);
}

TEST(LightUnits, ColourCountsWithItsLuminance) {
    Light light = shape(LightType::point);
    light.color = {1.0f, 0.0f, 0.0f};
    EXPECT_FLOAT_EQ(*quantities(light).intensity_cd, 0.2126f);
}

namespace {

/// cd = 100 (1 + cos gamma) / 2 in all half-planes: 4 pi 50 lm.
PhotometricProfile cosine_profile() {
    PhotometricProfile p;
    p.horizontal_deg = {0.0, 360.0};
    for (int i = 0; i <= 180; ++i) p.vertical_deg.push_back(i);
    for (int plane = 0; plane < 2; ++plane) {
        for (const double gamma : p.vertical_deg)
            p.candela.push_back(static_cast<float>(50.0 + 50.0 * std::cos(gamma * M_PI / 180.0)));
    }
    p.lamp_sets.emplace_back();
    return p;
}

}  // namespace

TEST(LightUnits, ProfilesAsAMaskAndByPower) {
    const PhotometricProfile web = cosine_profile();
    Light light = shape(LightType::point);
    // Frostbite's mask: the peak gets what a bare light of that power has.
    light.intensity = profile_factor_from(light, web, ProfileScale::mask, {800.0f, LightUnit::lumen}, "here");
    EXPECT_NEAR(*quantities(light, &web).peak_cd, 800.0 / (4.0 * M_PI), 1e-3);
    light.intensity =
        profile_factor_from(light, web, ProfileScale::mask, {60.0f, LightUnit::candela}, "here");
    EXPECT_NEAR(*quantities(light, &web).intensity_cd, 60.0, 1e-4);
    // By power, the web as a whole gives it.
    light.intensity =
        profile_factor_from(light, web, ProfileScale::power, {800.0f, LightUnit::lumen}, "here");
    EXPECT_NEAR(*quantities(light, &web).power_lm, 800.0, 1e-2);
    EXPECT_NEAR(*quantities(light, &web).intensity_cd, 800.0 * 100.0 / (4.0 * M_PI * 50.0), 0.01);
    // A spot's cones let only a part of it through: 2 pi times the integral of 50 (1 + cos) over [0, 60
    // degrees], with a sharp edge.
    light.type = LightType::spot;
    light.intensity = 1.0f;
    light.inner_cone_rad = light.outer_cone_rad = static_cast<float>(M_PI / 3.0);
    EXPECT_NEAR(*quantities(light, &web).emitted_lm, 2.0 * M_PI * 50.0 * (0.5 + 0.375), 0.1);
}
