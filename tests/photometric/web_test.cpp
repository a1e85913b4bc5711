#include <gtest/gtest.h>

#include "read_back.hpp"
#include "shading/lights/photometric.glsl"

using namespace candela;
using namespace candela::test;

namespace {

constexpr double kPi = std::numbers::pi;

double cosine(double, double gamma) {
    return 100.0 * std::max(0.0, std::cos(gamma * kDegree));
}

/// Bright on one side: no symmetry at all.
double lopsided(double c, double gamma) {
    return 200.0 + 100.0 * std::sin(gamma * kDegree) * std::cos((c - 30.0) * kDegree) +
           50.0 * std::cos(gamma * kDegree);
}

}  // namespace

TEST(PhotometricWeb, AnIsotropicWebGivesFourPiLumensACandela) {
    const auto p = read(IesFile().bytes());
    EXPECT_NEAR(scene::integrated_lm(p), 4.0 * kPi * 100.0, 1e-9 * 400.0 * kPi);
    EXPECT_NEAR(scene::downward_lm(p), 2.0 * kPi * 100.0, 1e-9 * 400.0 * kPi);
    EXPECT_FALSE(scene::beam_angle(p).c0_c180_deg) << "it never falls";
}

TEST(PhotometricWeb, ACosineWebGivesPiLumensACandela) {
    IesFile file;
    file.vertical = steps(0, 90, 2.5);
    file.intensity = cosine;
    const auto p = read(file.bytes());
    // The chords of the cosine lie under it by h^2 / 12 of its second derivative.
    EXPECT_NEAR(scene::integrated_lm(p), kPi * 100.0, 2e-4 * kPi * 100.0);
    EXPECT_LT(scene::integrated_lm(p), kPi * 100.0);
    EXPECT_NEAR(*scene::beam_angle(p).c0_c180_deg, 120.0, 1e-4);
    EXPECT_NEAR(*scene::field_angle(p).c90_c270_deg, 2.0 * std::acos(0.1) / kDegree, 0.02);
    const auto top = scene::peak(p);
    EXPECT_DOUBLE_EQ(top.candela, 100.0);
    EXPECT_DOUBLE_EQ(top.gamma_deg, 0.0);
}

TEST(PhotometricWeb, ALinearFallHasItsClosedForm) {
    // I = 1 - gamma / (pi/2) down to the horizon: 2 pi (1 - 2/pi) lm, which its two angles hold exactly.
    IesFile file;
    file.vertical = {0.0, 90.0};
    file.intensity = [](double, double gamma) { return gamma == 0.0 ? 1000.0 : 0.0; };
    const auto p = read(file.bytes());
    EXPECT_NEAR(scene::integrated_lm(p), 1000.0 * 2.0 * kPi * (1.0 - 2.0 / kPi), 1e-9);
    EXPECT_NEAR(*scene::beam_angle(p).c0_c180_deg, 90.0, 1e-9);
    EXPECT_NEAR(*scene::field_angle(p).c0_c180_deg, 162.0, 1e-9);
}

TEST(PhotometricWeb, IsDarkWhereTheFileSaysNothing) {
    IesFile file;
    file.vertical = {0.0, 90.0};
    const auto down = read(file.bytes());
    EXPECT_DOUBLE_EQ(scene::intensity_cd(down, 10.0, 90.0), 100.0);
    EXPECT_DOUBLE_EQ(scene::intensity_cd(down, 10.0, 90.001), 0.0);
    EXPECT_NEAR(scene::integrated_lm(down), 2.0 * kPi * 100.0, 1e-6);
    file.vertical = {90.0, 180.0};
    const auto up = read(file.bytes());
    EXPECT_DOUBLE_EQ(scene::intensity_cd(up, 10.0, 89.999), 0.0);
    EXPECT_DOUBLE_EQ(scene::intensity_cd(up, 10.0, 90.001), 100.0);
    EXPECT_NEAR(scene::integrated_lm(up), 2.0 * kPi * 100.0, 1e-6);
    EXPECT_NEAR(scene::downward_lm(up), 0.0, 1e-9);
}

TEST(PhotometricWeb, TheFrameIsThatOfTheNode) {
    IesFile file;
    file.vertical = steps(0, 180, 5);
    file.horizontal = steps(0, 360, 15);
    file.intensity = lopsided;
    const auto p = read(file.bytes());
    const auto at = [&](float x, float y, float z) { return scene::intensity_cd(p, glm::vec3(x, y, z)); };
    EXPECT_NEAR(at(0, 0, -1), lopsided(0, 0), 1e-3) << "gamma 0 is -Z";
    EXPECT_NEAR(at(0, 0, 2), lopsided(0, 180), 1e-3);
    EXPECT_NEAR(at(1, 0, 0), lopsided(0, 90), 1e-3) << "C0 is +X";
    EXPECT_NEAR(at(0, 3, 0), lopsided(90, 90), 1e-3) << "C90 is +Y";
    EXPECT_NEAR(at(-1, 0, 0), lopsided(180, 90), 1e-3);
    EXPECT_NEAR(at(0, -1, 0), lopsided(270, 90), 1e-3);
    const glm::vec3 d = shading::photometric_direction(float(45.0 * kDegree), float(30.0 * kDegree));
    EXPECT_NEAR(scene::intensity_cd(p, d), lopsided(45, 30), 1e-3);
    EXPECT_NEAR(scene::intensity_cd(p, -315.0, 30.0), lopsided(45, 30), 1e-3) << "any turn";
}

