#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "shading/lights/tube.glsl"

/// Sizes of nothing and of worlds, receivers on every special place: a number, and one that can be.
namespace candela::shading {
namespace {

const vec3 kX(1.0f, 0.0f, 0.0f);
const vec3 kY(0.0f, 1.0f, 0.0f);
const vec3 kZ(0.0f, 0.0f, 1.0f);

/// Signed axes, diagonals, and directions next to an axis.
std::vector<vec3> directions() {
    std::vector<vec3> out;
    for (const float s : {1.0f, -1.0f})
        for (const vec3& v :
             {kX, kY, kZ, vec3(1.0f, 1.0f, 0.0f), vec3(1.0f, 1.0f, 1.0f), vec3(1.0e-4f, 0.0f, 1.0f),
              vec3(1.0e-7f, 1.0e-7f, 1.0f), vec3(1.0f, -1.0e-5f, 0.0f)})
            out.push_back(s * glm::normalize(v));
    return out;
}

constexpr std::array<float, 7> kSizes{0.0f, 1.0e-12f, 1.0e-4f, 0.5f, 1.0f, 30.0f, 1.0e5f};
constexpr std::array<float, 8> kDistances{0.0f, 1.0e-15f, 1.0e-6f, 0.499999f, 0.5f, 1.0f, 1.0e3f, 1.0e7f};

using Technique = std::function<float(vec3 n, vec3 center, vec3 a, vec3 b, float size, float other)>;

void expect_sane(const std::string& name, const Technique& f, float largest) {
    std::size_t bad = 0;
    for (const vec3& n : directions())
        for (const vec3& to : directions())
            for (const vec3& a : directions())
                for (const float d : kDistances)
                    for (const float size : kSizes)
                        for (const float other : {0.0f, 0.02f, 1.0f}) {
                            const vec3 b = glm::normalize(glm::cross(a, std::abs(a.x) < 0.9f ? kX : kY));
                            const float e = f(n, d * to, a, b, size, other);
                            if (e >= 0.0f && e <= largest) continue;
                            if (++bad <= 3)
                                ADD_FAILURE()
                                    << name << " is " << e << " at distance " << d << " size " << size << ' '
                                    << other << " n " << n.x << ' ' << n.y << ' ' << n.z << " to " << to.x
                                    << ' ' << to.y << ' ' << to.z << " a " << a.x << ' ' << a.y << ' ' << a.z;
                        }
    EXPECT_EQ(bad, 0u) << name;
}

constexpr float kHemisphere = PI * 1.001f;

TEST(Hostile, DefaultsAreWithinTheHemisphere) {
    expect_sane(
        "sphere",
        [](vec3 n, vec3 c, vec3, vec3, float s, float) { return sphere_projected_solid_angle(n, c, s); },
        kHemisphere);
    expect_sane(
        "disk",
        [](vec3 n, vec3 c, vec3 a, vec3, float s, float) { return disk_projected_solid_angle(n, c, a, s); },
        kHemisphere);
    expect_sane(
        "rectangle",
        [](vec3 n, vec3 c, vec3 a, vec3 b, float s, float o) {
            return rectangle_projected_solid_angle(n, c, a, b, s, o);
        },
        kHemisphere);
    expect_sane(
        "tube",
        [](vec3 n, vec3 c, vec3 a, vec3, float s, float o) {
            return tube_projected_solid_angle(n, c, a, o, s);
        },
        kHemisphere);
    expect_sane(
        "thin tube",
        [](vec3 n, vec3 c, vec3 a, vec3, float s, float o) {
            return tube_projected_solid_angle(n, c, a, s, 0.01f * o);
        },
        kHemisphere);
    // At most what a point of 1 cd gives at 1 cm.
    expect_sane(
        "line", [](vec3 n, vec3 c, vec3 a, vec3, float s, float) { return line_illuminance(n, c, a, s); },
        1.01e4f);
}

TEST(Hostile, TheOtherTechniquesAreNumbers) {
    constexpr float kAny = 3.0e38f;
    using Rectangle = float (*)(vec3, vec3, vec3, vec3, float, float);
    for (const Rectangle f :
         {rectangle_projected_solid_angle_arvo, rectangle_projected_solid_angle_structured,
          rectangle_projected_solid_angle_drobot, rectangle_projected_solid_angle_drobot_horizon,
          rectangle_projected_solid_angle_simplified, rectangle_projected_solid_angle_simplified_horizon,
          rectangle_projected_solid_angle_position, rectangle_projected_solid_angle_five_times})
        expect_sane("rectangle technique", f, kAny);
    expect_sane(
        "disk, Frostbite",
        [](vec3 n, vec3 c, vec3 a, vec3, float s, float) {
            return disk_projected_solid_angle_frostbite(n, c, a, s);
        },
        kAny);
    expect_sane(
        "disk without horizon",
        [](vec3 n, vec3 c, vec3 a, vec3, float s, float) {
            return disk_projected_solid_angle_no_horizon(n, c, a, s);
        },
        kAny);
    expect_sane(
        "sphere without horizon",
        [](vec3 n, vec3 c, vec3, vec3, float s, float) {
            return sphere_projected_solid_angle_no_horizon(n, c, s);
        },
        kAny);
    expect_sane(
        "tube, Frostbite",
        [](vec3 n, vec3 c, vec3 a, vec3, float s, float o) {
            return tube_projected_solid_angle_frostbite(n, c, a, s, o);
        },
        kAny);
}

TEST(Hostile, DirectionsForBrdfsAreUnit) {
    const auto length_of = [](const vec3& l) { return std::abs(glm::length(l) - 1.0f); };
    expect_sane(
        "sphere",
        [&](vec3 n, vec3 c, vec3, vec3, float s, float) {
            return length_of(sphere_representative_direction(n, c, s));
        },
        1e-5f);
    expect_sane(
        "disk",
        [&](vec3 n, vec3 c, vec3 a, vec3, float s, float) {
            return length_of(disk_representative_direction(n, c, a, s));
        },
        1e-5f);
    expect_sane(
        "rectangle",
        [&](vec3 n, vec3 c, vec3 a, vec3 b, float s, float o) {
            return length_of(rectangle_representative_direction(n, c, a, b, s, o));
        },
        1e-5f);
    expect_sane(
        "tube",
        [&](vec3 n, vec3 c, vec3 a, vec3, float s, float o) {
            return length_of(tube_representative_direction(n, c, a, s, o));
        },
        1e-5f);
}

}  // namespace
}  // namespace candela::shading
