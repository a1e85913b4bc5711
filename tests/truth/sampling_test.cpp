#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "candela/bake/environment_distribution.hpp"
#include "candela/truth/light_tree.hpp"
#include "shading/bsdf_sampling.glsl"
#include "shading/dfg.glsl"
#include "shading/lights/triangle.glsl"
#include "trace.hpp"

using namespace candela;
using namespace candela::test;
using glm::vec2;
using glm::vec3;

namespace {

constexpr double kPi = 3.14159265358979;

vec3 random_direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return glm::normalize(vec3(normal(random), normal(random), normal(random)));
}

/// Integral of the cosine to `n` over a spherical triangle that is all above the horizon: Lambert's sum over
/// its edges.
double cosine_integral(const vec3 (&d)[3], const vec3& n) {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 a = glm::normalize(glm::dvec3(d[i]));
        const glm::dvec3 b = glm::normalize(glm::dvec3(d[(i + 1) % 3]));
        sum += std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) *
               glm::dot(glm::normalize(glm::cross(a, b)), glm::dvec3(n));
    }
    return std::abs(0.5 * sum);
}

}  // namespace

TEST(Triangle, SolidAnglesThatAreKnown) {
    EXPECT_NEAR(shading::triangle_solid_angle({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), kPi / 2, 1e-5);
    const float small = 1e-3f;
    EXPECT_NEAR(
        shading::triangle_solid_angle(glm::normalize(vec3(0, 0, 1)), glm::normalize(vec3(small, 0, 1)),
                                      glm::normalize(vec3(0, small, 1))) /
            (0.5f * small * small),
        1.0, 1e-3);
}

TEST(Triangle, DirectionsAreUniformWithinIt) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 20; ++trial) {
        vec3 d[3];
        do {
            for (vec3& x : d) {
                x = random_direction(random);
                x.z = std::abs(x.z) + 0.05f;
                x = glm::normalize(x);
            }
        } while (shading::triangle_solid_angle(d[0], d[1], d[2]) < 0.05f);
        const double solid_angle = shading::triangle_solid_angle(d[0], d[1], d[2]);
        const vec3 n(0, 0, 1);
        double sum = 0.0;
        constexpr unsigned count = 1u << 14;
        for (unsigned i = 0; i < count; ++i) {
            const vec3 l =
                shading::sample_spherical_triangle(d[0], d[1], d[2], shading::hammersley(i, count));
            ASSERT_NEAR(glm::length(l), 1.0f, 1e-4f);
            const float side = glm::dot(glm::cross(d[0], d[1]), d[2]) > 0.0f ? 1.0f : -1.0f;
            for (int e = 0; e < 3; ++e) {
                ASSERT_GT(side * glm::dot(glm::cross(d[e], d[(e + 1) % 3]), l), -1e-3f)
                    << "outside of the triangle";
            }
            sum += static_cast<double>(l.z);
        }
        EXPECT_NEAR(sum / count * solid_angle / cosine_integral(d, n), 1.0, 2e-3) << trial;
    }
}

TEST(Triangle, ThinOnesAreUniformWhicheverCornerComesFirst) {
    // A strip of 6 m x 4 mm, 1 m above: half an LED profile.
    const vec3 corner[3] = {glm::normalize(vec3(-3, 0, 1)), glm::normalize(vec3(3, 0, 1)),
                            glm::normalize(vec3(-3, 0.004f, 1))};
    const double solid_angle = shading::triangle_solid_angle(corner[0], corner[1], corner[2]);
    const double expected = cosine_integral(corner, {0, 0, 1});
    for (int first = 0; first < 3; ++first) {
        double sum = 0.0;
        constexpr unsigned count = 1u << 14;
        for (unsigned i = 0; i < count; ++i) {
            sum += static_cast<double>(
                shading::sample_spherical_triangle(corner[first], corner[(first + 1) % 3],
                                                   corner[(first + 2) % 3], shading::hammersley(i, count))
                    .z);
        }
        EXPECT_NEAR(sum / count * solid_angle / expected, 1.0, 5e-3) << first;
    }
}

