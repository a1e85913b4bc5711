#include <gtest/gtest.h>

#include <glm/ext/quaternion_float.hpp>
#include <glm/gtc/quaternion.hpp>

#include "candela/measure/area_configurations.hpp"
#include "shading/lights/tube.glsl"

/// What must not change an illuminance, and what must add up.
namespace candela::shading {
namespace {

using measure::RandomNumbers;

glm::quat random_rotation(RandomNumbers& u) {
    return glm::angleAxis(float(u(-3.0, 3.0)), vec3(u.direction()));
}

/// n, light and all turned together, 200 times.
template <class F>
void expect_invariant_under_rotation(F f) {
    RandomNumbers u;
    for (int i = 0; i < 200; ++i) {
        const vec3 n(u.direction());
        const vec3 center(u.direction() * u(0.6, 3.0));
        const vec3 a(u.direction());
        const vec3 b(u.perpendicular(glm::dvec3(a)));
        const glm::quat turn = random_rotation(u);
        const float before = f(n, center, a, b);
        EXPECT_NEAR(f(turn * n, turn * center, turn * a, turn * b), before, 1e-5f + 1e-5f * before) << i;
    }
}

TEST(Invariance, TurningReceiverAndLightTogetherChangesNothing) {
    expect_invariant_under_rotation(
        [](vec3 n, vec3 c, vec3, vec3) { return sphere_projected_solid_angle(n, c, 0.5f); });
    expect_invariant_under_rotation(
        [](vec3 n, vec3 c, vec3 a, vec3) { return disk_projected_solid_angle(n, c, a, 0.5f); });
    expect_invariant_under_rotation([](vec3 n, vec3 c, vec3 a, vec3 b) {
        return rectangle_projected_solid_angle(n, c, a, b, 0.5f, 0.8f);
    });
    expect_invariant_under_rotation(
        [](vec3 n, vec3 c, vec3 a, vec3) { return tube_projected_solid_angle(n, c, a, 0.3f, 0.2f); });
    expect_invariant_under_rotation([](vec3 n, vec3 c, vec3 a, vec3) {
        return glm::length(glm::cross(c, a)) > 0.1f ? line_illuminance(n, c, a, 0.7f) : 0.0f;
    });
}

TEST(Invariance, ScalingEverythingChangesNothing) {
    RandomNumbers u;
    for (int i = 0; i < 200; ++i) {
        const vec3 n(u.direction());
        const vec3 c(u.direction() * u(0.6, 3.0));
        const vec3 a(u.direction());
        const vec3 b(u.perpendicular(glm::dvec3(a)));
        for (const float s : {1.0e-4f, 1.0e3f}) {
            EXPECT_NEAR(sphere_projected_solid_angle(n, s * c, s * 0.5f),
                        sphere_projected_solid_angle(n, c, 0.5f), 1e-5f);
            EXPECT_NEAR(disk_projected_solid_angle(n, s * c, a, s * 0.5f),
                        disk_projected_solid_angle(n, c, a, 0.5f), 2e-5f);
            EXPECT_NEAR(rectangle_projected_solid_angle(n, s * c, a, b, s * 0.5f, s * 0.8f),
                        rectangle_projected_solid_angle(n, c, a, b, 0.5f, 0.8f), 2e-5f);
            EXPECT_NEAR(tube_projected_solid_angle(n, s * c, a, s * 0.3f, s * 0.2f),
                        tube_projected_solid_angle(n, c, a, 0.3f, 0.2f), 2e-5f);
        }
    }
}

TEST(Invariance, TheEndsOfAnAxisAreTheSame) {
    RandomNumbers u;
    for (int i = 0; i < 200; ++i) {
        const vec3 n(u.direction());
        const vec3 c(u.direction() * u(0.6, 3.0));
        const vec3 a(u.direction());
        const vec3 b(u.perpendicular(glm::dvec3(a)));
        EXPECT_NEAR(tube_projected_solid_angle(n, c, a, 0.3f, 0.2f),
                    tube_projected_solid_angle(n, c, -a, 0.3f, 0.2f), 1e-5f);
        // A rectangle turned by 90 and 180 degrees in its plane.
        const float r = rectangle_projected_solid_angle(n, c, a, b, 0.5f, 0.8f);
        EXPECT_NEAR(rectangle_projected_solid_angle(n, c, b, -a, 0.8f, 0.5f), r, 1e-5f);
        EXPECT_NEAR(rectangle_projected_solid_angle(n, c, -a, -b, 0.5f, 0.8f), r, 1e-5f);
    }
}

TEST(Invariance, APartitionedRectangleAddsUp) {
    RandomNumbers u;
    for (int i = 0; i < 300; ++i) {
        const vec3 n(u.direction());
        const vec3 c(u.direction() * u(0.2, 3.0));
        const vec3 right(u.direction());
        const vec3 up(u.perpendicular(glm::dvec3(right)));
        const float w = float(u(0.1, 2.0));
        const float h = float(u(0.1, 2.0));
        const float cut = float(u(-0.9, 0.9)) * w;
        const float left_w = 0.5f * (cut + w);
        const float right_w = 0.5f * (w - cut);
        const float parts =
            rectangle_projected_solid_angle(n, c + right * (left_w - w), right, up, left_w, h) +
            rectangle_projected_solid_angle(n, c + right * (w - right_w), right, up, right_w, h);
        EXPECT_NEAR(rectangle_projected_solid_angle(n, c, right, up, w, h), parts, 2e-5f) << i;
    }
}

TEST(Invariance, ALineOfTwoHalvesIsTheirMean) {
    RandomNumbers u;
    for (int i = 0; i < 200; ++i) {
        const vec3 n(u.direction());
        const vec3 c(u.direction() * u(0.6, 3.0));
        const vec3 a(u.direction());
        if (glm::length(glm::cross(a, c)) < 0.05f) continue;
        const float halves =
            0.5f * (line_illuminance(n, c - 0.4f * a, a, 0.4f) + line_illuminance(n, c + 0.4f * a, a, 0.4f));
        EXPECT_NEAR(line_illuminance(n, c, a, 0.8f), halves, 2e-5f * halves + 1e-6f);
    }
}

TEST(Invariance, OppositeNormalsShareTheLightAndAllNormalsAddToItsSolidAngle) {
    // E(n) - E(-n) is linear in n, whatever the horizon cuts: the flux through a plane.
    RandomNumbers u;
    const auto net = [](const vec3& n, const vec3& c, const vec3& a) {
        return tube_projected_solid_angle(n, c, a, 0.5f, 0.2f) -
               tube_projected_solid_angle(-n, c, a, 0.5f, 0.2f);
    };
    for (int i = 0; i < 100; ++i) {
        const vec3 c(u.direction() * u(0.8, 2.0));
        const vec3 a(u.direction());
        const vec3 n(u.direction());
        const vec3 m(u.direction());
        const vec3 sum = n + m;
        EXPECT_NEAR(net(n, c, a) + net(m, c, a), glm::length(sum) * net(glm::normalize(sum), c, a), 3e-5f);
    }
}

TEST(Invariance, BeyondFiveTimesItsSizeALightIsAPoint) {
    RandomNumbers u;
    for (int i = 0; i < 200; ++i) {
        const vec3 n = glm::normalize(vec3(u.direction()) + vec3(0.0f, 0.0f, 1.3f));
        const vec3 c(0.0f, 0.0f, 10.5f);
        const vec3 away = glm::normalize(vec3(u.direction()) + vec3(0.0f, 0.0f, 1.3f));
        const vec3 right(u.perpendicular(glm::dvec3(away)));
        const vec3 up = glm::cross(away, right);
        if (n.z < 0.25f || away.z < 0.25f) continue;
        const auto expect_close = [](float rule, float exact) { EXPECT_NEAR(rule, exact, 0.03f * exact); };
        expect_close(sphere_projected_solid_angle_five_times(n, c, 1.0f),
                     sphere_projected_solid_angle(n, c, 1.0f));
        expect_close(disk_projected_solid_angle_five_times(n, c, -away, 1.0f),
                     disk_projected_solid_angle(n, c, -away, 1.0f));
        expect_close(rectangle_projected_solid_angle_five_times(n, c, right, up, 1.0f, 0.6f),
                     rectangle_projected_solid_angle(n, c, right, up, 1.0f, 0.6f));
        expect_close(tube_projected_solid_angle_five_times(n, c, right, 0.8f, 0.2f),
                     tube_projected_solid_angle(n, c, right, 0.8f, 0.2f));
        // Nearer than that it is the exact form.
        EXPECT_EQ(sphere_projected_solid_angle_five_times(n, 0.9f * c, 1.0f),
                  sphere_projected_solid_angle(n, 0.9f * c, 1.0f));
        EXPECT_EQ(disk_projected_solid_angle_five_times(n, 0.9f * c, -away, 1.0f),
                  disk_projected_solid_angle(n, 0.9f * c, -away, 1.0f));
    }
}

}  // namespace
}  // namespace candela::shading
