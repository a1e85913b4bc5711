// The table of linearly transformed cosines: that the fit in the repository is the fit of this code, and as
// good as it says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "candela/bake/ltc_fit.hpp"
#include "candela/scene/error.hpp"
#include "shading/lights/ltc.glsl"

namespace candela::bake {
namespace {

using shading::uint;

constexpr uint kSize = shading::kLtcSize;

std::size_t at(uint x, uint y) {
    return std::size_t{y} * kSize + x;
}

TEST(LtcTable, AFitStartedAsTheBakeDoesFindsTheStoredEntries) {
    const LtcTable& table = ltc_table();
    for (const uint x : {0u, 20u, 45u, 62u}) {
        for (const uint y : {1u, 20u, 40u, 62u}) {
            const glm::vec2 here = shading::dfg_parameters(x, y);
            const glm::vec2 rougher = shading::dfg_parameters(x, y + 1);
            const LtcEntry entry =
                fit_ltc_entry(here.x, here.y, next_ltc_start(table.texels[at(x, y + 1)], here.y, rougher.y));
            // Another compiler's rounding sends the simplex another way, to the same floor.
            EXPECT_NEAR(entry.error, table.errors[at(x, y)], 2.0e-4f) << x << ' ' << y;
            for (int i = 0; i < 4; ++i)
                EXPECT_NEAR(entry.texel[i], table.texels[at(x, y)][i],
                            0.02f * table.texels[at(x, y)].z + 1.0e-3f)
                    << x << ' ' << y << ' ' << i;
        }
    }
}

TEST(LtcTable, TheStoredErrorIsTheOneOfTheStoredTexel) {
    const LtcTable& table = ltc_table();
    for (uint x = 0; x < kSize - 1; x += 9) {
        for (uint y = 0; y < kSize; y += 9) {
            const glm::vec2 p = shading::dfg_parameters(x, y);
            EXPECT_NEAR(ltc_error(p.x, p.y, table.texels[at(x, y)]), table.errors[at(x, y)], 1.0e-4f)
                << x << ' ' << y;
        }
    }
}

TEST(LtcTable, BetweenItsEntriesTheErrorIsThatOfTheEntries) {
    const LtcTable& table = ltc_table();
    for (uint x = 0; x < kSize - 1; x += 6) {
        for (uint y = 0; y < kSize - 1; y += 6) {
            const float root = (float(x) + 0.5f) / float(kSize - 1);
            const float roughness = (float(y) + 0.5f) / float(kSize - 1);
            const float between = ltc_error(root * root, roughness, table.read(root * root, roughness));
            const float corners = std::max({table.errors[at(x, y)], table.errors[at(x + 1, y)],
                                            table.errors[at(x, y + 1)], table.errors[at(x + 1, y + 1)]});
            EXPECT_LE(between, corners + 0.012f) << x << ' ' << y;
        }
    }
}

TEST(LtcTable, EveryEntryIsAProperTransformAndNoneIsFarOff) {
    const LtcTable& table = ltc_table();
    for (uint y = 0; y < kSize; ++y) {
        for (uint x = 0; x < kSize; ++x) {
            const float NoV = shading::dfg_parameters(x, y).x;
            const glm::vec3 v(-std::sqrt((1.0f - NoV) * (1.0f + NoV)), 0.0f, NoV);
            const shading::LtcFrame frame = shading::ltc_frame(
                shading::ltc_inverse_matrix(table.texels[at(x, y)]), glm::vec3(0.0f, 0.0f, 1.0f), v);
            EXPECT_GT(glm::determinant(frame.to_cosine), 0.0f) << x << ' ' << y;
            EXPECT_GT(frame.horizon.z, 0.0f) << x << ' ' << y;
            // From 80 degrees on the lobe is lopsided; up to there a cosine's image is a good one.
            EXPECT_LE(table.errors[at(x, y)], NoV > 0.17f ? 0.17f : 0.33f) << x << ' ' << y;
        }
    }
}

TEST(LtcTable, ASmoothSurfaceHasTheWidthsOfGgx) {
    // x: foreshortening; z: 2 alpha, of which the lean of the horizon takes its part.
    for (const float NoV : {1.0f, 0.8f, 0.5f}) {
        const glm::vec4 t = ltc_table().read(NoV, std::sqrt(0.02f));
        const float sine2 = 1.0f - NoV * NoV;
        EXPECT_NEAR(t.x, NoV, 0.01f);
        EXPECT_NEAR(t.z * NoV + t.w * sine2, 2.0f * 0.02f * NoV, 0.02f * 2.0f * 0.02f) << NoV;
    }
}

TEST(LtcTable, AFileComesBackAndOthersAreRefused) {
    const LtcTable& table = ltc_table();
    const std::string bytes = encode_ltc_table(table);
    EXPECT_LT(bytes.size(), 200'000u);
    const LtcTable again = decode_ltc_table(bytes, "here");
    EXPECT_EQ(again.texels, table.texels);
    EXPECT_EQ(again.errors, table.errors);
    EXPECT_THROW((void)decode_ltc_table(bytes.substr(0, 100), "cut"), Error);
    EXPECT_THROW((void)decode_ltc_table("", "empty"), Error);
    std::string other_version = bytes;
    other_version[4] = 99;
    EXPECT_THROW((void)decode_ltc_table(other_version, "new"), Error);
}

}  // namespace
}  // namespace candela::bake
