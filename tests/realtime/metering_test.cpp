#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "candela/realtime/exposure_meter.hpp"
#include "candela/realtime/profile.hpp"
#include "candela/scene/error.hpp"
#include "shading/exposure.glsl"

using namespace candela;
using namespace candela::realtime;

namespace {

/// A picture in which each luminance in cd/m^2 covers a fraction; the fractions sum to 1.
std::vector<glm::vec4> picture(const std::vector<std::pair<float, float>>& nit_and_fraction) {
    std::vector<glm::vec4> out;
    for (const auto& [nit, fraction] : nit_and_fraction)
        out.insert(out.end(), static_cast<std::size_t>(std::lround(10000.0f * fraction)),
                   glm::vec4(nit, nit, nit, 1.0f));
    return out;
}

/// What a part of the picture comes out as, 1 = white.
float exposed(float nit, const std::vector<glm::vec4>& picture) {
    return nit * shading::standard_output_exposure(*metered_ev100(std::span<const glm::vec4>(picture)));
}

}  // namespace

TEST(Metering, AUniformPictureIsGreyWhateverItsLuminance) {
    for (const float nit : {1e-12f, 1e-4f, 0.0123f, 1.0f, 777.0f, 1.6e9f})
        EXPECT_NEAR(exposed(nit, picture({{nit, 1.0f}})), 0.18f, 0.003f) << nit;
    EXPECT_FALSE(metered_ev100(std::span<const glm::vec4>(picture({{0.0f, 1.0f}}))));
}

TEST(Metering, TheFaintRestDoesNotCount) {
    for (const float pool : {0.02f, 0.1f, 0.5f}) {
        for (const float floor_nit : {0.0f, 1e-9f, 1e-5f, 1e-3f})
            EXPECT_NEAR(exposed(10.0f, picture({{10.0f, pool}, {floor_nit, 1.0f - pool}})), 0.18f, 0.01f)
                << pool << " of the picture is lit, the rest has " << floor_nit << " cd/m2";
    }
}

TEST(Metering, SmallHighlightsDoNotCount) {
    // A lamp, the sun's disc, a window of 15 % behind a room.
    EXPECT_NEAR(exposed(10.0f, picture({{10.0f, 0.995f}, {1e5f, 0.005f}})), 0.18f, 0.01f);
    EXPECT_NEAR(exposed(3000.0f, picture({{3000.0f, 0.9999f}, {1.6e9f, 0.0001f}})), 0.18f, 0.01f);
    const float room = exposed(30.0f, picture({{30.0f, 0.85f}, {3000.0f, 0.15f}}));
    EXPECT_GT(room, 0.08f) << "not for the window alone";
    EXPECT_LT(room, 0.18f);
}

TEST(Metering, WhatIsUnlitIsNotMetered) {
    std::vector<glm::vec4> p = picture({{10.0f, 0.3f}});
    std::vector<glm::vec4> unlit(7000, glm::vec4(5e4f, 5e4f, 5e4f, 0.0f));
    p.insert(p.end(), unlit.begin(), unlit.end());
    EXPECT_NEAR(exposed(10.0f, p), 0.18f, 0.003f);
}

TEST(Metering, AnyFirstGuessWillDo) {
    // As the frame does: what is outside half floats at an exposure is black or clipped there.
    for (const float guess : {-60.0f, -10.0f, 0.0f, 15.0f, 60.0f}) {
        std::array<std::uint32_t, kMeterBins> bins{};
        const auto take = [&](float units_per_nit) -> std::span<const std::uint32_t> {
            bins.fill(0);
            const float units = std::min(0.02f * units_per_nit, 65504.0f);
            if (units < std::exp2(-24.0f)) return bins;
            const float bin = (std::log2(units) - kMeterFirstStop) * kMeterBinsPerStop;
            bins[static_cast<std::size_t>(std::min(bin, float(kMeterBins - 1)))] = 100;
            return bins;
        };
        const std::optional<float> ev100 = meter_ev100(guess, take);
        ASSERT_TRUE(ev100) << guess;
        EXPECT_NEAR(*ev100, shading::ev100_from_luminance(0.02f), 0.03f) << guess;
    }
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

TEST(Profile, TheOffsetOfEquation9IsAParameter) {
    Profile p = profile_by_name("ue4");
    EXPECT_NE(describe(p).find("falloff=inverse-square-offset"), std::string::npos);
    EXPECT_NE(describe(p).find("falloff-offset-m2=0.0001"), std::string::npos) << "1 cm^2";
    set_parameter(p, "falloff-offset-m2", 1.0, "here");
    EXPECT_EQ(p.falloff_offset_m2, 1.0f);
    EXPECT_NE(describe(p).find("falloff-offset-m2=1"), std::string::npos);
    for (const double wrong : {-1.0, 1.0e7, std::nan("")})
        EXPECT_THROW(set_parameter(p, "falloff-offset-m2", wrong, "here"), Error) << wrong;
    EXPECT_THROW(set_parameter(p, "diffuse", 1.0, "here"), Error);
    EXPECT_EQ(describe(profile_by_name("best")).find("falloff-offset-m2"), std::string::npos);
}