TEST(PhotometricWeb, EverySymmetryOfIesIsItsFullExpansion) {
    const Distribution twofold = [](double c, double gamma) {
        return 300.0 + 100.0 * std::sin(gamma * kDegree) * std::cos(2.0 * c * kDegree);
    };
    const Distribution about_c0 = [](double c, double gamma) {
        return 300.0 + 100.0 * std::sin(gamma * kDegree) * std::cos(c * kDegree);
    };
    const Distribution about_c90 = [](double c, double gamma) {
        return 300.0 + 100.0 * std::sin(gamma * kDegree) * std::sin(c * kDegree);
    };
    using Symmetry = scene::PhotometricSymmetry;
    struct Case {
        double from, to;
        Distribution intensity;
        Symmetry symmetry;
    };
    const Case cases[] = {{0, 90, twofold, Symmetry::both_planes},
                          {0, 180, about_c0, Symmetry::plane_c0_c180},
                          {180, 360, about_c0, Symmetry::plane_c0_c180},
                          {90, 270, about_c90, Symmetry::plane_c90_c270},
                          {-90, 90, about_c90, Symmetry::plane_c90_c270},
                          {-180, 180, lopsided, Symmetry::none},
                          {0, 345, lopsided, Symmetry::none}};
    for (const Case& c : cases) {
        IesFile part, whole;
        part.vertical = whole.vertical = steps(0, 180, 10);
        part.horizontal = steps(c.from, c.to, 15);
        whole.horizontal = steps(0, 360, 15);
        part.intensity = whole.intensity = c.intensity;
        const auto p = read(part.bytes()), q = read(whole.bytes());
        EXPECT_EQ(p.symmetry, c.symmetry) << c.from << " to " << c.to;
        EXPECT_EQ(q.symmetry, Symmetry::none);
        ASSERT_EQ(p.horizontal_deg, q.horizontal_deg) << c.from << " to " << c.to;
        ASSERT_EQ(p.candela.size(), q.candela.size());
        for (std::size_t i = 0; i < p.candela.size(); ++i)
            ASSERT_NEAR(p.candela[i], q.candela[i], 1e-3) << c.from << " to " << c.to << ", node " << i;
    }
}

TEST(PhotometricWeb, ASymmetryWithoutC0HasItFromItsNeighbours) {
    IesFile file;
    file.horizontal = {90.0, 150.0, 210.0, 270.0};
    file.intensity = [](double c, double gamma) { return gamma == 90.0 ? c : 180.0; };
    const auto p = read(file.bytes());
    EXPECT_NEAR(scene::intensity_cd(p, 30.0, 90.0), 150.0, 1e-6) << "the mirror of 150 about C90 is 30";
    EXPECT_NEAR(scene::intensity_cd(p, 330.0, 90.0), 210.0, 1e-6);
    EXPECT_NEAR(scene::intensity_cd(p, 0.0, 90.0), 180.0, 1e-6);
    EXPECT_NEAR(scene::intensity_cd(p, 180.0, 90.0), 180.0, 1e-6);
}

TEST(PhotometricWeb, EverySymmetryOfEulumdatIsItsFullExpansion) {
    const Distribution of[] = {
        lopsided, [](double, double gamma) { return 100.0 + gamma; },
        [](double c, double gamma) { return 300.0 + gamma * (180.0 - gamma) / 50.0 * std::cos(c * kDegree); },
        [](double c, double gamma) { return 300.0 + gamma * (180.0 - gamma) / 50.0 * std::sin(c * kDegree); },
        [](double c, double gamma) {
            return 300.0 + gamma * (180.0 - gamma) / 50.0 * std::cos(2.0 * c * kDegree);
        }};
    for (int symmetry = 0; symmetry <= 4; ++symmetry) {
        LdtFile file;
        file.symmetry = symmetry;
        file.planes = steps(0, 345, 15);
        file.gammas = steps(0, 180, 10);
        file.per_klm = of[symmetry];
        const auto p = read(file.bytes());
        for (double c = 0.0; c < 360.0; c += 15.0) {
            for (double gamma = 0.0; gamma <= 180.0; gamma += 10.0)
                ASSERT_NEAR(scene::intensity_cd(p, c, gamma), of[symmetry](c, gamma), 1e-3)
                    << "symmetry " << symmetry << " C" << c << " gamma " << gamma;
        }
    }
}

TEST(PhotometricWeb, HalfPlanesThatDisagreeAtAPoleAreSaid) {
    IesFile file;
    file.horizontal = {0.0, 90.0, 180.0};
    file.intensity = [](double c, double gamma) { return gamma == 0.0 ? 100.0 + c : 100.0; };
    Diagnostics diagnostics;
    const auto p = read(file.bytes(), diagnostics);
    ASSERT_EQ(diagnostics.warnings().size(), 1u);
    EXPECT_NE(diagnostics.warnings().front().text.find("disagree at gamma 0, 100 to 280"), std::string::npos);
    EXPECT_EQ(scene::intensity_cd(p, glm::vec3(0.0f, 0.0f, -1.0f)), 100.0);
}

TEST(PhotometricWeb, SpreadHoldsBothLobesOfABatwing) {
    IesFile file;
    file.vertical = steps(0, 90, 1);
    file.intensity = [](double, double gamma) {
        return std::max(0.0, 1000.0 - 50.0 * std::abs(gamma - 30.0));
    };
    const auto p = read(file.bytes());
    EXPECT_NEAR(*scene::beam_angle(p).c0_c180_deg, 80.0, 1e-6) << "to 40 degrees on each side";
    EXPECT_NEAR(*scene::field_angle(p).c0_c180_deg, 96.0, 1e-6);
}
