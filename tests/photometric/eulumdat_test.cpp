#include <gtest/gtest.h>

#include "candela/scene/error.hpp"
#include "read_back.hpp"

using namespace candela;
using namespace candela::test;

TEST(Eulumdat, IntensityIsPerKilolumenOfTheLamps) {
    LdtFile file;
    file.sets = {{1, 2500.0, "3000", 20.0}};
    file.conversion = 0.8;
    const auto p = read(file.bytes());
    EXPECT_NEAR(scene::intensity_cd(p, 0.0, 0.0), 100.0 * 0.8 * 2.5, 1e-4);
    EXPECT_FALSE(p.absolute);
    EXPECT_EQ(p.symmetry, scene::PhotometricSymmetry::axial);
    EXPECT_EQ(p.name, "Lamp of tests");
}

TEST(Eulumdat, StatedLumensAreThoseThatLeaveTheLuminaire) {
    LdtFile file;
    file.sets = {{-1, 2000.0, "3000", 20.0}};
    file.output_percent = 80.0;
    const double isotropic = 1000.0 * 0.8 / (4.0 * std::numbers::pi);
    file.per_klm = [&](double, double) { return isotropic; };
    const auto p = read(file.bytes());
    EXPECT_TRUE(p.absolute);
    EXPECT_EQ(p.lamp_sets.front().count, 1);
    EXPECT_NEAR(*scene::stated_lm(p), 1600.0, 1e-9);
    EXPECT_NEAR(scene::integrated_lm(p), 1600.0, 0.01);
    EXPECT_NEAR(*p.downward_fraction, 0.5, 1e-9);
}

TEST(Eulumdat, SetsOfLampsAreAlternatives) {
    LdtFile file;
    file.sets = {{1, 500.0, "830", 15.0}, {2, 1200.0, "4000K", 30.0}, {1, 700.0, "", 0.0}};
    const std::string bytes = file.bytes();
    Diagnostics diagnostics;
    const double expected[] = {50.0, 120.0, 70.0};
    for (std::size_t set = 0; set < 3; ++set) {
        const auto p = read(bytes, diagnostics, {set});
        EXPECT_NEAR(scene::intensity_cd(p, 0.0, 0.0), expected[set], 1e-4);
        EXPECT_EQ(p.lamp_set, set);
        ASSERT_EQ(p.lamp_sets.size(), 3u);
    }
    const auto p = read(bytes);
    EXPECT_EQ(p.lamp_sets[0].temperature_kelvin, 3000.0) << "the code 830";
    EXPECT_EQ(p.lamp_sets[1].temperature_kelvin, 4000.0);
    EXPECT_FALSE(p.lamp_sets[2].temperature_kelvin);
    EXPECT_EQ(p.lamp_sets[1].count, 2);
    EXPECT_EQ(p.lamp_sets[1].power_w, 30.0);
    EXPECT_FALSE(p.lamp_sets[2].power_w);
    EXPECT_THROW((void)read(bytes, diagnostics, {3}), Error);
}

TEST(Eulumdat, SizesAreMillimetres) {
    LdtFile file;
    file.size_mm = {1200, 300, 90, 1100, 250, 10, 20, 10, 20};
    const auto p = read(file.bytes());
    EXPECT_NEAR(p.housing_m->y, 1.2, 1e-9) << "the length lies along C90";
    EXPECT_NEAR(p.housing_m->x, 0.3, 1e-9);
    EXPECT_NEAR(p.housing_m->z, 0.09, 1e-9);
    EXPECT_NEAR(p.opening_m.y, 1.1, 1e-9);
    EXPECT_NEAR(p.opening_m.x, 0.25, 1e-9);
    EXPECT_NEAR(p.opening_m.z, 0.02, 1e-9);
    EXPECT_FALSE(p.round);
    file.size_mm = {120, 0, 90, 100, 0, 0, 0, 0, 0};
    const auto round = read(file.bytes());
    EXPECT_TRUE(round.round);
    EXPECT_NEAR(round.opening_m.x, 0.1, 1e-9);
    EXPECT_NEAR(round.housing_m->x, 0.12, 1e-9);
}

TEST(Eulumdat, DecimalCommasAndEmptyLinesAreRead) {
    LdtFile file;
    file.gammas = {0.0, 22.5, 90.0};
    file.per_klm = [](double, double gamma) { return 100.0 - gamma / 2.0; };
    const auto reference = read(file.bytes());
    auto lines = file.lines();
    std::string loose;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (i == 24) lines[i] = "";  // tilt during measurement
        for (char& c : lines[i])
            if (i > 11 && c == '.') c = ',';
        loose += lines[i] + (i + 1 < lines.size() ? "\n" : "");
    }
    EXPECT_EQ(read(loose).candela, reference.candela);
}

TEST(Eulumdat, AnglesCountWhereTheStepDisagrees) {
    LdtFile file;
    auto lines = file.lines();
    lines[6] = "5";
    std::string bytes;
    for (const std::string& line : lines) bytes += line + "\n";
    Diagnostics diagnostics;
    EXPECT_NEAR(scene::intensity_cd(read(bytes, diagnostics), 0.0, 135.0), 100.0, 1e-6);
    ASSERT_EQ(diagnostics.warnings().size(), 1u);
    EXPECT_NE(diagnostics.warnings().front().text.find("gamma"), std::string::npos);
}

TEST(Eulumdat, AndIesOfOneLuminaireAgree) {
    const Distribution shape = [](double c, double gamma) {
        return 400.0 * std::exp(-gamma / 40.0) * (1.5 + std::cos(c * kDegree) * std::sin(gamma * kDegree));
    };
    LdtFile ldt;
    ldt.symmetry = 0;
    ldt.planes = steps(0, 345, 15);
    ldt.gammas = steps(0, 180, 5);
    ldt.sets = {{1, 2000.0, "3000", 20.0}};
    ldt.per_klm = [&](double c, double gamma) { return shape(c, gamma) / 2.0; };
    IesFile ies;
    ies.vertical = ldt.gammas;
    ies.horizontal = steps(0, 360, 15);
    ies.intensity = shape;
    const auto p = read(ldt.bytes()), q = read(ies.bytes());
    ASSERT_EQ(p.candela.size(), q.candela.size());
    for (std::size_t i = 0; i < p.candela.size(); ++i) ASSERT_NEAR(p.candela[i], q.candela[i], 1e-3);
    EXPECT_NEAR(scene::integrated_lm(p), scene::integrated_lm(q), 1e-3);
}
