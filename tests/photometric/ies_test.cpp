#include <gtest/gtest.h>

#include <fstream>

#include "common/files.hpp"
#include "read_back.hpp"

using namespace candela;
using namespace candela::test;

namespace {

double at_aim(const IesFile& file) {
    return scene::intensity_cd(read(file.bytes()), 0.0, 0.0);
}

bool warned(const Diagnostics& diagnostics, const std::string& mentions) {
    for (const auto& w : diagnostics.warnings()) {
        if (w.text.find(mentions) != std::string::npos) return true;
    }
    return false;
}

std::string value_of(const scene::PhotometricProfile& p, const std::string& key) {
    for (const auto& [name, value] : p.keywords) {
        if (name == key) return value;
    }
    return "missing";
}

}  // namespace

TEST(Ies, EveryRevisionIsRead) {
    const std::pair<const char*, const char*> revisions[] = {
        {"Any label at all", "LM-63-1986"}, {"IESNA91", "LM-63-1991"},
        {"IESNA:LM-63-1991", "LM-63-1991"}, {"IESNA:LM-63-91", "LM-63-1991"},
        {"IESNA:LM-63-1995", "LM-63-1995"}, {"IESNA:LM-63-2002", "LM-63-2002"},
        {"IES:LM-63-2019", "LM-63-2019"}};
    for (const auto& [line, standard] : revisions) {
        IesFile file;
        file.first_line = line;
        const auto p = read(file.bytes());
        EXPECT_EQ(p.standard, standard);
        EXPECT_EQ(p.name, "Lamp of tests");
        EXPECT_EQ(value_of(p, "MANUFAC"), "Maker");
        EXPECT_NEAR(scene::intensity_cd(p, 0.0, 0.0), 100.0, 1e-9);
    }
    Diagnostics diagnostics;
    IesFile unknown;
    unknown.first_line = "IES:LM-63-2031";
    (void)read(unknown.bytes(), diagnostics);
    EXPECT_TRUE(warned(diagnostics, "2031"));
}

TEST(Ies, LineEndsCommasAndExponentsDoNotMatter) {
    IesFile file;
    file.vertical = {0.0, 45.0, 90.0};
    file.intensity = [](double, double gamma) { return 1000.0 + gamma; };
    const auto reference = read(file.bytes());
    for (const char* end : {"\n", "\r", "\r\n"}) EXPECT_EQ(read(file.bytes(end)).candela, reference.candela);
    std::string loose =
        "IESNA:LM-63-2002\n[TEST] x\nTILT=NONE\n1,-1,1.0,3,1\n1 2 0 0\n0 1 1\n10\n0,45,\n9.0e1\n\n0\n+1000 , "
        "1.045E3\n1090";
    EXPECT_EQ(read(loose).candela, reference.candela);
    EXPECT_EQ(read("\xef\xbb\xbf" + loose + "\n\x1a garbage").candela, reference.candela);
}

TEST(Ies, FactorsMultiply) {
    IesFile file;
    file.multiplier = 2.5;
    file.ballast = 0.9;
    EXPECT_NEAR(at_aim(file), 100.0 * 2.5 * 0.9, 1e-4);
    file.first_line = "IESNA:LM-63-1995";
    file.factor = 0.8;
    EXPECT_NEAR(at_aim(file), 100.0 * 2.5 * 0.9 * 0.8, 1e-4);
    // In 2019 that number says how the file came to be.
    file.first_line = "IES:LM-63-2019";
    file.factor = 1.1;
    EXPECT_NEAR(at_aim(file), 100.0 * 2.5 * 0.9, 1e-4);
    file.first_line = "IESNA:LM-63-2002";
    Diagnostics diagnostics;
    EXPECT_NEAR(scene::intensity_cd(read(file.bytes(), diagnostics), 0.0, 0.0), 100.0 * 2.5 * 0.9, 1e-4);
    EXPECT_TRUE(warned(diagnostics, "reserved"));
}

TEST(Ies, AbsoluteStatesNoLumensAndRelativeThoseOfItsLamps) {
    IesFile file;
    const auto absolute = read(file.bytes());
    EXPECT_TRUE(absolute.absolute);
    EXPECT_FALSE(scene::stated_lm(absolute));
    file.lamps = 2;
    file.lumens = 1350.0;
    file.ballast = 0.5;
    const auto relative = read(file.bytes());
    EXPECT_FALSE(relative.absolute);
    EXPECT_NEAR(*scene::stated_lm(relative), 1350.0, 1e-9) << "two lamps at half their flux";
    EXPECT_EQ(relative.lamp_sets.front().count, 2);
    EXPECT_EQ(relative.lamp_sets.front().power_w, 10.0);
}

