// Representative points against a search over the shapes.
#include "shading/lights/representative_point.glsl"

#include <gtest/gtest.h>

#include <cmath>

#include "shading/basis.glsl"
#include "shading/sampling.glsl"
#include "shading/sequence.glsl"

namespace candela::shading {
namespace {

vec3 direction(uint k, uint seed) {
    const vec2 u = sobol_owen(k, seed);
    const vec3 d = sample_uniform_hemisphere(u);
    return k % 2u == 0u ? d : vec3(d.x, d.y, -d.z);
}

float distance_to_ray(const vec3& p, const vec3& ray) {
    return length(p - max(dot(p, ray), 0.0f) * ray);
}

struct Segment {
    vec3 start;
    vec3 end;
};
/// In front of the receiver as the mirror ray sees it: behind it, Karis's line is not the ray.
Segment segment_ahead(uint k, const vec3& mirror) {
    const vec3 center = 2.0f * normalize(mirror + 0.5f * direction(k, 1u));
    const vec3 half = 0.8f * direction(k, 2u);
    return {center - half, center + half};
}

// The representative point of a flat light on whose surface the receiver is, is the receiver.
TEST(RepresentativePoint, OnTheLightItselfIsNoHighlight) {
    const vec3 n(0.0f, 0.0f, 1.0f);
    const vec3 x(1.0f, 0.0f, 0.0f);
    const vec3 y(0.0f, -1.0f, 0.0f);  // x cross y points away from where it shines
    for (uint k = 0; k < 200; ++k) {
        const vec2 u = sobol_owen(k, 9u);
        const vec3 v = normalize(vec3(0.9f * u.x, 0.0f, 1.0f));
        const vec3 mirror = vec3(-v.x, 0.0f, v.z);
        const vec3 c(u.x - 0.5f, u.y - 0.5f, 0.0f);
        const float alpha = 0.01f + 0.9f * u.y;
        EXPECT_EQ(specular_at_point(n, v, representative_point_rectangle(c, x, y, 1.0f, 1.0f, mirror), alpha,
                                    alpha),
                  0.0f);
        EXPECT_EQ(specular_at_point(n, v, representative_point_disk(c, n, 1.0f, mirror), alpha, alpha), 0.0f);
    }
}

TEST(RepresentativePoint, OfALineIsTheNearestToTheRay) {
    for (uint k = 0; k < 200; ++k) {
        const vec3 mirror = direction(k, 3u);
        const Segment s = segment_ahead(k, mirror);
        const float found = distance_to_ray(
            mix(s.start, s.end, representative_share_of_line(s.start, s.end, mirror)), mirror);
        for (int i = 0; i <= 100; ++i)
            EXPECT_GE(distance_to_ray(mix(s.start, s.end, float(i) / 100.0f), mirror), found - 1.0e-4f) << k;
    }
}

TEST(RepresentativePoint, OfALineByAngleIsTheOneOfTheSmallestAngle) {
    for (uint k = 0; k < 200; ++k) {
        const vec3 mirror = direction(k, 3u);
        const Segment s = segment_ahead(k, mirror);
        const auto cosine = [&](float t) { return dot(normalize(mix(s.start, s.end, t)), mirror); };
        const float found = cosine(representative_share_of_line_by_angle(s.start, s.end, mirror));
        for (int i = 0; i <= 100; ++i) EXPECT_LE(cosine(float(i) / 100.0f), found + 1.0e-5f) << k;
    }
}

TEST(RepresentativePoint, OfATubeLiesInItAndIsNotFurtherFromTheRayThanItsAxis) {
    for (uint k = 0; k < 200; ++k) {
        const vec3 mirror = direction(k, 3u);
        const Segment s = segment_ahead(k, mirror);
        const vec3 center = 0.5f * (s.start + s.end);
        const vec3 axis = normalize(s.end - s.start);
        const vec3 p = representative_point_tube(center, axis, 0.8f, 0.2f, mirror);
        const vec3 foot = center + clamp(dot(p - center, axis), -0.8f, 0.8f) * axis;
        EXPECT_LE(length(p - foot), 0.2001f);
        const vec3 on_axis = mix(s.start, s.end, representative_share_of_line(s.start, s.end, mirror));
        EXPECT_LE(distance_to_ray(p, mirror), max(distance_to_ray(on_axis, mirror) - 0.2f, 0.0f) + 1.0e-4f);
    }
}

TEST(RepresentativePoint, OfAFlatLightIsWhereTheRayMeetsItOrItsNearestPointToThere) {
    for (uint k = 0; k < 200; ++k) {
        const vec3 center = 2.0f * direction(k, 1u);
        const vec3 shine = normalize(0.6f * direction(k, 2u) - normalize(center));
        vec3 right;
        vec3 b;
        orthonormal_basis(shine, right, b);
        const vec3 up = cross(-shine, right);
        const vec3 inside = center + 0.3f * right - 0.2f * up;
        const vec3 mirror = normalize(inside);
        EXPECT_LT(length(representative_point_disk(center, shine, 0.5f, mirror) - inside), 1.0e-4f);
        EXPECT_LT(length(representative_point_rectangle(center, right, up, 0.5f, 0.4f, mirror) - inside),
                  1.0e-4f);
        const vec3 beside = center + 0.3f * right - 2.0f * up;
        EXPECT_LT(length(representative_point_rectangle(center, right, up, 0.5f, 0.4f, normalize(beside)) -
                         (center + 0.3f * right - 0.4f * up)),
                  1.0e-3f);
        EXPECT_NEAR(length(representative_point_disk(center, shine, 0.5f, normalize(beside)) - center), 0.5f,
                    1.0e-4f);
        // A ray that leads away still ends on the light.
        const vec3 away = representative_point_rectangle(center, right, up, 0.5f, 0.4f, -mirror);
        EXPECT_LE(std::abs(dot(away - center, right)), 0.5001f);
        EXPECT_LE(std::abs(dot(away - center, up)), 0.4001f);
        EXPECT_NEAR(dot(away - center, shine), 0.0f, 1.0e-4f);
    }
}

TEST(RepresentativePoint, NormalizationsVanishWithTheLight) {
    EXPECT_FLOAT_EQ(representative_point_sphere_normalization(0.2f, 0.0f, 1.0f), 1.0f);
    EXPECT_FLOAT_EQ(representative_point_line_normalization(0.2f, 0.0f, 1.0f), 1.0f);
    EXPECT_FLOAT_EQ(representative_point_tube_normalization(0.2f, 0.0f, 0.1f, 1.0f),
                    representative_point_sphere_normalization(0.2f, 0.1f, 1.0f));
    EXPECT_FLOAT_EQ(representative_point_rectangle_normalization(0.2f, 0.1f, 0.1f, 1.0f),
                    representative_point_sphere_normalization(0.2f, 0.1f, 1.0f));
    EXPECT_LT(representative_point_tube_normalization(0.2f, 1.0f, 0.1f, 1.0f),
              representative_point_sphere_normalization(0.2f, 0.1f, 1.0f));
}

TEST(RepresentativePoint, OfTheSunIsTheMirrorDirectionInsideItsDiscAndOnItsEdgeOutside) {
    const float radius = 0.00465f;
    for (uint k = 0; k < 200; ++k) {
        const vec3 sun = direction(k, 1u);
        const vec3 mirror = normalize(sun + 0.02f * direction(k, 2u));
        const vec3 l = representative_direction_of_sun(sun, mirror, radius);
        const float to_mirror = length(cross(sun, mirror));
        EXPECT_NEAR(length(l), 1.0f, 1.0e-5f);
        if (to_mirror < 0.99f * radius) {
            EXPECT_LT(length(l - mirror), 1.0e-6f);
        } else if (to_mirror > 1.05f * radius) {
            EXPECT_NEAR(length(cross(sun, l)), std::sin(radius), 1.0e-5f);
            EXPECT_NEAR(length(cross(mirror, l)), to_mirror - radius, 2.0e-5f);
        }
    }
    EXPECT_FALSE(
        any(isnan(representative_direction_of_sun(vec3(0.0f, 0.0f, 1.0f), vec3(0.0f, 0.0f, 1.0f), radius))));
}

TEST(RepresentativePoint, OfAPointIsThePunctualHighlight) {
    const vec3 n(0.0f, 0.0f, 1.0f);
    const vec3 v = normalize(vec3(-0.5f, 0.1f, 0.8f));
    const vec3 l = normalize(vec3(0.4f, 0.2f, 0.7f));
    const vec3 h = normalize(v + l);
    EXPECT_FLOAT_EQ(specular_at_point(n, v, 3.0f * l, 0.3f, 0.3f),
                    D_GGX(n, h, 0.3f) * V_SmithGGXCorrelated(v.z, l.z, 0.3f));
    EXPECT_EQ(specular_at_point(n, v, vec3(1.0f, 0.0f, -0.1f), 0.3f, 0.3f), 0.0f);
}

}  // namespace
}  // namespace candela::shading
