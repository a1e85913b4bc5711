#include <gtest/gtest.h>

#include <cmath>

#include "shading/lights/representative_point.glsl"
#include "shading/lights/sampling.glsl"
#include "shading/lights/sphere.glsl"
#include "shading/sequence.glsl"

namespace candela::shading {
namespace {

constexpr float kSunRadius_rad = 0.00465f;
const vec3 kNormal(0.0f, 0.0f, 1.0f);

/// D V cos integrated over the sun's disc about `center`, per cd/m^2.
double truth(const vec3& v, const vec3& center, float alpha) {
    constexpr uint count = 1024;
    double sum = 0.0;
    for (uint i = 0; i < count; ++i) {
        const vec3 l = sample_sun(hammersley(i, count), center, kSunRadius_rad);
        sum += double(specular_at_point(kNormal, v, l, alpha, alpha) * std::max(l.z, 0.0f) /
                      pdf_sun(kSunRadius_rad));
    }
    return sum / count;
}

/// Sum of errors over sum of truths, suns within six lobe widths of the mirror direction of 1000 views.
double relative_error(float alpha, float distribution_alpha) {
    double error = 0.0;
    double sum = 0.0;
    for (uint i = 0; i < 1000; ++i) {
        const vec2 a = hammersley(i, 1000);
        const vec2 b(std::fmod(float(i) * 0.7548777f, 1.0f), std::fmod(float(i) * 0.5698403f, 1.0f));
        const float NoV = 0.1f + 0.9f * a.y;
        const vec3 v(std::sqrt(1.0f - NoV * NoV), 0.0f, NoV);
        const vec3 mirror(-v.x, 0.0f, v.z);
        const vec3 t(0.0f, 1.0f, 0.0f);
        const float away = 6.0f * alpha * b.x;
        const vec3 center = glm::normalize(mirror + away * std::cos(6.2832f * b.y) * t +
                                           away * std::sin(6.2832f * b.y) * glm::cross(mirror, t));
        if (center.z < 0.02f) continue;
        const double lx = double(sphere_projected_solid_angle(kNormal, center, std::sin(kSunRadius_rad)));
        const double expected = truth(v, center, alpha);
        error += std::abs(double(specular_at_point(kNormal, v, center, alpha, distribution_alpha)) * lx -
                          expected);
        sum += expected;
    }
    return error / sum;
}

TEST(Sun, TheLobeAtItsCentreWidenedByItsDiscIsItsHighlight) {
    const auto widened = [](float alpha) {
        return relative_error(alpha, alpha_widened_by_disc(alpha, kSunRadius_rad));
    };
    EXPECT_LT(widened(0.02f), 0.055);
    EXPECT_LT(widened(0.05f), 0.01);
    EXPECT_LT(widened(0.1f), 0.004);
    EXPECT_LT(widened(0.4f), 0.001);
}

TEST(Sun, TheWideningHelps) {
    for (const float alpha : {0.01f, 0.02f, 0.05f}) {
        EXPECT_LT(relative_error(alpha, alpha_widened_by_disc(alpha, kSunRadius_rad)),
                  0.95 * relative_error(alpha, alpha))
            << alpha;
    }
}

}  // namespace
}  // namespace candela::shading
