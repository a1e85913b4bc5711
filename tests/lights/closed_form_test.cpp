#include <gtest/gtest.h>

#include "candela/measure/area_configurations.hpp"
#include "shading/lights/tube.glsl"
#include "shading/lights/units.glsl"

/// Illuminance per luminance where a textbook has a closed form for it, in double precision here.
namespace candela::shading {
namespace {

const vec3 kUp(0.0f, 0.0f, 1.0f);
const vec3 kDown(0.0f, 0.0f, -1.0f);
const vec3 kX(1.0f, 0.0f, 0.0f);
const vec3 kY(0.0f, 1.0f, 0.0f);

/// The radiative view factor of a rectangle a x b in a parallel plane at distance c with one corner straight
/// above the receiver, times pi (Howell's catalogue, B-3).
double parallel_rectangle(double a, double b, double c) {
    const double x = a / c;
    const double y = b / c;
    const double u = std::sqrt(1.0 + x * x);
    const double v = std::sqrt(1.0 + y * y);
    return 0.5 * (x / u * std::atan(y / u) + y / v * std::atan(x / v));
}

/// The same for a wall at distance c: a rectangle b wide and a high from the receiver's plane up, one corner
/// at the foot of the perpendicular (Howell's catalogue, B-4).
double perpendicular_rectangle(double a, double b, double c) {
    const double v = std::hypot(a, c);
    return 0.5 * (std::atan(b / c) - c / v * std::atan(b / v));
}

TEST(ClosedForm, AFacingSphereIsPiTimesItsSquaredSine) {
    for (const float distance : {1.0f, 1.001f, 1.5f, 4.0f, 100.0f, 1.0e4f})
        EXPECT_NEAR(sphere_projected_solid_angle(kUp, vec3(0.0f, 0.0f, distance), 1.0f) * square(distance),
                    PI, 2e-6f * PI)
            << distance;
}

TEST(ClosedForm, AFacingDiskIsPiTimesTheSquaredSineOfItsRim) {
    for (const float distance : {1.0e-3f, 0.1f, 1.0f, 1.5f, 30.0f, 1.0e4f}) {
        const float expected = PI / (1.0f + square(distance));
        EXPECT_NEAR(disk_projected_solid_angle(kUp, distance * kUp, kDown, 1.0f), expected, 3e-6f * expected);
        EXPECT_NEAR(disk_projected_solid_angle_no_horizon(kUp, distance * kUp, kDown, 1.0f), expected,
                    3e-6f * expected);
    }
}

TEST(ClosedForm, ADiskBesideTheReceiverIsTheViewFactorOfParallelPlanes) {
    // A disk of radius r parallel to the receiver's plane at height h, its axis a away (Howell's catalogue,
    // B-13): F = (1 - (Z - 2 R^2) / sqrt(Z^2 - 4 R^2)) / 2, H = h/a, R = r/a, Z = 1 + H^2 + R^2.
    for (const float a : {0.2f, 1.0f, 3.0f}) {
        for (const float h : {0.1f, 0.7f, 5.0f}) {
            const double H = double(h / a);
            const double R = 1.0 / double(a);
            const double Z = 1.0 + H * H + R * R;
            const double expected = 0.5 * M_PI * (1.0 - (Z - 2.0 * R * R) / std::sqrt(Z * Z - 4.0 * R * R));
            EXPECT_NEAR(disk_projected_solid_angle(kUp, vec3(a, 0.0f, h), kDown, 1.0f), expected,
                        1e-5 * expected + 1e-7)
                << a << ' ' << h;
        }
    }
}

TEST(ClosedForm, RectanglesOverAndBesideTheReceiver) {
    for (const float c : {0.2f, 1.0f, 7.0f}) {
        // right x up points away from the receiver: up for a lamp overhead.
        const float over = rectangle_projected_solid_angle(kUp, vec3(0.6f, 0.4f, c), kX, kY, 0.6f, 0.4f);
        EXPECT_NEAR(over, parallel_rectangle(1.2, 0.8, c), 1e-5 * over);
        // The wall x = c, from y = 0 to 1.2 and from z = 0 to 0.8.
        const float beside = rectangle_projected_solid_angle(kUp, vec3(c, 0.6f, 0.4f), kY, kUp, 0.6f, 0.4f);
        EXPECT_NEAR(beside, perpendicular_rectangle(0.8, 1.2, c), 1e-5 * beside + 1e-7);
        // Twice as deep, the lower half of it in the ground: the same.
        const float sunk = rectangle_projected_solid_angle(kUp, vec3(c, 0.6f, 0.0f), kY, kUp, 0.6f, 0.8f);
        EXPECT_NEAR(sunk, beside, 1e-5f * beside);
    }
}

TEST(ClosedForm, AnEndlessPlaneIsPiAndAnEndlessWallHalfOfIt) {
    EXPECT_NEAR(rectangle_projected_solid_angle(kUp, kUp, kX, kY, 1.0e4f, 1.0e4f), PI, 1e-3f);
    EXPECT_NEAR(disk_projected_solid_angle(kUp, kUp, kDown, 1.0e4f), PI, 1e-3f);
    EXPECT_NEAR(rectangle_projected_solid_angle(kUp, kX, kY, kUp, 1.0e4f, 1.0e4f), 0.5f * PI, 1e-3f);
    EXPECT_NEAR(disk_projected_solid_angle(kUp, kX, -kX, 1.0e4f), 0.5f * PI, 1e-3f);
}

TEST(ClosedForm, ALevelLineOverhead) {
    // Integral over the length of cos^4 / h^2 at height h: (t + sin t cos t) / (2 h) to both sides, tan t = L
    // / h, per cd over the length 2 L.
    for (const float half_length : {0.01f, 0.5f, 40.0f}) {
        const double t = std::atan(double(half_length) / 2.0);
        const double expected = (t + std::sin(t) * std::cos(t)) / 2.0 / (2.0 * double(half_length));
        EXPECT_NEAR(line_illuminance(kUp, vec3(0.0f, 0.0f, 2.0f), kX, half_length), expected,
                    1e-5 * expected);
    }
}

TEST(ClosedForm, AnEndlessTubeIsItsAngularHalfWidth) {
    // An endless cylinder seen from outside, the normal towards it: F = r / d, and half of it with the
    // horizon along its axis.
    EXPECT_NEAR(tube_projected_solid_angle(kUp, vec3(0.0f, 0.0f, 2.0f), kX, 1.0e4f, 0.5f), 0.25f * PI, 1e-4f);
}

TEST(ClosedForm, AHalfSunkSphere) {
    // Its centre on the horizon: with the half angle s the projected solid angle is s - sin s cos s.
    for (const float s : {0.01f, 0.3f, 1.2f, 1.57f}) {
        const float expected = s < 0.1f ? 2.0f / 3.0f * s * s * s : s - std::sin(s) * std::cos(s);
        EXPECT_NEAR(sphere_projected_solid_angle(kUp, kX, std::sin(s)), expected, 3e-4f * expected) << s;
    }
}

TEST(ClosedForm, WhatJustRisesOfASphereKeepsItsDigits) {
    // w: how much of its width on the horizon shows; the light is in the fifth power of it.
    for (const double sigma : {0.05, 0.3, 1.0}) {
        for (const double w : {0.03, 0.1, 0.3, 0.6}) {
            const double cosine = -std::sin(sigma) * std::sqrt(1.0 - w * w);
            const glm::dvec3 center(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
            const double truth =
                illuminance_truth(glm::dvec3(kUp), measure::SphereLight{center, std::sin(sigma)});
            EXPECT_NEAR(sphere_projected_solid_angle(kUp, vec3(center), float(std::sin(sigma))), truth,
                        4e-3 * truth)
                << sigma << ' ' << w;
        }
    }
}

/// The largest error of a technique over random lights above and across the horizon.
template <class Light, class F>
double largest_error(F f) {
    measure::RandomNumbers u;
    double largest = 0.0;
    for (int i = 0; i < 400; ++i) {
        Light l;
        draw(u, l);
        const glm::dvec3 n = u.direction();
        largest = std::max(largest, std::abs(double(f(vec3(n), l)) - illuminance_truth(n, l)));
    }
    return largest;
}

TEST(ClosedForm, EveryDefaultIsTheIntegral) {
    EXPECT_LT(largest_error<measure::SphereLight>([](const vec3& n, const measure::SphereLight& l) {
                  return sphere_projected_solid_angle(n, vec3(l.center), float(l.radius));
              }),
              1e-5);
    EXPECT_LT(largest_error<measure::DiskLight>([](const vec3& n, const measure::DiskLight& l) {
                  return disk_projected_solid_angle(n, vec3(l.center), vec3(l.direction), float(l.radius));
              }),
              1e-5);
    EXPECT_LT(largest_error<measure::RectangleLight>([](const vec3& n, const measure::RectangleLight& l) {
                  return rectangle_projected_solid_angle(n, vec3(l.center), vec3(l.right), vec3(l.up),
                                                         float(l.half_width), float(l.half_height));
              }),
              1e-5);
    EXPECT_LT(largest_error<measure::TubeLight>([](const vec3& n, const measure::TubeLight& l) {
                  return tube_projected_solid_angle(n, vec3(l.center), vec3(l.axis), float(l.half_length),
                                                    float(l.radius));
              }),
              1e-5);
}

TEST(ClosedForm, TheLineIsItsIntegral) {
    measure::RandomNumbers u;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 n = u.direction();
        const glm::dvec3 axis = u.direction();
        const glm::dvec3 center = u.direction() * u(0.5, 3.0);
        const double half_length = u(0.05, 2.0);
        if (glm::length(glm::cross(axis, center)) < 0.05) continue;
        const double truth = measure::line_illuminance_truth(n, center, axis, half_length);
        EXPECT_NEAR(line_illuminance(vec3(n), vec3(center), vec3(axis), float(half_length)), truth,
                    2e-5 * truth + 1e-6);
    }
}

TEST(ClosedForm, TheLineEmitsPiSquaredTimesItsIntensity) {
    // Over a sphere of 100 m about a line of 1 cm: the normal towards it.
    const double flux = measure::integrate(
        [](double t) {
            const vec3 l(float(std::sin(t)), 0.0f, float(std::cos(t)));
            return 2.0 * M_PI * std::sin(t) * 1.0e4 * double(line_illuminance(l, 100.0f * l, kUp, 0.005f));
        },
        0.0, M_PI, 16);
    EXPECT_NEAR(flux, double(line_lm_from_cd(1.0f)), 1e-3);
    EXPECT_FLOAT_EQ(line_cd_from_lm(line_lm_from_cd(70.0f)), 70.0f);
}

TEST(ClosedForm, TheSunOfFrostbiteSection46) {
    // Half a degree and a bit; footnote 28's solid angles; footnote 29: 1.6e9 cd/m^2 give 105 000 to 114 000
    // lx.
    const float small = 0.526f * PI / 180.0f;
    const float large = 0.545f * PI / 180.0f;
    EXPECT_NEAR(sun_solid_angle(small), 6.6e-5f, 1e-6f);
    EXPECT_NEAR(sun_solid_angle(large), 7.1e-5f, 1e-6f);
    EXPECT_NEAR(sun_lx_from_nit(1.6e9f, small), 105000.0f, 1500.0f);
    EXPECT_NEAR(sun_lx_from_nit(1.6e9f, large), 114000.0f, 1500.0f);
    EXPECT_FLOAT_EQ(sun_nit_from_lx(sun_lx_from_nit(3.0e8f, small), small), 3.0e8f);
    // As a sphere: the same disc.
    EXPECT_NEAR(
        sphere_projected_solid_angle(kUp, kUp, std::sin(0.5f * large)) / sun_projected_solid_angle(large),
        1.0f, 1e-6f);
}

}  // namespace
}  // namespace candela::shading
