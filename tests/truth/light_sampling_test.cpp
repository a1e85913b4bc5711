#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "shading/lights/disk_sampling.glsl"
#include "shading/lights/rectangle_sampling.glsl"
#include "shading/lights/tube_sampling.glsl"
#include "shading/sequence.glsl"

using namespace candela;
using glm::vec2;
using glm::vec3;

namespace {

constexpr double kPi = 3.14159265358979;

/// One shape about one receiver: its draws, their density, its rays, and a ball that holds it.
struct Shape {
    std::function<shading::LightDirection(vec2)> sample;
    std::function<float(vec3)> pdf;
    std::function<float(vec3)> enter;
    vec3 to_center_m{0.0f};
    float bound_m = 0.0f;
};

struct Moments {
    double solid_angle = 0.0;
    glm::dvec3 vector{0.0};
};

/// By rays spread evenly over the ball's cone, or over the whole sphere from within it.
Moments by_rays(const Shape& s, unsigned count) {
    const double ratio = static_cast<double>(s.bound_m) / glm::length(glm::dvec3(s.to_center_m));
    const double cone = ratio < 1.0 ? 1.0 - std::sqrt(1.0 - ratio * ratio) : 2.0;
    Moments m;
    for (unsigned i = 0; i < count; ++i) {
        const vec3 d = shading::sample_cone(shading::hammersley(i, count), glm::normalize(s.to_center_m),
                                            static_cast<float>(cone));
        if (s.enter(d) <= 0.0f) continue;
        m.solid_angle += 2.0 * kPi * cone / count;
        m.vector += glm::dvec3(d) * (2.0 * kPi * cone / count);
    }
    return m;
}

struct Spread {
    double least = 1e30;
    double most = 0.0;
};

/// The draws' integrals; checks that each meets the shape where it says and has the density that it says.
Moments by_draws(const Shape& s, unsigned count, Spread& weight) {
    Moments m;
    unsigned lost = 0;
    for (unsigned i = 0; i < count; ++i) {
        const shading::LightDirection d = s.sample(shading::hammersley(i, count));
        if (!(d.pdf > 0.0f)) {
            ++lost;
            continue;
        }
        EXPECT_NEAR(glm::length(d.direction), 1.0f, 1e-5f);
        m.solid_angle += 1.0 / static_cast<double>(d.pdf) / count;
        m.vector += glm::dvec3(d.direction) / static_cast<double>(d.pdf) / static_cast<double>(count);
        weight.least = std::min(weight.least, 1.0 / static_cast<double>(d.pdf));
        weight.most = std::max(weight.most, 1.0 / static_cast<double>(d.pdf));
        const float t = s.enter(d.direction);
        if (!(t > 0.0f)) {
            ++lost;  // on the rim
            continue;
        }
        EXPECT_NEAR(d.distance_m / t, 1.0f, 2e-3f);
        EXPECT_NEAR(s.pdf(d.direction) / d.pdf, 1.0f, 0.01f);
    }
    EXPECT_LE(lost, count / 500);
    return m;
}

vec3 random_direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return glm::normalize(vec3(normal(random), normal(random), normal(random)));
}

float between(std::mt19937& random, float low, float high) {
    return low * std::pow(high / low, std::uniform_real_distribution<float>()(random));
}

void expect_draws_fill_the_shape(const std::function<Shape(std::mt19937&)>& make, double tolerance,
                                 double uneven) {
    std::mt19937 random(5);
    int seen = 0;
    for (int trial = 0; trial < 300 && seen < 60; ++trial) {
        const Shape s = make(random);
        const Moments rays = by_rays(s, 1u << 16);
        if (rays.solid_angle < 1e-3) continue;
        ++seen;
        Spread weight;
        const Moments draws = by_draws(s, 1u << 11, weight);
        // The rays' own error is about the rim's share of their cone.
        const double bound = tolerance * rays.solid_angle + 1e-4;
        EXPECT_NEAR(draws.solid_angle, rays.solid_angle, bound) << trial;
        EXPECT_LT(glm::length(draws.vector - rays.vector), bound) << trial;
        EXPECT_LT(weight.most, uneven * draws.solid_angle) << trial;
        if (testing::Test::HasFailure()) {
            ADD_FAILURE() << "solid angle " << rays.solid_angle << ", centre " << s.to_center_m.x << ' '
                          << s.to_center_m.y << ' ' << s.to_center_m.z << ", bound " << s.bound_m;
            return;
        }
    }
    EXPECT_GE(seen, 40);
}

}  // namespace

