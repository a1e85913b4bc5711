#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "candela/realtime/light_images.hpp"
#include "shading/lights/rectangle.glsl"
#include "shading/lights/rectangle_image.glsl"

namespace candela::realtime {
namespace {

using namespace shading;

/// Coloured bands and a bright spot, as a screen or a window has.
scene::Image picture() {
    scene::Image image;
    image.width = 96;
    image.height = 64;
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const bool spot = std::hypot(double(x) - 70.0, double(y) - 20.0) < 9.0;
            image.rgba.push_back(spot ? 255 : static_cast<std::uint8_t>(40 + 2 * x));
            image.rgba.push_back(spot ? 255 : static_cast<std::uint8_t>(3 * y));
            image.rgba.push_back(x < 30 ? 220 : 30);
            image.rgba.push_back(255);
        }
    }
    return image;
}

vec3 texel_of(const ImagePyramid& p, int index) {
    const auto i = static_cast<std::size_t>(3 * index);
    return {p.rgb[i], p.rgb[i + 1], p.rgb[i + 2]};
}

vec3 read_level(const ImagePyramid& p, vec2 uv, int level) {
    const PyramidTaps taps = pyramid_taps(uv, p.size, level);
    vec3 sum(0.0f);
    for (int i = 0; i < 4; ++i) sum += texel_of(p, taps.index[i]) * taps.weight[i];
    return sum;
}

vec3 read(const ImagePyramid& p, vec3 spot) {
    const float level = pyramid_level_of_share(spot.z, p.size);
    const int finer = std::min(static_cast<int>(level), std::max(0, std::ilogb(float(p.size)) - 1));
    return mix(read_level(p, vec2(spot), finer), read_level(p, vec2(spot), finer + 1), level - float(finer));
}

struct Rectangle {
    vec3 center;
    vec3 right;
    vec3 up;
    float half_width = 1.0f;
    float half_height = 0.7f;
};

/// Mean of the picture over the rectangle, weighted by the cosine about `w` and the solid angle.
vec3 brute_force(const ImagePyramid& p, vec3 w, const Rectangle& r) {
    constexpr int n = 128;
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    const vec3 away = cross(r.right, r.up);
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const float x = (2.0f * float(i) + 1.0f) / n - 1.0f;
            const float y = (2.0f * float(j) + 1.0f) / n - 1.0f;
            const vec3 at = r.center + r.right * (x * r.half_width) + r.up * (y * r.half_height);
            const double d2 = dot(at, at);
            const double weight = std::max(0.0f, dot(w, at)) * std::max(0.0f, dot(away, at)) / (d2 * d2);
            sum += weight * glm::dvec3(read_level(p, vec2(0.5f - 0.5f * x, 0.5f - 0.5f * y), 0));
            weights += weight;
        }
    }
    return weights > 0.0 ? vec3(sum / weights) : vec3(-1.0f);
}

TEST(LightImage, ThePyramidEndsWithTheMeanAndItsLevelsKeepIt) {
    const ImagePyramid p = image_pyramid(picture());
    ASSERT_EQ(p.size, 128);
    const vec3 mean = texel_of(p, pyramid_first_texel(p.size, 7));
    for (int level = 0; level < 7; ++level) {
        const int side = p.size >> level;
        glm::dvec3 sum(0.0);
        for (int i = 0; i < side * side; ++i) sum += texel_of(p, pyramid_first_texel(p.size, level) + i);
        EXPECT_LT(distance(vec3(sum / double(side * side)), mean), 0.02f) << level;
    }
    EXPECT_EQ(p.rgb.size(), 3u * static_cast<std::size_t>(pyramid_first_texel(p.size, 7) + 1));
}

