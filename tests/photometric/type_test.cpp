#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "read_back.hpp"
#include "shading/lights/photometric.glsl"

using namespace candela;
using namespace candela::test;

namespace {

/// One distribution of no symmetry, over directions of the luminaire's frame: a beam off the aim, and a
/// floor.
double of_direction(const glm::vec3& d) {
    const glm::vec3 beam = glm::normalize(glm::vec3(0.25f, -0.4f, -1.0f));
    return 20.0 * std::max(0.0f, -d.z) + 1000.0 * std::pow(std::max(0.0f, glm::dot(d, beam)), 12.0);
}

IesFile of_type(int type, double step) {
    IesFile file;
    file.type = type;
    if (type == 1) {
        file.vertical = steps(0, 90, step);
        file.horizontal = steps(0, 360, step);
    } else {
        file.vertical = steps(-90, 90, step);
        file.horizontal = steps(-90, 90, step);
    }
    file.intensity = [type](double h, double v) {
        const auto hr = float(h * kDegree), vr = float(v * kDegree);
        if (type == 1) return of_direction(shading::photometric_direction(hr, vr));
        // By hand, from the standard's words, not by the functions that the reader calls. B: the plane at v
        // from nadir towards the photometric horizontal (+X), h within it clockwise. A: latitude v, longitude
        // h.
        if (type == 2)
            return of_direction({std::cos(hr) * std::sin(vr), -std::sin(hr), -std::cos(hr) * std::cos(vr)});
        return of_direction({std::sin(vr), -std::cos(vr) * std::sin(hr), -std::cos(vr) * std::cos(hr)});
    };
    return file;
}

}  // namespace

TEST(PhotometricType, AllOfOneDistributionAgreeInEveryDirection) {
    const auto a = read(of_type(3, 2.5).bytes()), b = read(of_type(2, 2.5).bytes()),
               c = read(of_type(1, 2.5).bytes());
    EXPECT_EQ(a.type, scene::PhotometricType::a);
    EXPECT_EQ(b.type, scene::PhotometricType::b);
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 4000; ++i) {
        const glm::vec3 d = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
        const double truth = of_direction(d);
        // Chords over 2.5 degrees of a beam whose curvature is 12 of its peak, both ways: h^2 / 8 * 24 of it.
        EXPECT_NEAR(scene::intensity_cd(a, d), truth, 6.0) << d.x << ' ' << d.y << ' ' << d.z;
        EXPECT_NEAR(scene::intensity_cd(b, d), truth, 6.0) << d.x << ' ' << d.y << ' ' << d.z;
        EXPECT_NEAR(scene::intensity_cd(c, d), truth, 6.0) << d.x << ' ' << d.y << ' ' << d.z;
    }
    EXPECT_NEAR(scene::integrated_lm(a) / scene::integrated_lm(c), 1.0, 0.002);
    EXPECT_NEAR(scene::integrated_lm(b) / scene::integrated_lm(c), 1.0, 0.002);
    EXPECT_NEAR(scene::peak(a).candela / scene::peak(c).candela, 1.0, 0.005);
    EXPECT_NEAR(scene::peak(b).candela / scene::peak(c).candela, 1.0, 0.005);
}

TEST(PhotometricType, TheirAxesAreTheStandards) {
    // Type B: at horizontal 0 the vertical angle goes from nadir to the photometric horizontal, as type C's
    // in C0.
    EXPECT_NEAR(shading::photometric_direction_type_b(0.0f, 1.5707963f).x, 1.0f, 1e-6f);
    // Clockwise from above where type C is counter-clockwise: horizontal 90 is C270.
    EXPECT_NEAR(shading::photometric_direction_type_b(1.5707963f, 0.0f).y, -1.0f, 1e-6f);
    // Type A: straight up is its pole, whatever the horizontal angle; the right of who looks along the beam
    // is positive.
    EXPECT_NEAR(shading::photometric_direction_type_a(0.7f, 1.5707963f).x, 1.0f, 1e-6f);
    EXPECT_NEAR(shading::photometric_direction_type_a(1.5707963f, 0.0f).y, -1.0f, 1e-6f);
    for (float h : {-1.2f, 0.0f, 0.4f}) {
        for (float v : {-1.5f, -0.3f, 0.0f, 1.1f}) {
            const glm::vec2 a =
                shading::photometric_angles_type_a(shading::photometric_direction_type_a(h, v));
            const glm::vec2 b =
                shading::photometric_angles_type_b(shading::photometric_direction_type_b(h, v));
            EXPECT_NEAR(a.x, h, 1e-5f);
            EXPECT_NEAR(a.y, v, 1e-5f);
            EXPECT_NEAR(b.x, h, 1e-5f);
            EXPECT_NEAR(b.y, v, 1e-5f);
        }
    }
}

TEST(PhotometricType, QuartersOfAAndBAreMirrored) {
    for (int type : {2, 3}) {
        IesFile quarter, whole;
        quarter.type = whole.type = type;
        quarter.vertical = quarter.horizontal = steps(0, 90, 5);
        whole.vertical = whole.horizontal = steps(-90, 90, 5);
        quarter.intensity = whole.intensity = [](double h, double v) {
            return 1000.0 * std::exp(-(h * h + 2.0 * v * v) / 800.0);
        };
        const auto p = read(quarter.bytes()), q = read(whole.bytes());
        EXPECT_EQ(p.symmetry, scene::PhotometricSymmetry::both_planes);
        EXPECT_EQ(q.symmetry, scene::PhotometricSymmetry::none);
        ASSERT_EQ(p.candela.size(), q.candela.size());
        for (std::size_t i = 0; i < p.candela.size(); ++i) ASSERT_NEAR(p.candela[i], q.candela[i], 0.01);
    }
}

TEST(PhotometricType, LightBehindIsThereWhereAWebGoesAround) {
    IesFile file;
    file.type = 3;
    file.vertical = steps(-90, 90, 10);
    file.horizontal = steps(-180, 180, 10);
    const auto p = read(file.bytes());
    EXPECT_NEAR(scene::integrated_lm(p), 4.0 * std::numbers::pi * 100.0, 0.01);
    file.horizontal = steps(-90, 90, 10);
    EXPECT_NEAR(scene::integrated_lm(read(file.bytes())), 2.0 * std::numbers::pi * 100.0, 0.01);
}
