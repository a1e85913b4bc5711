#include <gtest/gtest.h>

#include "candela/bake/filter_environment.hpp"
#include "candela/bake/harmonics.hpp"
#include "candela/bake/irradiance_harmonics.hpp"
#include "candela/bake/lobe_field.hpp"
#include "environments.hpp"
#include "shading/cube.glsl"
#include "shading/environment_filter.glsl"
#include "shading/spherical_harmonics.glsl"

namespace candela {
namespace {

/// Irradiance / pi by summing the map.
glm::dvec3 summed(const scene::Environment& e, const glm::vec3& n) {
    glm::dvec3 sum(0.0);
    for (std::uint32_t y = 0; y < e.height; ++y) {
        for (std::uint32_t x = 0; x < e.width; ++x) {
            const glm::vec3 d =
                shading::rotate_about_y(shading::equirect_direction({(float(x) + 0.5f) / float(e.width),
                                                                     (float(y) + 0.5f) / float(e.height)}),
                                        e.rotation_rad);
            sum += glm::dvec3(e.luminance_nit[std::size_t{y} * e.width + x]) *
                   double(shading::equirect_texel_solid_angle(y, e.width, e.height) *
                          std::max(glm::dot(n, d), 0.0f) * shading::INV_PI);
        }
    }
    return sum;
}

const glm::vec3 kNormals[] = {
    {0.0f, 1.0f, 0.0f}, {0.6f, 0.0f, 0.8f}, {-0.48f, -0.6f, 0.64f}, {1.0f, 0.0f, 0.0f}};

TEST(Irradiance, MapIsTheCosineWeightedSum) {
    scene::Environment maps[] = {tests::sky(256), tests::one_texel_sun(256, 0.26f, 0.4f),
                                 tests::dark_studio(256)};
    for (scene::Environment& e : maps) {
        e.rotation_rad = -0.4f;
        bake::FilterOptions options;
        options.size = 16;
        options.irradiance_size = 16;
        options.texel = bake::TexelValue::center;
        const scene::FilteredEnvironment filtered = filter_environment(e, options);
        const scene::CubeMap& cube = filtered.irradiance;
        for (std::uint32_t face = 0; face < 6; ++face) {
            const glm::vec3 n = glm::normalize(
                shading::cube_point(static_cast<int>(face), (glm::vec2(3, 11) + 0.5f) / 16.0f));
            const glm::dvec3 expected = summed(e, n);
            const glm::vec3 value = cube.texels[cube.index(face, 3, 11)] * filtered.nit_per_unit;
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(double(value[c]), expected[c], 2.0e-3 * expected[c] + 0.2);
        }
    }
}

TEST(Irradiance, NineHarmonicsHoldASoftSkyWithinTwoPercent) {
    scene::Environment e = tests::sky(128);
    e.rotation_rad = 1.1f;
    bake::FilterOptions options;
    options.size = 4;
    const scene::FilteredEnvironment filtered = filter_environment(e, options);
    EXPECT_FALSE(filtered.irradiance_sh_window.any());
    for (const glm::vec3& n : kNormals) {
        const glm::vec3 value = bake::evaluate_sh(filtered.irradiance_sh, n);
        const glm::dvec3 expected = summed(e, n);
        EXPECT_NEAR(double(value.y) / expected.y, 1.0, 0.05);
    }
}

TEST(Irradiance, HarmonicsAreTheProjectionOfTheSource) {
    scene::Environment e = tests::dark_studio(256);
    e.rotation_rad = 0.3f;
    const bake::EquirectLight light = bake::equirect_light(e, 1.0f, 256);
    const bake::Sh9 sh = bake::irradiance_sh(light, bake::analyze(light, 8));
    bake::Sh9 expected{};
    for (std::uint32_t y = 0; y < e.height; ++y) {
        for (std::uint32_t x = 0; x < e.width; ++x) {
            const glm::vec3 d =
                shading::rotate_about_y(shading::equirect_direction({(float(x) + 0.5f) / float(e.width),
                                                                     (float(y) + 0.5f) / float(e.height)}),
                                        e.rotation_rad);
            const float sr = shading::equirect_texel_solid_angle(y, e.width, e.height);
            for (int i = 0; i < 9; ++i)
                expected[std::size_t(i)] += e.luminance_nit[std::size_t{y} * e.width + x] *
                                            (sr * shading::sh_basis(i, d) * shading::sh_cosine_over_pi(i));
        }
    }
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(sh[i].x, expected[i].x, 1.0e-3f * expected[0].x) << i;
}

std::vector<glm::vec3> directions(int count) {
    std::vector<glm::vec3> out;
    for (int i = 0; i < count; ++i) {
        const float y = 1.0f - (float(i) + 0.5f) / (0.5f * float(count));
        const float phi = 2.39996f * float(i);
        const float r = std::sqrt(1.0f - y * y);
        out.emplace_back(r * std::cos(phi), y, r * std::sin(phi));
    }
    return out;
}

glm::vec3 least_over_mean(const bake::Sh9& sh) {
    glm::vec3 least(1.0e30f);
    for (const glm::vec3& d : directions(20000)) least = glm::min(least, bake::evaluate_sh(sh, d));
    return least / (sh[0] * shading::sh_basis(0, {}));
}

/// A lamp that is small in blue, wider in green, over light from everywhere that blue has little of.
scene::Environment blue_lamp(float ambient_blue) {
    return tests::environment_of(128, [=](const glm::vec3& d) {
        const float c = glm::dot(d, glm::normalize(glm::vec3(0.5f, 0.7f, -0.5f)));
        return glm::vec3(1.0f) * glm::vec3(1.0f + 0.5f * c, 1.0f + (c > 0.0f ? 1.0f : 0.0f), ambient_blue) +
               glm::vec3(0.0f, 0.0f, c > 0.9f ? 8.0f : 0.0f);
    });
}

/// Relative RMSE of the harmonics against summing the map.
double error_of(const bake::Sh9& sh, const scene::Environment& e, float unit) {
    double off = 0.0, squares = 0.0;
    for (const glm::vec3& n : directions(200)) {
        const glm::dvec3 expected = summed(e, n);
        const glm::dvec3 d = glm::dvec3(bake::evaluate_sh(sh, n) * unit) - expected;
        off += glm::dot(d, d), squares += glm::dot(expected, expected);
    }
    return std::sqrt(off / squares);
}

// A window that all channels share, or of a family that takes from band 2 first, costs far more than it
// cures.
TEST(Irradiance, AChannelThatDipsIsWindowedAloneAndByTheLeast) {
    const scene::Environment e = blue_lamp(0.0217f);
    bake::FilterOptions options;
    options.size = 4;
    const scene::FilteredEnvironment filtered = filter_environment(e, options);
    const scene::HarmonicsWindow& window = filtered.irradiance_sh_window;
    bake::Sh9 plain = filtered.radiance_sh;
    for (std::size_t i = 0; i < 9; ++i) plain[i] *= shading::sh_cosine_over_pi(int(i));
    EXPECT_NEAR(least_over_mean(plain).z, -0.034f, 0.004f) << "what this map is made for";
    EXPECT_NEAR(window.least_over_mean.z, least_over_mean(plain).z, 1.0e-3f);
    EXPECT_EQ(window.bands[0], glm::vec2(1.0f));
    EXPECT_EQ(window.bands[1], glm::vec2(1.0f));
    EXPECT_LT(window.bands[2].x, 1.0f);
    EXPECT_NEAR(least_over_mean(filtered.irradiance_sh).z, 0.0f, 1.0e-4f) << "no more than is needed";
    for (std::size_t i = 0; i < 9; ++i) {
        EXPECT_FLOAT_EQ(filtered.irradiance_sh[i].x, plain[i].x) << i;
        EXPECT_FLOAT_EQ(filtered.irradiance_sh[i].y, plain[i].y) << i;
    }
    const double before = error_of(plain, e, filtered.nit_per_unit);
    const double after = error_of(filtered.irradiance_sh, e, filtered.nit_per_unit);
    EXPECT_NEAR(window.error_without, before, 0.1 * before);
    EXPECT_NEAR(window.error, after, 0.15 * after) << "the harmonics above the third band are in it";
    EXPECT_LT(after, 1.25 * before) << before << " " << after;
}

// The hardest light, one point: 1 + 2 c + 1.25 (1.5 c^2 - 0.5) falls to -0.158, c the cosine to it. No other
// pair of factors makes it non-negative with a smaller mean square of the change.
TEST(Irradiance, TheWindowOfASunChangesLessThanAnyOther) {
    bake::FilterOptions options;
    options.size = 4;
    const scene::FilteredEnvironment filtered =
        filter_environment(tests::one_texel_sun(128, 0.26f, 0.4f), options);
    const glm::vec2 found = filtered.irradiance_sh_window.bands[0];
    EXPECT_NEAR(filtered.irradiance_sh_window.least_over_mean.x, -0.158f, 2.0e-3f);
    EXPECT_GT(least_over_mean(filtered.irradiance_sh).x, -1.0e-4f);
    const auto change = [](double w1, double w2) {
        return (1.0 - w1) * (1.0 - w1) * 4.0 / 3.0 + (1.0 - w2) * (1.0 - w2) * 1.5625 / 5.0;
    };
    const auto least = [](double w1, double w2) {
        double out = 1.0;
        for (double c = -1.0; c <= 1.0; c += 1.0e-3)
            out = std::min(out, 1.0 + 2.0 * w1 * c + 1.25 * w2 * (1.5 * c * c - 0.5));
        return out;
    };
    double best = 1.0;
    for (double w1 = 0.0; w1 <= 1.0; w1 += 2.0e-3) {
        for (double w2 = 0.0; w2 <= 1.0; w2 += 2.0e-3) {
            if (least(w1, w2) >= 0.0) best = std::min(best, change(w1, w2));
        }
    }
    EXPECT_NEAR(change(double(found.x), double(found.y)), best, 0.02 * best) << found.x << " " << found.y;
}

TEST(Irradiance, RandomNarrowLightsAreNonNegativeInEveryChannel) {
    std::uint32_t state = 1;
    const auto random = [&] { return float((state = state * 1664525u + 1013904223u) >> 8) / 16777216.0f; };
    for (int map = 0; map < 50; ++map) {
        bake::Sh9 sh{};
        for (int lamp = 0; lamp < 3; ++lamp) {
            const float y = 2.0f * random() - 1.0f, phi = 6.2831853f * random();
            const float r = std::sqrt(1.0f - y * y);
            const glm::vec3 d(r * std::cos(phi), y, r * std::sin(phi));
            const glm::vec3 power(random(), random() * random(), map % 5 == 0 ? 0.0f : random());
            for (int i = 0; i < 9; ++i)
                sh[std::size_t(i)] += power * shading::sh_basis(i, d) * shading::sh_cosine_over_pi(i);
        }
        const bake::Sh9 plain = sh;
        const scene::HarmonicsWindow window = bake::window_negative(sh);
        const glm::vec3 before = least_over_mean(plain), after = least_over_mean(sh);
        for (int c = 0; c < 3; ++c) {
            if (plain[0][c] == 0.0f) continue;
            EXPECT_GT(after[c], -2.0e-5f) << map << " " << c;
            EXPECT_NEAR(window.least_over_mean[c], before[c], 2.0e-3f);
            EXPECT_EQ(window.bands[std::size_t(c)] == glm::vec2(1.0f), before[c] > -1.0e-5f) << before[c];
        }
    }
}

TEST(Harmonics, OneFunctionIsOneCoefficient) {
    // Y_3^2 about +Y, real part: sin^2 cos of the polar angle times cos(2 phi), phi = 2 pi u.
    bake::EquirectLight light;
    light.width = 128;
    light.height = 64;
    for (std::uint32_t y = 0; y < 64; ++y) {
        for (std::uint32_t x = 0; x < 128; ++x) {
            const double polar = M_PI * (y + 0.5) / 64.0;
            const double phi = 2.0 * M_PI * (x + 0.5) / 128.0;
            const double value = std::pow(std::sin(polar), 2) * std::cos(polar) * std::cos(2.0 * phi);
            light.texels.emplace_back(float(value), 0.0f, 0.0f, 0.0f);
        }
    }
    const bake::Harmonics harmonics = bake::analyze(light, 20);
    // Half of it belongs to order -2; normalized, sin^2 cos is sqrt(480 pi / 945)... of the textbook's 1/4
    // sqrt(105 / (2 pi)).
    const double expected = 0.5 / (0.25 * std::sqrt(105.0 / (2.0 * M_PI)));
    for (std::uint32_t m = 0; m <= 20; ++m) {
        for (std::uint32_t l = m; l <= 20; ++l)
            EXPECT_NEAR(harmonics.at(l, m)[0], l == 3 && m == 2 ? expected : 0.0, 2.0e-3 * expected)
                << l << " " << m;
    }
    bake::SmoothGrid grid = bake::synthesize(harmonics, std::vector<double>(21, 1.0), 128);
    for (std::uint32_t y = 0; y < 64; y += 7) {
        for (std::uint32_t x = 0; x < 128; x += 5)
            EXPECT_NEAR(grid.row(y)[x].x, light.texels[std::size_t{y} * 128 + x].x, 3.0e-3f);
    }
}

TEST(Harmonics, RoughestLobeIsLamberts) {
    const std::vector<double> zonal = bake::ld_zonal_coefficients(1.0f, 8);
    const double expected[] = {1.0, 2.0 / 3.0, 0.25, 0.0, -1.0 / 24.0, 0.0, 1.0 / 64.0};
    for (std::size_t l = 0; l < 7; ++l) EXPECT_NEAR(zonal[l], expected[l], 1.0e-5) << l;
}

TEST(Harmonics, WeightOfTheLobeHasItsClosedForm) {
    for (const float alpha : {0.002f, 0.05f, 0.4f, 0.98f, 0.995f, 1.0f}) {
        double sum = 0.0;
        constexpr int n = 200000;
        for (int i = 0; i < n; ++i) {
            // Equal steps of the angle's hyperbolic sine.
            const double stretch = std::asinh(0.5 * M_PI / double(alpha));
            const double at = (i + 0.5) / n;
            const double theta = double(alpha) * std::sinh(stretch * at);
            const double step = double(alpha) * stretch * std::cosh(stretch * at) / n;
            sum += 2.0 * M_PI * std::sin(theta) * step *
                   double(shading::ld_weight(static_cast<float>(std::pow(std::sin(0.5 * theta), 2)), alpha));
        }
        EXPECT_NEAR(double(shading::ld_weight_integral(alpha)) / sum, 1.0, 1.0e-4) << alpha;
    }
}

}  // namespace
}  // namespace candela