TEST(LightSampling, Spheres) {
    expect_draws_fill_the_shape(
        [](std::mt19937& random) {
            const float r = between(random, 0.05f, 3.0f);
            const vec3 c = random_direction(random) * r * between(random, 1.01f, 20.0f);
            return Shape{[=](vec2 u) { return shading::sample_sphere(u, c, r); },
                         [=](vec3) { return shading::pdf_sphere(c, r); },
                         [=](vec3 d) { return shading::enter_sphere(d, c, r); }, c, r};
        },
        0.005, 1.01);
}

TEST(LightSampling, Disks) {
    expect_draws_fill_the_shape(
        [](std::mt19937& random) {
            const float r = between(random, 0.05f, 3.0f);
            const vec3 c = random_direction(random) * r * between(random, 0.02f, 10.0f);
            const vec3 n = random_direction(random);
            return Shape{[=](vec2 u) { return shading::sample_disk(u, c, n, r); },
                         [=](vec3 d) { return shading::pdf_disk(d, c, n, r); },
                         [=](vec3 d) { return shading::enter_disk(d, c, n, r); }, c, r};
        },
        0.01, 1.3);
}

TEST(LightSampling, Rectangles) {
    expect_draws_fill_the_shape(
        [](std::mt19937& random) {
            const float w = between(random, 0.05f, 3.0f);
            const float h = between(random, 0.05f, 3.0f);
            const vec3 c = random_direction(random) * std::max(w, h) * between(random, 0.02f, 10.0f);
            vec3 right;
            vec3 up;
            shading::orthonormal_basis(random_direction(random), right, up);
            return Shape{[=](vec2 u) { return shading::sample_rectangle(u, c, right, up, w, h); },
                         [=](vec3 d) { return shading::pdf_rectangle(d, c, right, up, w, h); },
                         [=](vec3 d) { return shading::enter_rectangle(d, c, right, up, w, h); }, c,
                         std::hypot(w, h)};
        },
        0.01, 1.01);
}

TEST(LightSampling, Tubes) {
    expect_draws_fill_the_shape(
        [](std::mt19937& random) {
            const float r = between(random, 0.05f, 0.5f);
            const float half = between(random, 0.01f, 3.0f);
            const vec3 c = random_direction(random) * (half + r) * between(random, 0.05f, 10.0f);
            const vec3 a = random_direction(random);
            return Shape{[=](vec2 u) { return shading::sample_tube(u, c, a, half, r); },
                         [=](vec3 d) { return shading::pdf_tube(d, c, a, half, r); },
                         [=](vec3 d) { return shading::enter_tube(d, c, a, half, r); }, c, half + r};
        },
        0.015, 4.0);
}

TEST(LightSampling, TinyAndFarShapesKeepTheirDigits) {
    const vec3 c(3.0f, 40.0f, -20.0f);
    const double distance2 = glm::dot(glm::dvec3(c), glm::dvec3(c));
    const vec3 n = glm::normalize(vec3(0.2f, -1.0f, 0.3f));
    const double facing = -glm::dot(glm::dvec3(n), glm::dvec3(c)) / std::sqrt(distance2);
    vec3 right;
    vec3 up;
    shading::orthonormal_basis(n, right, up);
    if (glm::dot(glm::cross(up, right), n) < 0.0f) up = -up;
    const double r = 1e-3;
    EXPECT_NEAR(shading::sample_sphere({0.3f, 0.7f}, c, 1e-3f).pdf * kPi * r * r / distance2, 1.0, 1e-3);
    EXPECT_NEAR(shading::sample_disk({0.3f, 0.7f}, c, n, 1e-3f).pdf * kPi * r * r * facing / distance2, 1.0,
                1e-3);
    EXPECT_NEAR(shading::sample_rectangle({0.3f, 0.7f}, c, right, up, 1e-3f, 1e-3f).pdf * 4 * r * r * facing /
                    distance2,
                1.0, 1e-3);
}

