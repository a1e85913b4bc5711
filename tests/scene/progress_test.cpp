#include "candela/scene/progress.hpp"

#include <gtest/gtest.h>

namespace candela {
namespace {

TEST(Progress, AnEvenPaceGoesOn) {
    PaceEstimate pace;
    EXPECT_FALSE(pace.seconds_left(1.0)) << "nothing is known yet";
    for (int i = 1; i <= 30; ++i) pace.add(2.0 * i, i / 100.0);
    EXPECT_NEAR(pace.seconds_left(60.0).value_or(-1.0), 140.0, 1e-9);
    EXPECT_NEAR(pace.seconds_left(61.5).value_or(-1.0), 138.5, 1e-9) << "counts down to the next report";
    // 28 s too late after 30 s for 15 hundredths: that is 58 s for as much, and 70 are left.
    EXPECT_NEAR(pace.seconds_left(90.0).value_or(-1.0), 70.0 * 58.0 / 15.0 - 2.0, 1e-6) << "overdue";
}

TEST(Progress, ASlowStartIsForgotten) {
    PaceEstimate pace;
    // Shaders compile for 20 s before the first of 64 samples, of 1 s each.
    for (int i = 1; i <= 40; ++i) pace.add(20.0 + i, i / 64.0);
    EXPECT_NEAR(pace.seconds_left(60.0).value_or(-1.0), 24.0, 0.5);
}

TEST(Progress, ThousandsOfReportsAreKeptInFew) {
    PaceEstimate pace;
    for (int i = 1; i <= 100000; ++i) pace.add(1e-3 * i, i / 200000.0);
    EXPECT_NEAR(pace.seconds_left(100.0).value_or(-1.0), 100.0, 0.5);
    pace.add(50.0, 0.1);
    EXPECT_EQ(pace.fraction(), 0.5) << "never backwards";
}

TEST(Progress, DurationsAreSaidAsPeopleDo) {
    EXPECT_EQ(duration_text(0.2), "0 s");
    EXPECT_EQ(duration_text(59.4), "59 s");
    EXPECT_EQ(duration_text(59.6), "1 min 00 s");
    EXPECT_EQ(duration_text(185.0), "3 min 05 s");
    EXPECT_EQ(duration_text(7800.0), "2 h 10 min");
    EXPECT_EQ(duration_text(-3.0), "0 s");
}

}  // namespace
}  // namespace candela
