#include "candela/realtime/metering.hpp"

#include <gtest/gtest.h>

#include <array>

#include "candela/realtime/profile.hpp"
#include "candela/scene/error.hpp"

using namespace candela;
using namespace candela::realtime;

TEST(Metering, AveragesBetweenItsFractions) {
    std::array<std::uint32_t, MeteringPass::kBins> bins{};
    float stops = 0.0f;
    EXPECT_FALSE(average_log2_luminance(bins, 0.1, 0.9, stops)) << "nothing was metered";
    bins[128] = 80;  // 0 stops
    bins[0] = 10;    // -16 stops: the darkest tenth
    bins[255] = 10;  // +16 stops: the brightest tenth
    ASSERT_TRUE(average_log2_luminance(bins, 0.1, 0.9, stops));
    EXPECT_NEAR(stops, 0.0625f, 1e-4f) << "the centre of bin 128";
    ASSERT_TRUE(average_log2_luminance(bins, 0.0, 1.0, stops));
    EXPECT_NEAR(stops, 0.0625f * 0.8f + 0.1f * (-15.9375f) + 0.1f * 15.9375f, 1e-3f);
}

TEST(Profile, NamesAndTechniquesAreCheckedAndListed) {
    EXPECT_EQ(profile_by_name("ue4").visibility, VisibilityTechnique::schlick_smith);
    Profile p = profile_by_name("best");
    set_technique(p, "diffuse", "disney", "here");
    EXPECT_EQ(p.diffuse, DiffuseTechnique::disney);
    try {
        set_technique(p, "diffuse", "phong", "profile.json: /diffuse");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(error.line().find("disney-renormalized"), std::string::npos) << error.line();
        EXPECT_NE(error.line().find("/diffuse"), std::string::npos);
    }
    EXPECT_THROW((void)profile_by_name("phong"), Error);
}