TEST(LightSampling, FromWithinAndFromBehindThereIsNothing) {
    EXPECT_EQ(shading::sample_sphere({0.5f, 0.5f}, {0.1f, 0, 0}, 0.5f).pdf, 0.0f);
    EXPECT_LT(shading::enter_sphere({1, 0, 0}, {0.1f, 0, 0}, 0.5f), 0.0f);
    EXPECT_EQ(shading::sample_tube({0.5f, 0.5f}, {1.0f, 0.1f, 0}, {1, 0, 0}, 2.0f, 0.5f).pdf, 0.0f);
    EXPECT_LT(shading::enter_tube({1, 0, 0}, {1.0f, 0.1f, 0}, {1, 0, 0}, 2.0f, 0.5f), 0.0f);
    EXPECT_EQ(shading::sample_disk({0.5f, 0.5f}, {0, 1, 0}, {0, 1, 0}, 0.5f).pdf, 0.0f);
    EXPECT_LT(shading::enter_disk({0, 1, 0}, {0, 1, 0}, {0, 1, 0}, 0.5f), 0.0f);
    EXPECT_GT(shading::enter_disk({0, 1, 0}, {0, 1, 0}, {0, -1, 0}, 0.5f), 0.0f);
    // Shines down -Z: from above (+Z) it is dark.
    EXPECT_EQ(shading::sample_rectangle({0.5f, 0.5f}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, 1, 1).pdf, 0.0f);
    EXPECT_GT(shading::sample_rectangle({0.5f, 0.5f}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 1, 1).pdf, 0.0f);
}

TEST(LightSampling, RaysAlongATubesAxisMeetItsEnd) {
    EXPECT_NEAR(shading::enter_tube({0, 0, 1}, {0, 0, 5}, {0, 0, 1}, 2.0f, 0.5f), 2.5f, 1e-5f);
    EXPECT_NEAR(shading::enter_tube({0, 0, 1}, {0, 0, 5}, {0, 0, -1}, 2.0f, 0.5f), 2.5f, 1e-5f);
    EXPECT_LT(shading::enter_tube({0, 0, -1}, {0, 0, 5}, {0, 0, 1}, 2.0f, 0.5f), 0.0f);
}

TEST(LightSampling, TheSunsDiscGivesItsIlluminanceWithAndWithoutALimb) {
    const vec3 to_sun = glm::normalize(vec3(0.3f, 1.0f, -0.2f));
    for (const float radius : {0.00465f, 0.3f}) {
        for (const bool limb : {false, true}) {
            double lx = 0.0;
            constexpr unsigned count = 1u << 14;
            for (unsigned i = 0; i < count; ++i) {
                const vec3 d = shading::sample_sun(shading::hammersley(i, count), to_sun, radius);
                lx += static_cast<double>(shading::sun_nit_from_lx(d, to_sun, radius, limb) *
                                          glm::dot(d, to_sun) / shading::pdf_sun(radius)) /
                      count;
            }
            EXPECT_NEAR(lx, 1.0, 1e-3) << radius << limb;
        }
    }
    EXPECT_TRUE(shading::meets_sun(to_sun, to_sun, 0.00465f));
    vec3 t;
    vec3 b;
    shading::orthonormal_basis(to_sun, t, b);
    EXPECT_TRUE(shading::meets_sun(glm::normalize(to_sun + 0.0046f * t), to_sun, 0.00465f));
    EXPECT_FALSE(shading::meets_sun(glm::normalize(to_sun + 0.0047f * t), to_sun, 0.00465f));
}

TEST(LightSampling, ALinesDrawsGiveItsIntegral) {
    struct Case {
        vec3 center;
        float half;
    };
    for (const auto& [c, half] : {Case{{0, 1, 0}, 2.0f}, Case{{3, 1, 0}, 2.0f}, Case{{5, 0.02f, 0}, 2.0f},
                                  Case{{0, 30, 0}, 0.5f}, Case{{0.5f, 0.05f, 0.1f}, 2.0f}}) {
        double drawn = 0.0;
        constexpr unsigned count = 1u << 12;
        for (unsigned i = 0; i < count; ++i) {
            const shading::LinePoint p =
                shading::sample_line((static_cast<float>(i) + 0.5f) / count, c, {1, 0, 0}, half);
            EXPECT_LE(std::abs(p.to_point_m.x - c.x), half * 1.0001f);
            drawn += static_cast<double>(p.per_m2) / count;
        }
        // The integral of D / d^3 over the length, D = distance of the axis.
        const double across = std::hypot(static_cast<double>(c.y), static_cast<double>(c.z));
        const auto sine = [&](double x) { return x / std::hypot(x, across); };
        const double x = static_cast<double>(c.x);
        const double h = static_cast<double>(half);
        const double expected = (sine(x + h) - sine(x - h)) / (across * 2.0 * h);
        EXPECT_NEAR(drawn / expected, 1.0, 1e-3) << c.x << ' ' << c.y;
    }
}