TEST(LightTree, ProbabilitiesAddUpToOneAndAreThoseOfTheDraws) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit;
    std::vector<truth::LightBounds> lights;
    for (int i = 0; i < 37; ++i) {
        truth::LightBounds b;
        const vec3 at(10.0f * unit(random), 5.0f * unit(random), 10.0f * unit(random));
        b.box.extend(at);
        b.box.extend(at + 0.5f * vec3(unit(random), unit(random), unit(random)));
        b.axis = random_direction(random);
        b.power = 0.1f + unit(random);
        if (i % 3 == 0) b.cos_normals = -1.0f;
        b.two_sided = i % 5 == 0;
        lights.push_back(b);
    }
    const truth::LightTree tree(lights);
    for (int trial = 0; trial < 50; ++trial) {
        const vec3 point(10.0f * unit(random), 5.0f * unit(random), 10.0f * unit(random));
        const vec3 normal = random_direction(random);
        double sum = 0.0;
        std::vector<double> expected(lights.size());
        for (std::uint32_t i = 0; i < lights.size(); ++i)
            sum += expected[i] = tree.probability(point, normal, i);
        // A branch that promises light and holds none that reaches the point draws nothing: less than one is
        // allowed.
        EXPECT_LE(sum, 1.0 + 1e-5);
        std::vector<double> seen(lights.size());
        constexpr int draws = 20000;
        for (int i = 0; i < draws; ++i) {
            float u = (static_cast<float>(i) + 0.5f) / draws;
            const truth::LightTree::Choice choice = tree.sample(point, normal, u);
            ASSERT_GE(u, 0.0f);
            ASSERT_LT(u, 1.0f);
            if (choice.probability <= 0.0f) continue;
            seen[choice.light] += 1.0 / draws;
            ASSERT_NEAR(choice.probability, expected[choice.light], 1e-4 * expected[choice.light] + 1e-7);
        }
        for (std::size_t i = 0; i < lights.size(); ++i) EXPECT_NEAR(seen[i], expected[i], 2e-3) << i;
    }
}

TEST(LightTree, NoLightThatReachesThePointIsNeverDrawn) {
    // Two triangles back to back: each point sees one of them, and must be able to draw it.
    truth::LightBounds up;
    up.box.extend(vec3(-1, 0, -1));
    up.box.extend(vec3(1, 0, 1));
    up.axis = {0, 1, 0};
    up.power = 1.0f;
    truth::LightBounds down = up;
    down.axis = {0, -1, 0};
    const truth::LightTree tree({up, down});
    EXPECT_GT(tree.probability({0, 3, 0}, {0, -1, 0}, 0), 0.99f);
    EXPECT_EQ(tree.probability({0, 3, 0}, {0, -1, 0}, 1), 0.0f);
    EXPECT_GT(tree.probability({0, -3, 0}, {0, 1, 0}, 1), 0.99f);
    EXPECT_EQ(tree.probability({0, 3, 0}, {0, 1, 0}, 0), 0.0f) << "behind the receiver";
}

namespace {

void expect_the_density_of_draws(const scene::Environment& e) {
    const truth::EnvironmentLight light(e);
    double integral = 0.0;
    constexpr int rows = 512;
    for (int y = 0; y < rows; ++y) {
        const double theta = (y + 0.5) * kPi / rows;
        for (int x = 0; x < 2 * rows; ++x) {
            const double phi = (x + 0.5) * kPi / rows;
            const vec3 d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
            integral += static_cast<double>(light.pdf(d)) * std::sin(theta) * (kPi / rows) * (kPi / rows);
        }
    }
    EXPECT_NEAR(integral, 1.0, 5e-3);
    for (unsigned i = 0; i < 2000; ++i) {
        const truth::DirectionSample s = light.sample(shading::centred_hammersley(i, 2000));
        ASSERT_GT(s.pdf, 0.0f);
        ASSERT_NEAR(light.pdf(s.direction) / s.pdf, 1.0f, 1e-3f) << i;
    }
}

}  // namespace

TEST(EnvironmentLight, ItsDensityIntegratesToOneAndIsThatOfItsDraws) {
    scene::Environment e = constant(1.0f);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit;
    for (vec3& t : e.luminance_nit) t = vec3(unit(random));
    e.luminance_nit[100] = vec3(1e9f);
    e.rotation_rad = 1.0f;
    expect_the_density_of_draws(e);
}

// More texels than cells, and not a whole number of texels to a cell.
TEST(EnvironmentLight, OfALargePictureToo) {
    scene::Environment e;
    e.width = 4501;
    e.height = 2251;
    e.luminance_nit.assign(std::size_t{4501} * 2251, vec3(1.0f));
    for (std::size_t y = 300; y < 700; ++y) {
        for (std::size_t x = 1200; x < 2100; ++x) e.luminance_nit[y * 4501 + x] = vec3(1e4f);
    }
    e.scale = 1.0f;
    expect_the_density_of_draws(e);
}

