#include <gtest/gtest.h>

#include "gltf/limited_run.hpp"
#include "photometric_files.hpp"

using namespace candela::test;

namespace {

/// A file that is no photometric file, and what its one line of error says, line number included.
struct Malformed {
    const char* name;
    std::string bytes;
    std::string mentions;
    const char* extension = "ies";
};
void PrintTo(const Malformed& m, std::ostream* out) {
    *out << m.name;
}

/// Line `number` (from 1) of a good IES file replaced.
Malformed ies(const char* name, std::size_t number, const std::string& line, const std::string& mentions) {
    std::istringstream in(IesFile().bytes("\n"));
    std::string out;
    std::size_t at = 0;
    for (std::string old; std::getline(in, old);) out += (++at == number ? line : old) + "\n";
    return {name, out, mentions};
}

Malformed ldt(const char* name, std::size_t number, const std::string& line, const std::string& mentions) {
    std::vector<std::string> lines = LdtFile().lines();
    lines[number - 1] = line;
    std::string out;
    for (const std::string& l : lines) out += l + "\n";
    return {name, out, mentions, "ldt"};
}

Malformed cut(const char* name, std::size_t lines_kept, const std::string& mentions) {
    const std::vector<std::string> lines = LdtFile().lines();
    std::string out;
    for (std::size_t i = 0; i < lines_kept; ++i) out += lines[i] + "\n";
    return {name, out, mentions, "ldt"};
}

std::string with_angles(const std::vector<double>& vertical, const std::vector<double>& horizontal,
                        int type = 1) {
    IesFile file;
    file.type = type;
    file.vertical = vertical;
    file.horizontal = horizontal;
    return file.bytes("\n");
}

std::vector<Malformed> ies_files() {
    // 1 IESNA, 2-4 labels, 5 TILT, 6 header, 7 ballast, 8 vertical, 9 horizontal, 10 intensities.
    const std::string good = IesFile().bytes("\n");
    const std::string names_file = "TILT=" + std::string("../../etc/passwd");
    return {
        {"IesEmpty", "", "the file is empty"},
        {"IesBinary", std::string("\x7f\x45\x4c\x46\0\0\0\xff\xfe", 9), "not a photometric file"},
        {"IesNoTilt", "IESNA:LM-63-2002\n[TEST] x\n", ":2"},
        {"IesEndsAfterTilt", "IESNA:LM-63-2002\nTILT=NONE\n", ":2"},
        {"IesCutInTheWeb", good.substr(0, good.size() - 8), ":10"},
        ies("IesWordForNumber", 10, "100 abc 100", ":10: \"abc\" is no number"),
        ies("IesNotANumber", 10, "100 nan 100", ":10"),
        ies("IesInfinity", 10, "100 inf 100", ":10"),
        ies("IesOverflow", 10, "100 1e999 100", ":10"),
        ies("IesTooBright", 10, "100 1e30 100", ":10: an intensity is beyond all measure"),
        ies("IesTypeFour", 6, "1 -1 1 3 1 4 2 0 0 0", ":6: the photometric type"),
        ies("IesUnitsThree", 6, "1 -1 1 3 1 1 3 0 0 0", ":6: the unit of length"),
        ies("IesNoVerticalAngles", 6, "1 -1 1 0 1 1 2 0 0 0", ":6: the number of vertical angles"),
        ies("IesHalfAnAngle", 6, "1 -1 1 2.5 1 1 2 0 0 0", ":6: the number of vertical angles"),
        ies("IesNegativeCount", 6, "1 -1 1 -3 1 1 2 0 0 0", ":6"),
        ies("IesBillions", 6, "1 -1 1 4000000000 4000000000 1 2 0 0 0", ":6: the number of vertical angles"),
        ies("IesMillions", 6, "1 -1 1 7000 7000 1 2 0 0 0", ":7: the file is too short"),
        ies("IesMultiplierZero", 6, "1 -1 0 3 1 1 2 0 0 0", ":6: the candela multiplier must be positive"),
        ies("IesMultiplierNegative", 6, "1 -1 -2 3 1 1 2 0 0 0", ":6: the candela multiplier"),
        ies("IesBallastZero", 7, "0 1 10", ":7: the ballast factor must be positive"),
        ies("IesVerticalDescends", 8, "0 180 90", ":8: vertical angles must ascend"),
        ies("IesVerticalTwice", 8, "0 90 90", ":8: vertical angles must ascend"),
        ies("IesVerticalBeyond", 8, "0 90 200", ":9: vertical angles from 0 to 200 leave type C"),
        ies("IesTiltNothing", 5, "TILT=", ":5: nothing after TILT="),
        ies("IesTiltOutside", 5, names_file, ":5: path leaves the folder"),
        ies("IesTiltAbsolute", 5, "TILT=/etc/passwd", ":5: absolute path"),
        ies("IesTiltGeometry", 5, "TILT=INCLUDE\n7\n2\n0 90\n1 1", ":6: the lamp-to-luminaire geometry"),
        ies("IesTiltCount", 5, "TILT=INCLUDE\n1\n99999999\n0 90\n1 1", ":7: the number of tilt angles"),
        ies("IesTiltNegative", 5, "TILT=INCLUDE\n1\n2\n0 90\n1 -1", ":9: a tilt factor is negative"),
        {"IesHorizontalOdd", with_angles({0, 90}, {0, 30, 60}),
         ":9: horizontal angles from 0 to 60 are no range of type C"},
        {"IesHorizontalLate", with_angles({0, 90}, {10, 190, 360}), ":9: horizontal angles from 10 to 360"},
        {"IesTypeBOneAngle", with_angles({0, 90}, {0}, 2), ":9: types A and B need at least two angles"},
        {"IesTypeBBeyond", with_angles({-200, 0, 200}, {-90, 0, 90}, 2),
         ":9: angles of types A and B are between -180 and 180"},
    };
}

std::vector<Malformed> eulumdat_files() {
    return {
        {"LdtEmpty", "", "the file is empty", "ldt"},
        {"LdtProse", "To be, or\nnot to be\nthat is\nthe question\n", ":2", "ldt"},
        cut("LdtCutInTheHeader", 20, ":20"),
        cut("LdtCutInTheLamps", 28, ":28"),
        cut("LdtCutInTheWeb", LdtFile().lines().size() - 1, "ends before"),
        ldt("LdtSymmetryFive", 3, "5", ":3: the symmetry indicator"),
        ldt("LdtSymmetryOfOnePlane", 3, "4", ":42: 1 C-planes have no symmetry 4"),
        ldt("LdtNoPlanes", 4, "0", ":4: the number of C-planes"),
        ldt("LdtBillionPlanes", 4, "4000000000", ":4: the number of C-planes"),
        ldt("LdtManyPlanes", 4, "7200", ":42: the file is too short"),
        ldt("LdtNegativeGammas", 6, "-19", ":6"),
        ldt("LdtWord", 13, "wide", ":13: no number for the length"),
        ldt("LdtFactorNegative", 24, "-1", ":24: the conversion factor"),
        ldt("LdtNoLamps", 26, "0", ":26: the number of lamp sets"),
        ldt("LdtManyLamps", 26, "1000000", ":26: the number of lamp sets"),
        ldt("LdtHalfALamp", 27, "0.5", ":27: the number of lamps"),
        ldt("LdtFluxWord", 29, "many", ":29: no number for the flux"),
        ldt("LdtFluxNegative", 29, "-500", ":29: the flux of the lamps"),
        ldt("LdtGammaDescends", 46, "-5", ":46: gamma angles must ascend"),
        ldt("LdtIntensityWord", 48, "x", ":48: no number for an intensity"),
    };
}

std::vector<Malformed> all() {
    std::vector<Malformed> out = ies_files();
    for (const Malformed& m : eulumdat_files()) out.push_back(m);
    return out;
}

class MalformedPhotometry : public testing::TestWithParam<Malformed> {};

}  // namespace

TEST_P(MalformedPhotometry, IsOneClearLine) {
    const TemporaryFolder folder;
    const std::string file = folder / (std::string("bad.") + GetParam().extension);
    write(file, GetParam().bytes);
    const Outcome outcome = within_limits("light", file);
    expect_one_clear_line(outcome, GetParam().mentions);
    EXPECT_NE(outcome.err.find(folder.path().string()), std::string::npos) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(Files, MalformedPhotometry, testing::ValuesIn(all()),
                         [](const auto& test) { return std::string(test.param.name); });
