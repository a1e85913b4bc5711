// `candela meter`: what it reads against light that is known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "process.hpp"

namespace {

using candela::test::Outcome;
using candela::test::run_candela;
using candela::test::spit;
using candela::test::TemporaryFolder;

constexpr double kPi = 3.14159265358979;

/// A bulb at the origin, with nothing around it.
std::string bulb(double intensity_cd) {
    return R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": )" +
           std::to_string(intensity_cd) + R"(}]}},
        "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}]})";
}

double reading(const std::string& arguments, const std::string& key) {
    const Outcome o = run_candela("meter " + arguments + " --json");
    EXPECT_EQ(o.exit_code, 0) << o.err;
    return nlohmann::json::parse(o.out).value(key, -1.0);
}

/// Frostbite Table 10, the rows "Frostbite": computed values in lx at 1 m, 50, 25, 10 and 5.5 cm.
TEST(Meter, ReadsTable10OfFrostbite) {
    const TemporaryFolder folder;
    struct Bulb {
        double power_lm;
        double printed_lx[5];
    };
    const double distances_m[5] = {1.0, 0.5, 0.25, 0.1, 0.055};
    for (const Bulb& b :
         {Bulb{625.0, {50, 199, 796, 4973, 16441}}, Bulb{1200.0, {95, 382, 1528, 9549, 31568}}}) {
        const std::string file = folder / "bulb.gltf";
        spit(file, bulb(b.power_lm / (4.0 * kPi)));
        for (int i = 0; i < 5; ++i) {
            const std::string at = " --at 0,-" + std::to_string(distances_m[i]) + ",0";
            const double lx = reading(file + at + " --spp 1", "illuminance_lx");
            // The card lies two tenths of a millimetre nearer than asked for.
            const double nearer = std::pow(distances_m[i] / (distances_m[i] - 2e-4), 2.0);
            EXPECT_NEAR(lx, nearer * b.power_lm / (4.0 * kPi * distances_m[i] * distances_m[i]), 1e-3 * lx);
            EXPECT_NEAR(lx / nearer, b.printed_lx[i], 1.0 + 1e-3 * lx) << b.power_lm << " lm, " << at;
        }
    }
}

TEST(Meter, AllModesReadTheSame) {
    const TemporaryFolder folder;
    const std::string file = folder / "bulb.gltf";
    spit(file, bulb(100.0));
    // 60 degrees off: half of 25 lx.
    const std::string at = file + " --at 0,-2,0 --normal 0.8660254,0.5,0 --mode ";
    for (const char* mode : {"path", "integrate", "realtime"})
        EXPECT_NEAR(reading(at + mode, "illuminance_lx"), 12.5, 0.02) << mode;
}

TEST(Meter, AUniformSkyIsPiTimesItsLuminanceOnACardAndItselfInASpotMeter) {
    const TemporaryFolder folder;
    const std::string file = folder / "nothing.gltf";
    spit(file, R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{}]})");
    const std::string environment = folder / "grey.hdr";
    std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n";
    for (int i = 0; i < 32; ++i) hdr += std::string("\x80\x80\x80\x84", 4);  // 128 / 256 * 2^4 = 8
    spit(environment, hdr);
    const std::string scene = file + " --env " + environment;
    for (const char* mode : {"path", "realtime"}) {
        const std::string as = std::string(" --mode ") + mode;
        EXPECT_NEAR(reading(scene + " --at 1,2,3" + as, "illuminance_lx"), 8.0 * kPi, 0.1) << mode;
        EXPECT_NEAR(reading(scene + " --from 0,0,0 --towards 1,0.2,0" + as, "luminance_nit"), 8.0, 0.02)
            << mode;
        EXPECT_NEAR(reading(scene + " --size 64x48 --pixel 63,0" + as, "luminance_nit"), 8.0, 0.02) << mode;
    }
    EXPECT_NEAR(reading(scene + " --from 0,0,0 --towards 1,0.2,0", "ev100"), std::log2(8.0 * 8.0), 0.01);
}

TEST(Meter, SaysInOneLineWhatIsWrong) {
    const TemporaryFolder folder;
    const std::string file = folder / "bulb.gltf";
    spit(file, bulb(1.0));
    for (const char* arguments : {"", "--at 0,0,0 --pixel 1,1", "--at 0,0,nan", "--at 0,0,0 --normal 0,0,0",
                                  "--from 0,0,0", "--from 0,0,0 --towards 0,0,0", "--size 8x8 --pixel 8,0",
                                  "--at 0,0,0 --mode realtime --direct-only", "--normal 0,1,0 --pixel 0,0"}) {
        const Outcome o = run_candela("meter " + file + " " + arguments);
        EXPECT_EQ(o.exit_code, 2) << arguments << ": " << o.err;
        EXPECT_EQ(candela::test::lines(o.err), 1u) << arguments << ": " << o.err;
    }
}

}  // namespace