TEST(Ies, FeetAndMetresAreTheSameOpening) {
    IesFile feet, metres;
    feet.units = 1;
    feet.size = {1.0, 2.0, 0.5};
    metres.size = {0.3048, 0.6096, 0.1524};
    const auto f = read(feet.bytes()), m = read(metres.bytes());
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(f.opening_m[axis], m.opening_m[axis], 1e-9);
    EXPECT_NEAR(f.opening_m.x, 0.6096, 1e-9) << "the length lies along C0";
    EXPECT_FALSE(f.round);
    EXPECT_EQ(f.candela, m.candela) << "candelas have no feet in them";
    metres.size = {-0.2, 0.0, 0.0};
    const auto old_round = read(metres.bytes());
    EXPECT_TRUE(old_round.round);
    EXPECT_NEAR(old_round.opening_m.x, 0.2, 1e-9);
    EXPECT_NEAR(old_round.opening_m.y, 0.2, 1e-9);
    metres.size = {-0.2, -0.3, 0.1};
    const auto ellipse = read(metres.bytes());
    EXPECT_TRUE(ellipse.round);
    EXPECT_NEAR(ellipse.opening_m.x, 0.3, 1e-9);
    EXPECT_NEAR(ellipse.opening_m.y, 0.2, 1e-9);
}

TEST(Ies, TiltIsIncludedOrInAFileOfTheFolder) {
    const std::string table = "2\r\n3\r\n0 45 90\r\n1.0 0.9 0.7\r\n";
    IesFile file;
    file.tilt = "TILT=INCLUDE\r\n2\r\n3\r\n0 45 90\r\n1.0 0.9 0.7";
    const auto included = read(file.bytes());
    EXPECT_EQ(included.tilt.lamp_to_luminaire_geometry, 2);
    EXPECT_NEAR(scene::tilt_factor(included, 0.0), 1.0, 1e-9);
    EXPECT_NEAR(scene::tilt_factor(included, 67.5), 0.8, 1e-9);
    EXPECT_NEAR(scene::tilt_factor(included, 120.0), 0.7, 1e-9);
    EXPECT_NEAR(scene::intensity_cd(included, 0.0, 0.0), 100.0, 1e-6) << "the web is as measured";
    const TemporaryFolder folder;
    file.tilt = "TILT=lamp.tlt";
    std::ofstream(folder / "lamp.tlt", std::ios::binary) << table;
    std::ofstream(folder / "a.ies", std::ios::binary) << file.bytes();
    Diagnostics diagnostics;
    const auto beside = io::load_photometric(folder / "a.ies", diagnostics);
    EXPECT_EQ(beside.tilt.factors, included.tilt.factors);
    EXPECT_EQ(beside.candela, included.candela);
    EXPECT_EQ(scene::tilt_factor(read(IesFile().bytes()), 50.0), 1.0);
    // An embedded profile has no folder: read without.
    EXPECT_TRUE(read(file.bytes(), diagnostics).tilt.angles_deg.empty());
    EXPECT_TRUE(warned(diagnostics, "TILT"));
}

TEST(Ies, TheFactorOf1991IsAFactor) {
    IesFile file;
    file.first_line = "IESNA:LM-63-1991";
    file.factor = 0.5;
    EXPECT_NEAR(at_aim(file), 50.0, 1e-4);
}

TEST(Ies, ATiltFileThatIsMissingOrBrokenIsAWarning) {
    const TemporaryFolder folder;
    IesFile file;
    file.tilt = "TILT=lamp.tlt";
    std::ofstream(folder / "a.ies", std::ios::binary) << file.bytes();
    for (const std::string table : {"", "no numbers"}) {
        if (!table.empty()) std::ofstream(folder / "lamp.tlt", std::ios::binary) << table;
        Diagnostics diagnostics;
        const auto p = io::load_photometric(folder / "a.ies", diagnostics);
        EXPECT_NEAR(scene::intensity_cd(p, 0.0, 0.0), 100.0, 1e-6);
        EXPECT_TRUE(p.tilt.angles_deg.empty());
        EXPECT_TRUE(warned(diagnostics, "drawn without the TILT file"));
    }
}

