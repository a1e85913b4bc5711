#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/process.hpp"
#include "tests/validate/markup.hpp"

using namespace candela::test;
using nlohmann::json;

TEST(ValidateCommand, AnUnknownIdIsExitCodeTwoWithTheNearestName) {
    const TemporaryFolder folder;
    const Outcome outcome = run_candela("validate --only frostbite_tabel10 -o " + (folder / "out"));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(lines(outcome.err), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find("frostbite_table10"), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(ValidateCommand, ListsWithoutRunning) {
    const json listed = json::parse(run_candela("validate --list --json").out);
    EXPECT_GE(listed["experiments"].size(), 24u);
    EXPECT_EQ(lines(run_candela("validate --list").out), listed["experiments"].size());
}

TEST(ValidateCommand, PrintsOneJsonObjectAndWritesWholeFiles) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_candela("validate --only frostbite_table07,karis2014_fully_rough --json -o " + (folder / "out"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const json printed = json::parse(outcome.out);
    ASSERT_EQ(printed["experiments"].size(), 2u);
    EXPECT_EQ(printed["experiments"][1]["id"], "karis2014_fully_rough");
    EXPECT_EQ(json::parse(slurp(folder / "out/results.json"))["experiments"].size(), 2u);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out"))
        files += entry.is_regular_file() ? 1u : 0u;
    EXPECT_EQ(files, 2u) << "a temporary file is left";
}

// The whole validation of the papers: every bound of every experiment is met, and the page is sound.
TEST(ValidateCommand, TheWholeRunMeetsEveryBound) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_candela("validate -o " + (folder / "out") + " --techniques " + (folder / "techniques.md"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    const std::string page = slurp(folder / "out/index.html");
    EXPECT_EQ(markup_fault(page), "");
    for (std::size_t at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1)) {
        const std::string svg = page.substr(at, page.find("</figure>", at) - at);
        EXPECT_EQ(not_finite(svg), "");
    }
    EXPECT_EQ(page.find("https:"), std::string::npos);
    EXPECT_GT(lines(slurp(folder / "techniques.md")), 25u);
}
