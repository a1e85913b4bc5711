#include "candela/measure/verdict.hpp"

#include <gtest/gtest.h>

#include "test_pictures.hpp"

namespace candela::measure {
namespace {

using test::draw;

Picture grey(float nit) {
    return draw(8, 4, [&](int, int) { return glm::vec3(nit); });
}

LightPaths paths(float direct_diffuse, float direct_specular, float indirect, float unshadowed) {
    return {grey(direct_diffuse),
            grey(direct_specular),
            grey(indirect),
            grey(0.0f),
            grey(1.0f),
            grey(unshadowed),
            {}};
}

TEST(LightPaths, TheErrorIsSplitWithoutRemainder) {
    const LightPaths r = paths(10.0f, 4.0f, 5.0f, 20.0f);
    const LightPaths x = paths(12.0f, 4.0f, 2.0f, 21.0f);
    const std::vector<PathError> rows = split_error(x, r);
    ASSERT_EQ(rows.size(), 6u);
    EXPECT_NEAR(rows[0].share, 0.4, 1e-6);
    EXPECT_NEAR(rows[1].share, 0.0, 1e-6);
    EXPECT_NEAR(rows[2].share, 0.6, 1e-6);
    EXPECT_NEAR(rows[2].picture_mean_nit, 2.0, 1e-5);
    EXPECT_NEAR(rows[2].reference_mean_nit, 5.0, 1e-5);
    // 6 cd/m2 in shadow in the reference, 5 in the picture.
    EXPECT_EQ(rows[5].path, "shadows (in direct)");
    EXPECT_NEAR(rows[5].reference_mean_nit, 6.0, 1e-5);
    EXPECT_NEAR(rows[5].picture_mean_nit, 5.0, 1e-5);
    EXPECT_NEAR(rows[5].mean_absolute_nit, 1.0, 1e-5);
    double sum = 0.0;
    for (const PathError& row : rows) sum += row.share;
    EXPECT_NEAR(sum, 1.0, 1e-9);
}

TEST(LightPaths, OcclusionIsARowWhereBothSidesKnowIt) {
    LightPaths r = paths(10.0f, 4.0f, 5.0f, 20.0f);
    LightPaths x = paths(10.0f, 4.0f, 8.0f, 20.0f);
    r.occluded_environment = grey(3.0f);
    EXPECT_EQ(split_error(x, r).size(), 6u);
    x.occluded_environment = grey(0.0f);
    const std::vector<PathError> rows = split_error(x, r);
    ASSERT_EQ(rows.size(), 7u);
    EXPECT_EQ(rows[6].path, "occlusion (in environment)");
    EXPECT_NEAR(rows[6].reference_mean_nit, 3.0, 1e-5);
    EXPECT_NEAR(rows[6].picture_mean_nit, 0.0, 1e-5);
    EXPECT_NEAR(rows[6].mean_absolute_nit, 3.0, 1e-5);
    // Its light is missing, or too much, in the row of the environment already.
    EXPECT_EQ(rows[6].share, 0.0);
    EXPECT_NEAR(rows[2].share, 1.0, 1e-6);
}

TEST(Verdict, NoiseIsNotReadAsError) {
    VerdictInput in{"realtime", "path", {}, Metrics{}, 1.0, {}};
    in.metrics.flip = 0.06;
    in.noise->flip = 0.055;
    EXPECT_NE(verdict(in).find("cannot be told from path within its noise: mean FLIP 0.060, where path's own "
                               "noise makes 0.055; it is as bright."),
              std::string::npos)
        << verdict(in);
    in.noise->flip = 0.01;
    EXPECT_NE(verdict(in).find("is visibly different from path"), std::string::npos) << verdict(in);
}

TEST(Verdict, SaysHowMuchAndWhere) {
    const LightPaths r = paths(10.0f, 4.0f, 5.0f, 20.0f);
    const std::vector<PathError> rows = split_error(paths(10.0f, 4.0f, 2.0f, 20.0f), r);
    VerdictInput in{"realtime", "path", {}, {}, 0.85, rows};
    in.metrics.flip = 0.2;
    EXPECT_EQ(verdict(in),
              "realtime is clearly different from path: mean FLIP 0.200; it is 15.0 % darker on average. "
              "Most of the "
              "difference is in environment and indirect diffuse light (100 %).");
}

TEST(Verdict, LessThanHalfIsNotMost) {
    const LightPaths r = paths(10.0f, 4.0f, 5.0f, 20.0f);
    VerdictInput in{"realtime", "path", {}, {}, {}, split_error(paths(12.0f, 7.0f, 2.0f, 20.0f), r)};
    in.metrics.flip = 0.2;
    EXPECT_NE(verdict(in).find("The largest part of the difference is in direct specular light (38 %)."),
              std::string::npos)
        << verdict(in);
}

}  // namespace
}  // namespace candela::measure
