#include <gtest/gtest.h>

#include "candela/measure/area_configurations.hpp"
#include "shading/lights/isotropic_line.glsl"
#include "shading/lights/punctual.glsl"
#include "shading/lights/rectangle_sampling.glsl"
#include "shading/lights/tube.glsl"

/// Where area lights are known to go wrong: at the horizon, on the surface, behind themselves, and at sizes
/// of nothing.
namespace candela::shading {
namespace {

using measure::RandomNumbers;

const vec3 kUp(0.0f, 0.0f, 1.0f);
const vec3 kX(1.0f, 0.0f, 0.0f);
const vec3 kY(0.0f, 1.0f, 0.0f);

TEST(Limits, BelowTheHorizonIsExactlyZero) {
    RandomNumbers u;
    for (int i = 0; i < 500; ++i) {
        const vec3 axis(u.direction());
        const vec3 up(u.perpendicular(glm::dvec3(axis)));
        const vec3 direction = glm::cross(up, axis);
        const vec3 c(float(u(-3.0, 3.0)), float(u(-3.0, 3.0)), -1.001f);
        EXPECT_EQ(sphere_projected_solid_angle(kUp, c, 1.0f), 0.0f);
        EXPECT_EQ(disk_projected_solid_angle(kUp, c, direction, 1.0f), 0.0f);
        EXPECT_EQ(rectangle_projected_solid_angle(kUp, c, axis, up, 0.7f, 0.7f), 0.0f);
        EXPECT_EQ(tube_projected_solid_angle(kUp, c, axis, 0.6f, 0.4f), 0.0f);
        EXPECT_EQ(line_illuminance(kUp, c, axis, 1.0f), 0.0f);
    }
}

TEST(Limits, BehindAOneSidedLightIsExactlyZero) {
    RandomNumbers u;
    for (int i = 0; i < 500; ++i) {
        const vec3 n(u.direction());
        const vec3 right(u.direction());
        const vec3 up(u.perpendicular(glm::dvec3(right)));
        const vec3 shines = -glm::cross(right, up);
        vec3 c(u.direction() * u(0.1, 3.0));
        if (dot(c, shines) < 0.0f) c = -c;  // the light shines away from the receiver
        EXPECT_EQ(rectangle_projected_solid_angle(n, c, right, up, 1.0f, 0.5f), 0.0f);
        EXPECT_EQ(rectangle_projected_solid_angle_structured(n, c, right, up, 1.0f, 0.5f), 0.0f);
        EXPECT_EQ(rectangle_projected_solid_angle_arvo(n, c, right, up, 1.0f, 0.5f), 0.0f);
        EXPECT_EQ(rectangle_projected_solid_angle_simplified(n, c, right, up, 1.0f, 0.5f), 0.0f);
        EXPECT_EQ(disk_projected_solid_angle(n, c, shines, 1.0f), 0.0f);
        EXPECT_EQ(disk_projected_solid_angle_frostbite(n, c, shines, 1.0f), 0.0f);
    }
}

TEST(Limits, ATubeOfNoLengthIsASphere) {
    RandomNumbers u;
    for (int i = 0; i < 300; ++i) {
        const vec3 n(u.direction());
        const vec3 c(u.direction() * u(0.55, 3.0));
        const vec3 axis(u.direction());
        const float sphere = sphere_projected_solid_angle(n, c, 0.5f);
        EXPECT_NEAR(tube_projected_solid_angle(n, c, axis, 0.0f, 0.5f), sphere, 1e-5f);
        EXPECT_NEAR(tube_projected_solid_angle(n, c, axis, 1.0e-4f, 0.5f), sphere, 2e-3f);
        EXPECT_NEAR(tube_projected_solid_angle(n, 3000.0f * c, axis, 0.0f, 0.5f), 0.0f, 1e-6f);
    }
}

// In single precision, where products of directions have no digits of a small light left.
TEST(Limits, SmallRectanglesAreTheirAreaAtTheirDistanceByEveryTechnique) {
    RandomNumbers u;
    for (int i = 0; i < 300; ++i) {
        const vec3 n(u.direction());
        const vec3 right(u.direction());
        const vec3 up(u.perpendicular(glm::dvec3(right)));
        vec3 c(u.direction() * u(0.5, 3.0));
        const vec3 away = glm::cross(right, up);
        if (dot(c, away) < 0.0f) c = -c;
        const float distance2 = dot(c, c);
        const float cosine_at_light = dot(c, away) / std::sqrt(distance2);
        const float cosine = dot(n, c) / std::sqrt(distance2);
        if (cosine < 0.05f || cosine_at_light < 0.05f) continue;
        for (const float size : {1.0e-4f, 1.0e-5f, 1.0e-6f}) {
            const float w = 0.7f * size;
            const float h = 0.2f * size;
            const float solid_angle = 4.0f * w * h * cosine_at_light / distance2;
            const float projected = cosine * solid_angle;
            EXPECT_NEAR(rectangle_solid_angle(c, right, up, w, h), solid_angle, 0.005f * solid_angle) << size;
            EXPECT_NEAR(rectangle_solid_angle_above_horizon(n, c, right, up, w, h), solid_angle,
                        0.005f * solid_angle)
                << size;
            EXPECT_NEAR(see_rectangle(c, right, up, w, h).solid_angle, solid_angle, 0.005f * solid_angle)
                << size;
            for (const auto technique :
                 {rectangle_projected_solid_angle, rectangle_projected_solid_angle_structured,
                  rectangle_projected_solid_angle_drobot, rectangle_projected_solid_angle_drobot_horizon,
                  rectangle_projected_solid_angle_simplified,
                  rectangle_projected_solid_angle_simplified_horizon,
                  rectangle_projected_solid_angle_position, rectangle_projected_solid_angle_five_times})
                EXPECT_NEAR(technique(n, c, right, up, w, h), projected, 0.005f * projected) << size;
        }
    }
}

TEST(Limits, AThinTubeIsALineOfTheSameIntensity) {
    RandomNumbers u;
    for (int i = 0; i < 300; ++i) {
        const vec3 n(u.direction());
        const vec3 c(u.direction() * u(0.5, 3.0));
        const vec3 axis(u.direction());
        if (glm::length(glm::cross(axis, c)) < 0.1f) continue;
        const float half_length = 0.8f;
        // Both sides of the radius from which the tube is treated as a line.
        for (const float radius : {2.0e-3f, 5.0e-4f, 2.0e-5f}) {
            const float intensity_cd = 2.0f * radius * 2.0f * half_length;
            const float line = intensity_cd * line_illuminance(n, c, axis, half_length);
            EXPECT_NEAR(tube_projected_solid_angle(n, c, axis, half_length, radius), line,
                        0.01f * line + 8.0f * radius * radius)
                << radius;
        }
    }
}

TEST(Limits, AnIsotropicLineWithoutLengthIsAPointLight) {
    RandomNumbers u;
    for (int i = 0; i < 200; ++i) {
        const vec3 n(u.direction());
        const vec3 c(u.direction() * u(0.5, 3.0));
        const vec3 half = vec3(u.direction()) * 1e-4f;
        const float point = std::max(dot(n, glm::normalize(c)), 0.0f) / dot(c, c);
        EXPECT_NEAR(isotropic_line_attenuation(n, c - half, c + half, 0.0f), point, 1e-3f * point + 1e-4f);
        // A tube without length is a sphere, above the horizon.
        if (dot(n, c) > 0.1f) {
            EXPECT_NEAR(lamp_tube_projected_solid_angle(n, c, half * 1e4f, 0.0f, 0.05f),
                        sphere_projected_solid_angle(n, c, 0.05f), 1e-3f * PI * 0.0025f * point + 2e-5f);
        }
    }
}

// Karis 2013, equation 16 clamps the mean cosine and goes out with half of this line in view.
TEST(Limits, AnIsotropicLineFadesUntilItsTopIsBelowTheHorizon) {
    const auto lit = [](float middle_m, bool printed) {
        const vec3 low(1.0f, 0.0f, middle_m - 0.5f);
        const vec3 high(1.0f, 0.0f, middle_m + 0.5f);
        return printed ? isotropic_line_attenuation_printed(kUp, low, high, 0.0f)
                       : isotropic_line_attenuation(kUp, low, high, 0.0f);
    };
    float before = lit(0.6f, false);
    EXPECT_FLOAT_EQ(before, lit(0.6f, true));
    for (float middle_m = 0.5f; middle_m > -0.5f; middle_m -= 0.05f) {
        const float now = lit(middle_m, false);
        EXPECT_LT(now, before);
        EXPECT_GT(now, 0.0f);
        before = now;
    }
    EXPECT_EQ(lit(-0.51f, false), 0.0f);
    EXPECT_EQ(lit(-0.01f, true), 0.0f);
}

TEST(Limits, FarAwayEveryLightIsItsAreaInView) {
    const vec3 n = glm::normalize(vec3(0.2f, 0.1f, 0.9f));
    const vec3 to = glm::normalize(vec3(0.3f, -0.2f, 0.8f));
    const float cosine = dot(n, to);
    for (const float d : {50.0f, 299.0f, 301.0f, 2000.0f, 1.0e5f}) {
        const vec3 c = d * to;
        const float per_area = cosine / (d * d);
        EXPECT_NEAR(sphere_projected_solid_angle(n, c, 0.5f) / per_area, PI * 0.25f, 1e-3f);
        EXPECT_NEAR(disk_projected_solid_angle(n, c, -to, 0.5f) / per_area, PI * 0.25f, 1e-3f);
        EXPECT_NEAR(disk_projected_solid_angle(n, c, -kUp, 0.5f) / per_area, PI * 0.25f * to.z, 1e-3f);
        EXPECT_NEAR(rectangle_projected_solid_angle(n, c, kX, kY, 0.5f, 0.3f) / per_area, 0.6f * to.z, 1e-3f)
            << d;
        EXPECT_NEAR(tube_projected_solid_angle(n, c, kX, 0.5f, 0.1f) / per_area,
                    0.2f * std::sqrt(1.0f - to.x * to.x) + PI * 0.01f, 1e-3f)
            << d;
        EXPECT_NEAR(line_illuminance(n, c, kX, 0.5f) / per_area, std::sqrt(1.0f - to.x * to.x), 1e-3f);
    }
}

TEST(Limits, TouchingTheSurface) {
    // Standing on the receiver, a light's whole visible side is within the hemisphere of its tangent plane.
    for (const float gap : {1.0f, 1.0001f, 1.01f}) {
        EXPECT_NEAR(sphere_projected_solid_angle(kUp, gap * 0.5f * kUp, 0.5f), PI / (gap * gap), 1e-4f);
        EXPECT_NEAR(tube_projected_solid_angle(kUp, gap * 0.5f * kUp, kX, 1.0f, 0.5f), PI, 0.2f) << gap;
        EXPECT_NEAR(tube_projected_solid_angle(kX, gap * 0.5f * kUp, kX, 1.0f, 0.5f), 0.5f * PI, 0.2f) << gap;
    }
    // On the lamp's own plane there is nothing, a hair in front of its middle it fills the hemisphere.
    EXPECT_EQ(rectangle_projected_solid_angle(kUp, vec3(0.0f), kX, kY, 1.0f, 1.0f), 0.0f);
    EXPECT_EQ(disk_projected_solid_angle(kUp, vec3(0.0f), -kUp, 1.0f), 0.0f);
    EXPECT_NEAR(rectangle_projected_solid_angle(kUp, 1.0e-4f * kUp, kX, kY, 1.0f, 1.0f), PI, 1e-3f);
    EXPECT_NEAR(disk_projected_solid_angle(kUp, 1.0e-4f * kUp, -kUp, 1.0f), PI, 1e-3f);
}

// An emissive surface is a light, and every point of it a receiver: rounding alone says on which side of it.
TEST(Limits, AReceiverOnTheLightGetsNothingOfIt) {
    RandomNumbers u;
    for (int i = 0; i < 20000; ++i) {
        const vec3 n(u.direction());
        const vec3 right(u.perpendicular(glm::dvec3(n)));
        const vec3 up = glm::cross(right, -n);  // shines along n
        const vec3 center(u.direction() * u(0.0, 5.0));
        const vec3 receiver = center + right * float(u(-0.5, 0.5)) + up * float(u(-0.3, 0.3));
        const vec3 c = center - receiver;
        EXPECT_LT(rectangle_projected_solid_angle(n, c, right, up, 0.5f, 0.3f), 1e-4f) << i;
        const RectangleCorners q = rectangle_corners(c, right, up, 0.5f, 0.3f);
        EXPECT_LT(triangle_projected_solid_angle(n, q.p0, q.p1, q.p2), 1e-4f) << i;
    }
}

TEST(Limits, TwoTrianglesAreTheirRectangle) {
    RandomNumbers u;
    for (int i = 0; i < 500; ++i) {
        const vec3 n(u.direction());
        const vec3 right(u.direction());
        const vec3 up(u.perpendicular(glm::dvec3(right)));
        const vec3 c(u.direction() * u(0.1, 30.0));
        const RectangleCorners q = rectangle_corners(c, right, up, 0.8f, 0.3f);
        const float triangles = triangle_projected_solid_angle(n, q.p0, q.p1, q.p2) +
                                triangle_projected_solid_angle(n, q.p0, q.p2, q.p3);
        EXPECT_NEAR(triangles, rectangle_projected_solid_angle(n, c, right, up, 0.8f, 0.3f), 1e-5f) << i;
    }
}

TEST(Limits, CrossingTheSurfaceIsContinuous) {
    // A light is lowered through the receiver's plane: no step, never brighter, 0 in the end.
    const auto lower = [](auto f, float from, float to) {
        float before = f(from);
        const int steps = 4000;
        for (int i = 1; i <= steps; ++i) {
            const float z = from + (to - from) * float(i) / float(steps);
            const float now = f(z);
            EXPECT_LE(now, before + 2e-6f) << z;
            EXPECT_GE(now, before - 6.0f * (from - to) / float(steps)) << z;
            before = now;
        }
        EXPECT_EQ(before, 0.0f);
    };
    lower([](float z) { return sphere_projected_solid_angle(kUp, vec3(1.5f, 0.0f, z), 1.0f); }, 1.0f, -1.1f);
    lower([](float z) { return tube_projected_solid_angle(kUp, vec3(1.5f, 0.3f, z), kY, 1.0f, 0.5f); }, 0.6f,
          -0.6f);
    const vec3 steep = glm::normalize(vec3(0.1f, 0.2f, 1.0f));
    lower([&](float z) { return tube_projected_solid_angle(kUp, vec3(1.5f, 0.3f, z), steep, 1.0f, 0.5f); },
          0.7f, -1.6f);
    lower([](float z) { return disk_projected_solid_angle(kUp, vec3(1.5f, 0.3f, z), -kX, 0.5f); }, 0.6f,
          -0.6f);
    lower(
        [&](float z) {
            return rectangle_projected_solid_angle(kUp, vec3(1.5f, 0.3f, z), kY, kUp, 0.5f, 0.5f);
        },
        0.6f, -0.6f);
    lower([](float z) { return line_illuminance(kUp, vec3(1.5f, 0.3f, z), kUp, 0.5f); }, 0.6f, -0.6f);
}

TEST(Limits, ATubeThatPointsAtTheSurface) {
    // From inside of the endless cylinder only the nearer end is seen: a sphere. Outside of it the sides come
    // into view without a step.
    const float sphere = sphere_projected_solid_angle(kUp, kUp, 0.5f);
    EXPECT_NEAR(tube_projected_solid_angle(kUp, 2.0f * kUp, kUp, 1.0f, 0.5f), sphere, 1e-6f);
    EXPECT_NEAR(tube_projected_solid_angle(kUp, vec3(0.3f, 0.0f, 2.0f), kUp, 1.0f, 0.5f),
                sphere_projected_solid_angle(kUp, vec3(0.3f, 0.0f, 1.0f), 0.5f), 1e-6f);
    for (const vec3& n :
         {kUp, glm::normalize(vec3(1.0f, 0.3f, 0.4f)), glm::normalize(vec3(-1.0f, 0.1f, 0.2f))}) {
        const float inside = tube_projected_solid_angle(n, vec3(0.49999f, 0.0f, 2.0f), kUp, 1.0f, 0.5f);
        const float outside = tube_projected_solid_angle(n, vec3(0.50002f, 0.0f, 2.0f), kUp, 1.0f, 0.5f);
        EXPECT_NEAR(inside, outside, 2e-4f);
    }
    // A line has no end to be seen.
    EXPECT_NEAR(line_illuminance(kUp, 2.0f * kUp, kUp, 1.0f), 0.0f, 1e-6f);
}

TEST(Limits, InsideOfALightIsAsOnItsSurface) {
    RandomNumbers u;
    for (int i = 0; i < 200; ++i) {
        const vec3 n(u.direction());
        const vec3 to(u.direction());
        const float on_surface = 0.5f * PI * (1.0f + dot(n, to));  // a half space of light
        for (const float depth : {0.999f, 0.7f, 0.01f})
            EXPECT_NEAR(sphere_projected_solid_angle(n, depth * to, 1.0f), on_surface, 1e-5f);
        const vec3 axis(u.perpendicular(glm::dvec3(to)));
        EXPECT_NEAR(tube_projected_solid_angle(n, 0.4f * to, axis, 1.0f, 0.5f), on_surface, 1e-5f);
    }
}

TEST(Limits, DirectionsForBrdfsAreUnitAndAboveTheHorizon) {
    RandomNumbers u;
    for (int i = 0; i < 2000; ++i) {
        const vec3 n(u.direction());
        const vec3 c(u.direction() * u(0.0, 3.0));
        const vec3 a(u.direction());
        const vec3 b(u.perpendicular(glm::dvec3(a)));
        for (const vec3& l :
             {sphere_representative_direction(n, c, 0.5f), disk_representative_direction(n, c, a, 0.5f),
              rectangle_representative_direction(n, c, a, b, 0.5f, 0.9f),
              tube_representative_direction(n, c, a, 0.7f, 0.2f)}) {
            EXPECT_NEAR(glm::length(l), 1.0f, 1e-5f);
            EXPECT_GE(dot(n, l), 0.0f);
        }
    }
    // High above, all are the direction to the light.
    const vec3 far(3.0f, 2.0f, 30.0f);
    EXPECT_GT(dot(tube_representative_direction(kUp, far, kX, 0.7f, 0.2f), glm::normalize(far)), 0.999f);
    EXPECT_GT(dot(rectangle_representative_direction(kUp, far, kX, kY, 0.7f, 0.2f), glm::normalize(far)),
              0.999f);
}

}  // namespace
}  // namespace candela::shading