TEST(EnvironmentLight, EveryTexelHasItsPartOfTheCellsThatItLiesIn) {
    scene::Environment e;
    e.width = 7;
    e.height = 5;
    std::mt19937 random(6);
    std::uniform_real_distribution<float> unit;
    for (int i = 0; i < 35; ++i) e.luminance_nit.emplace_back(unit(random));
    const auto shares = [](const bake::EnvironmentDistribution& d, std::size_t columns, std::size_t rows) {
        double share = 0.0;  // of the upper left corner
        for (std::size_t y = 0; y < rows; ++y) {
            const float* row = d.column_cdf.data() + y * static_cast<std::size_t>(d.width + 1);
            share += static_cast<double>(d.row_cdf[y + 1] - d.row_cdf[y]) * static_cast<double>(row[columns]);
        }
        return share;
    };
    const bake::EnvironmentDistribution texels = bake::environment_distribution(e);
    const bake::EnvironmentDistribution cells = bake::environment_distribution(e, {.max_cells = 6});
    ASSERT_EQ(cells.width, 3);
    ASSERT_EQ(cells.height, 2);
    // The first column of cells holds 2 1/3 of 7 columns, the first row 2 1/2 of 5 rows.
    const auto to_column = [&](std::size_t rows) {
        return shares(texels, 2, rows) + (shares(texels, 3, rows) - shares(texels, 2, rows)) / 3.0;
    };
    EXPECT_NEAR(shares(cells, 1, 1), 0.5 * (to_column(2) + to_column(3)), 1e-5);
    EXPECT_NEAR(shares(cells, 1, 2), to_column(5), 1e-5);
}

// E[f cos / pdf] over draws from every lobe is the directional albedo: the density is that of the draws, and
// covers all of the BSDF.
TEST(BsdfSampling, TheMeanWeightIsTheDirectionalAlbedo) {
    const truth::AlbedoTable table(false);
    const vec3 n(0, 0, 1);
    for (int kind = 0; kind < 5; ++kind) {
        for (const float NoV : {0.1f, 0.5f, 0.95f}) {
            shading::Surface s{};
            s.base_color = vec3(0.8f);
            s.metallic = kind == 1 ? 1.0f : 0.0f;
            s.perceptual_roughness = 0.5f;
            s.dielectric_f0 = vec3(0.04f);
            s.dielectric_f90 = vec3(1.0f);
            s.anisotropy = kind == 1 ? 0.6f : 0.0f;
            s.coat = kind == 2 || kind == 4 ? 1.0f : 0.0f;
            s.coat_perceptual_roughness = kind == 4 ? 0.7f : 0.3f;
            s.sheen_color = vec3(kind == 3 ? 0.9f : 0.0f);
            s.sheen_perceptual_roughness = 0.4f;
            const vec3 v(std::sqrt(1.0f - NoV * NoV), 0.0f, NoV);
            // A normal map tilts the base under its coat, or the coat over its base.
            const vec3 coat_n = kind == 4 ? glm::normalize(vec3(0.25f, 0.1f, 1.0f)) : n;
            const glm::vec4 dfg = table.read(NoV, s.perceptual_roughness);
            const glm::vec4 coat_dfg = table.read(NoV, s.coat_perceptual_roughness);
            const shading::BsdfLobes lobes =
                shading::bsdf_lobes(s, best(), NoV, glm::dot(coat_n, v), dfg, coat_dfg);
            EXPECT_NEAR(lobes.diffuse + lobes.specular + lobes.sheen + lobes.coat, 1.0f, 1e-5f);
            const vec3 t(1, 0, 0);
            const vec3 b(0, 1, 0);
            const auto f = [&](const vec3& l) {
                return l.z > 0.0f ? shading::evaluate_layered(s, best(), n, t, b, coat_n, v, l, dfg).y * l.z
                                  : 0.0f;
            };
            double drawn = 0.0;
            double uniform = 0.0;
            double density = 0.0;
            constexpr unsigned count = 1u << 17;
            for (unsigned i = 0; i < count; ++i) {
                const vec2 u = shading::hammersley(i, count);
                const vec2 w = shading::sobol_owen_pair(i, 3, 17);
                const vec3 l = shading::sample_bsdf(lobes, s, n, t, b, coat_n, v, w.x, u);
                const float pdf = shading::pdf_bsdf(lobes, s, n, t, b, coat_n, v, l);
                if (pdf > 0.0f) drawn += static_cast<double>(f(l) / pdf);
                const vec3 h = shading::sample_uniform_hemisphere(u);
                uniform += static_cast<double>(f(h)) * 2.0 * kPi;
                density +=
                    static_cast<double>(shading::pdf_bsdf(lobes, s, n, t, b, coat_n, v, h)) * 2.0 * kPi;
            }
            EXPECT_NEAR(drawn / uniform, 1.0, 0.01) << "kind " << kind << ", NoV " << NoV;
            EXPECT_LT(density / count, 1.01) << "kind " << kind << ", NoV " << NoV;
            EXPECT_GT(density / count, 0.8) << "kind " << kind << ", NoV " << NoV;
        }
    }
}
