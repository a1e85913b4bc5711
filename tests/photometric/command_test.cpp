#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "candela/io/image_read.hpp"
#include "cli/process.hpp"
#include "photometric_files.hpp"
#include "source_folder.hpp"

using namespace candela::test;

namespace {

std::string written(const TemporaryFolder& folder, const std::string& name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
}

IesFile downlight() {
    IesFile file;
    file.labels = {"[LUMINAIRE] Spot <A> & Co", "[LAMP] LED 3000K"};
    file.vertical = steps(0, 90, 5);
    file.intensity = [](double, double gamma) { return 1000.0 * std::pow(std::cos(gamma * kDegree), 4.0); };
    file.size = {-0.1, 0.0, 0.0};
    return file;
}

nlohmann::json light_json(const std::string& arguments) {
    const Outcome run = run_candela("light --json " + arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    return nlohmann::json::parse(run.out, nullptr, false);
}

/// Ink of a colour near (r, g, b) in a rectangle of the picture.
int ink(const candela::scene::Image& image, std::uint32_t left, std::uint32_t top, std::uint32_t right,
        std::uint32_t bottom, int r, int g, int b) {
    int count = 0;
    for (std::uint32_t y = top; y < bottom; ++y) {
        for (std::uint32_t x = left; x < right; ++x) {
            const auto* p = &image.rgba[4 * (std::size_t{y} * image.width + x)];
            count += std::abs(p[0] - r) < 12 && std::abs(p[1] - g) < 12 && std::abs(p[2] - b) < 12;
        }
    }
    return count;
}

}  // namespace

TEST(LightCommand, JsonSaysWhatTheFileHolds) {
    const TemporaryFolder folder;
    const auto j = light_json(written(folder, "a.ies", downlight().bytes()));
    EXPECT_NEAR(j["integrated_lm"].get<double>(), 2.0 * std::numbers::pi * 1000.0 / 5.0, 5.0);
    EXPECT_TRUE(j["stated_lm"].is_null());
    EXPECT_NEAR(j["peak"]["intensity_cd"].get<double>(), 1000.0, 1e-3);
    EXPECT_EQ(j["peak"]["gamma_deg"], 0.0);
    EXPECT_NEAR(j["beam_angle"]["c0_c180_deg"].get<double>(), 2.0 * std::acos(std::pow(0.5, 0.25)) / kDegree,
                0.2);
    // Chords of 5 degrees lie off the curve by a quarter of one there.
    EXPECT_NEAR(j["field_angle"]["c90_c270_deg"].get<double>(),
                2.0 * std::acos(std::pow(0.1, 0.25)) / kDegree, 0.5);
    EXPECT_EQ(j["symmetry"], "about the vertical axis");
    EXPECT_EQ(j["lamp_sets"][0]["color_temperature_kelvin"], 3000.0);
    EXPECT_NEAR(j["opening"]["along_c0_m"].get<double>(), 0.1, 1e-9);
    EXPECT_EQ(j["round"], true);
    EXPECT_EQ(j["warnings"].size(), 0u);
    EXPECT_EQ(j["keywords"][0]["value"], "Spot <A> & Co");
}

TEST(LightCommand, WarnsWhereLumensDisagreeByMoreThanTwoPercent) {
    const TemporaryFolder folder;
    LdtFile file;
    const double isotropic = 1000.0 / (4.0 * std::numbers::pi);
    for (const auto& [scale, warns] :
         {std::pair{1.0, false}, {1.015, false}, {0.985, false}, {1.03, true}, {0.9, true}}) {
        file.per_klm = [&, s = scale](double, double) { return s * isotropic; };
        const auto j = light_json(written(folder, "a.ldt", file.bytes()));
        EXPECT_EQ(j["warnings"].size(), warns ? 1u : 0u) << scale;
    }
    IesFile ies = downlight();
    ies.lumens = 2000.0;
    const Outcome run = run_candela("light " + written(folder, "b.ies", ies.bytes()));
    EXPECT_NE(run.out.find("2000 lm stated"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("warning"), std::string::npos) << run.out;
}

TEST(LightCommand, ChoosesAmongLampSets) {
    const TemporaryFolder folder;
    LdtFile file;
    file.sets = {{1, 1000.0, "3000", 10.0}, {1, 2000.0, "4000", 20.0}};
    const std::string path = written(folder, "a.ldt", file.bytes());
    EXPECT_NEAR(light_json(path + " --lamps 2")["peak"]["intensity_cd"].get<double>(), 200.0, 1e-3);
    EXPECT_EQ(run_candela("light " + path + " --lamps 3").exit_code, 1);
    EXPECT_EQ(run_candela("light " + path + " --lamps 0").exit_code, 2);
}

TEST(LightCommand, PlotsTheCurveWhereItIs) {
    const TemporaryFolder folder;
    IesFile file = downlight();
    file.horizontal = {0, 90, 180, 270, 360};
    // Towards C0 only, and a little to C90: orange on the right, none on the left.
    file.intensity = [](double c, double gamma) {
        if (gamma == 0.0) return 100.0;
        return std::fmod(c, 360.0) == 0.0 ? 1000.0 : c == 90.0 ? 400.0 : 0.0;
    };
    const std::string path = written(folder, "a.ies", file.bytes());
    ASSERT_EQ(run_candela("light " + path + " --plot " + (folder / "p.png")).exit_code, 0);
    const auto image = candela::io::decode_image(candela::io::read_file(folder / "p.png", 1u << 24), "p.png");
    const std::uint32_t middle = image.width / 2, legend = image.height - 140;
    EXPECT_GT(ink(image, middle + 20, 0, image.width, legend, 0xd5, 0x5e, 0x00), 500);
    EXPECT_EQ(ink(image, 0, 0, middle - 20, legend, 0xd5, 0x5e, 0x00), 0);
    EXPECT_GT(ink(image, middle + 20, 0, image.width, legend, 0x00, 0x72, 0xb2), 200);
    EXPECT_LT(image.height, image.width) << "no light above the horizon: half a circle";
    ASSERT_EQ(run_candela("light " + path + " --plot " + (folder / "p.svg")).exit_code, 0);
    const std::string svg = slurp(folder / "p.svg");
    EXPECT_NE(svg.find("Spot &lt;A&gt; &amp; Co"), std::string::npos);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
    EXPECT_EQ(run_candela("light " + path + " --plot " + (folder / "p.bmp")).exit_code, 2);
    EXPECT_EQ(run_candela("light " + path + " --plot " + (folder / "no/p.png")).exit_code, 1);
}

TEST(LightCommand, AMissingFileIsOneLine) {
    const Outcome run = run_candela("light no/such.ies");
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(lines(run.err), 1u);
    EXPECT_NE(run.err.find("no/such.ies"), std::string::npos);
}

TEST(LightCommand, ADarkFileIsNoError) {
    const TemporaryFolder folder;
    IesFile file;
    file.intensity = [](double, double) { return 0.0; };
    const auto j = light_json(written(folder, "a.ies", file.bytes()) + " --plot " + (folder / "p.svg"));
    EXPECT_EQ(j["integrated_lm"], 0.0);
    EXPECT_TRUE(j["beam_angle"]["c0_c180_deg"].is_null());
}

/// What others wrote: read without error, and with the facts that their names promise.
TEST(LightCommand, ReadsTheFilesOfOthers) {
    const std::filesystem::path folder = CANDELA_SOURCE_DIR "/../shared/data/photometry";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "shared data is not here";
    const auto of = [&](const char* name) { return light_json((folder / name).string()); };
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const auto j = light_json(entry.path().string());
        EXPECT_GT(j["integrated_lm"].get<double>(), 0.0) << entry.path();
    }
    EXPECT_EQ(of("absolute_photometry.ies")["photometry"], "absolute");
    EXPECT_NEAR(of("absolute_photometry.ies")["peak"]["intensity_cd"].get<double>(), 2200.0, 1e-3);
    EXPECT_NEAR(of("imperial_units.ies")["opening"]["along_c90_m"].get<double>(), 0.12 * 0.3048, 1e-9);
    EXPECT_EQ(of("round_opening.ies")["round"], true);
    const auto multiplied = of("relative_photometry_with_multiplier.ies");
    EXPECT_EQ(multiplied["photometry"], "relative");
    EXPECT_NEAR(multiplied["peak"]["intensity_cd"].get<double>(), 3300.0, 1e-3);
    EXPECT_EQ(of("multiple_lamp_sets.ldt")["lamp_sets"].size(), 3u);
    EXPECT_NEAR(of("absolute.ldt")["peak"]["intensity_cd"].get<double>(), 1100.0, 1e-3) << "cd/klm of 500 lm";
    EXPECT_EQ(of("no_symmetry.ldt")["symmetry"], "none");
    EXPECT_EQ(of("symmetry_to_c0c180.ldt")["symmetry"], "to plane C0-C180");
    EXPECT_EQ(of("symmetry_to_c90c270.ldt")["symmetry"], "to plane C90-C270");
    EXPECT_EQ(of("symmetry_about_vertical_axis.ldt")["symmetry"], "about the vertical axis");
    // One web, as IES and as EULUMDAT of 1000 lm.
    EXPECT_NEAR(of("symmetry_about_vertical_axis.ldt")["integrated_lm"].get<double>(),
                of("absolute_photometry.ies")["integrated_lm"].get<double>(), 1e-3);
    for (const auto& keyword : of("label_lines.ies")["keywords"]) {
        if (keyword["key"] == "MULTILINE") {
            EXPECT_EQ(lines(keyword["value"].get<std::string>()), 2u) << "three lines";
        }
    }
}