TEST(LightImage, TheMomentIsThatOfTheIntegral) {
    const vec3 w = normalize(vec3(0.2f, -0.1f, 1.0f));
    const Rectangle r{vec3(0.3f, 0.2f, 1.5f), normalize(vec3(1.0f, 0.1f, 0.2f)),
                      normalize(vec3(-0.1f, 1.0f, 0.0f))};
    const RectangleCorners c = rectangle_corners(r.center, r.right, r.up, r.half_width, r.half_height);
    const vec3 found = quad_cosine_moment(w, c.p0, c.p1, c.p2, c.p3);
    glm::dvec3 sum(0.0);
    constexpr int n = 400;
    const vec3 away = cross(r.right, r.up);
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const vec3 at = r.center + r.right * (((2.0f * float(i) + 1.0f) / n - 1.0f) * r.half_width) +
                            r.up * (((2.0f * float(j) + 1.0f) / n - 1.0f) * r.half_height);
            const double d = length(at);
            const double sr = 4.0 * r.half_width * r.half_height / (n * n) * dot(away, at) / (d * d * d);
            sum += glm::dvec3(at) / d * (dot(w, at) / d * sr);
        }
    }
    EXPECT_LT(distance(found, vec3(sum)), 1e-3f * length(found));
}

// cos^4 is a half at the angle whose cosine is the fourth root of a half; the spot reaches twice its tangent.
TEST(LightImage, TheSpotOfACosineIsWhereItHasFallenToAHalf) {
    const float cosine2 = std::sqrt(0.5f);
    EXPECT_NEAR(kCosineSpot, 2.0f * std::sqrt(1.0f / cosine2 - 1.0f), 0.02f);
}

TEST(LightImage, OneReadingIsNearTheIntegralAndMuchNearerThanTheMeanColour) {
    const ImagePyramid p = image_pyramid(picture());
    const vec3 mean = texel_of(p, pyramid_first_texel(p.size, 7));
    std::mt19937 random(5);
    std::uniform_real_distribution<float> u(-1.0f, 1.0f);
    double error = 0.0;
    double error_of_mean = 0.0;
    int count = 0;
    for (int i = 0; i < 300; ++i) {
        const vec3 w = normalize(vec3(u(random), u(random), 1.2f));
        Rectangle r;
        r.center = vec3(u(random), u(random), 0.15f + 0.8f * (1.0f + u(random)));
        r.right = normalize(vec3(1.0f, 0.5f * u(random), 0.5f * u(random)));
        r.up = normalize(cross(normalize(vec3(0.3f * u(random), 0.3f * u(random), 1.0f)), r.right));
        if (dot(cross(r.right, r.up), r.center) < 0.1f) continue;
        const vec3 truth = brute_force(p, w, r);
        if (truth.x < 0.0f) continue;
        const RectangleCorners c = rectangle_corners(r.center, r.right, r.up, r.half_width, r.half_height);
        const vec3 found = read(p, rectangle_image_spot(w, c.p0, c.p1, c.p2, c.p3));
        error += double(distance(found, truth));
        error_of_mean += double(distance(mean, truth));
        ++count;
    }
    ASSERT_GT(count, 200);
    RecordProperty("error", std::to_string(error / count));
    EXPECT_LT(error / count, 0.045);
    EXPECT_LT(error, 0.25 * error_of_mean) << error / count << " of " << error_of_mean / count;
}

TEST(LightImage, ANarrowSpotReadsWhatItLooksAt) {
    const ImagePyramid p = image_pyramid(picture());
    // 2 cm before the middle of the bright spot, which is to the left of who stands in the light.
    const Rectangle r{vec3(0.0f, 0.0f, 0.02f), vec3(1, 0, 0), vec3(0, 1, 0)};
    const float s = 0.5f - 70.0f / 96.0f;
    const float t = 0.5f - 20.0f / 64.0f;
    const vec3 center = r.center - vec3(2.0f * s * r.half_width, 2.0f * t * r.half_height, 0.0f);
    const RectangleCorners c = rectangle_corners(center, r.right, r.up, r.half_width, r.half_height);
    const vec3 spot = rectangle_image_spot(vec3(0, 0, 1), c.p0, c.p1, c.p2, c.p3);
    EXPECT_NEAR(spot.x, 70.0f / 96.0f, 0.02f);
    EXPECT_NEAR(spot.y, 20.0f / 64.0f, 0.02f);
    EXPECT_GT(read(p, spot).y, 0.9f);
}

}  // namespace
}  // namespace candela::realtime