TEST(Ies, TiltWithBlanksAndDecimalCommas) {
    const auto reference = read(
        "IESNA:LM-63-2002\n[TEST] x\nTILT=NONE\n1 -1 1.5 3 1 1 2 0.25 0.5 0\n"
        "1 1 10.5\n0 45.5 90\n0\n100.25 50 0.5\n");
    for (const std::string tilt : {"TILT = NONE", "tilt= none", "TILT =NONE"}) {
        Diagnostics diagnostics;
        const auto p = read("IESNA:LM-63-2002\n[TEST] x\n" + tilt +
                                "\n1 -1 1,5 3 1 1 2 0,25 0,5 0\n1 1 10,5\n0 45,5 90\n0\n100,25 50 0,5\n",
                            diagnostics);
        EXPECT_EQ(p.candela, reference.candela);
        EXPECT_EQ(p.opening_m, reference.opening_m);
        EXPECT_TRUE(warned(diagnostics, "decimal comma"));
        EXPECT_TRUE(warned(diagnostics, "TILT"));
    }
    // The same commas as separators: three intensities of "100,50,25" are no decimals.
    Diagnostics diagnostics;
    const auto separated = read(
        "IESNA:LM-63-2002\nTILT=NONE\n1,-1,1,3,1,1,2,0,0,0\n1,1,10\n0,45,90\n0\n"
        "100,50,25\n",
        diagnostics);
    EXPECT_NEAR(scene::intensity_cd(separated, 0.0, 0.0), 100.0, 1e-6);
    EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(Ies, KeywordsGoOnWithMore) {
    IesFile file;
    file.labels = {"[test] T1", "[LUMINAIRE] First", "[MORE] second", "[LAMP] LED 2700K module", "free text"};
    const auto p = read(file.bytes());
    EXPECT_EQ(value_of(p, "TEST"), "T1") << "keywords in any case";
    EXPECT_EQ(value_of(p, "LUMINAIRE"), "First\nsecond");
    EXPECT_EQ(p.name, "First");
    EXPECT_EQ(p.lamp_sets.front().temperature_kelvin, 2700.0);
}

TEST(Ies, ColourTemperatureOnlyWhereItIsOne) {
    const auto kelvin = [](const std::string& label) {
        IesFile file;
        file.labels = {label};
        return read(file.bytes()).lamp_sets.front().temperature_kelvin;
    };
    EXPECT_EQ(kelvin("[_CCT] 3500"), 3500.0);
    EXPECT_EQ(kelvin("[COLORTEMP] 4000 K"), 4000.0);
    EXPECT_EQ(kelvin("[LUMINAIRE] Downlight 3000K 10W"), 3000.0);
    EXPECT_FALSE(kelvin("[LUMCAT] K4000-20"));
    EXPECT_FALSE(kelvin("[LAMP] 1200 lm"));
}

TEST(Ies, OldTextIsLatin1) {
    IesFile file;
    file.labels = {"[LUMINAIRE] M\xfcller 30\xb0"};
    EXPECT_EQ(read(file.bytes()).name, "M\u00fcller 30\u00b0");
    file.labels = {"[LUMINAIRE] M\u00fcller"};
    EXPECT_EQ(read(file.bytes()).name, "M\u00fcller");
}

TEST(Ies, WhatCanBeRepairedIsAWarning) {
    Diagnostics diagnostics;
    IesFile file;
    file.intensity = [](double, double gamma) { return gamma > 100.0 ? -0.1 : 100.0; };
    EXPECT_EQ(scene::intensity_cd(read(file.bytes(), diagnostics), 0.0, 180.0), 0.0);
    EXPECT_TRUE(warned(diagnostics, "negative"));
    (void)read(IesFile().bytes() + "17 18", diagnostics);
    EXPECT_TRUE(warned(diagnostics, "more numbers"));
    file = {};
    file.horizontal = {0.0, 90.0, 181.0};
    (void)read(file.bytes(), diagnostics);
    EXPECT_TRUE(warned(diagnostics, "no half-planes between C = 181 and 360"));
    file = {};
    file.vertical = {0.0, 60.0};
    EXPECT_EQ(scene::intensity_cd(read(file.bytes(), diagnostics), 0.0, 61.0), 0.0);
    EXPECT_TRUE(warned(diagnostics, "from 0 to 60"));
}
