#include <gtest/gtest.h>

#include "process.hpp"

namespace candela::test {
namespace {

TEST(CliBake, WhatIsNoTableIsOneLineAndNoFile) {
    const TemporaryFolder folder;
    const Outcome outcome = run_candela("bake lct -o " + (folder / "table.bin"));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(lines(outcome.err), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find("candela bake ltc"), std::string::npos) << outcome.err;
    EXPECT_TRUE(outcome.out.empty());
    EXPECT_EQ(run_candela("bake").exit_code, 2);
}

}  // namespace
}  // namespace candela::test
