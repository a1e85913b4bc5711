#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "candela/measure/experiment.hpp"
#include "candela/scene/error.hpp"
#include "source_folder.hpp"

namespace candela::measure {
namespace {

/// Cheap enough to run in full here; the heavy ones are run by the command line's own test.
bool is_quick(const std::string& id) {
    return id != "karis2013_figure3" && id != "karis2013_figure4" && id != "karis2013_figure5";
}

TEST(Registry, HoldsEveryExperimentFileOnceUnderItsName) {
    std::set<std::string> files;
    const std::filesystem::path folder =
        std::filesystem::path(CANDELA_SOURCE_DIR) / "src" / "candela" / "measure" / "experiments";
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        files.insert(entry.path().stem().string());
    std::set<std::string> ids;
    for (const Experiment& e : all_experiments()) EXPECT_TRUE(ids.insert(e.id).second) << e.id << " twice";
    EXPECT_EQ(ids, files);
    EXPECT_GE(ids.size(), 24u);
}

// One heading a paper: no paper goes by two names.
TEST(Registry, APaperHasOneName) {
    std::set<std::string> papers;
    for (const Experiment& e : all_experiments()) papers.insert(e.paper);
    for (const std::string& a : papers) {
        for (const std::string& b : papers) {
            if (a == b) continue;
            EXPECT_EQ(a.find(b), std::string::npos) << a << " and " << b;
        }
    }
}

TEST(Registry, EveryExperimentNamesItsSourceAndSaysWhatItComputes) {
    for (const Experiment& e : all_experiments()) {
        EXPECT_FALSE(e.paper.empty()) << e.id;
        EXPECT_FALSE(e.reproduces.empty()) << e.id;
        EXPECT_FALSE(e.title.empty()) << e.id;
        EXPECT_GT(e.computes.size(), 20u) << e.id;
    }
}

TEST(Registry, EveryNumberHasABoundAndEveryTechniqueASource) {
    for (const Experiment& e : all_experiments()) {
        if (!is_quick(e.id)) continue;
        const Findings found = e.run();
        EXPECT_FALSE(found.measured.empty()) << e.id;
        EXPECT_FALSE(found.text.empty()) << e.id;
        EXPECT_FALSE(found.plots.empty() && found.tables.empty() && found.pictures.empty())
            << e.id << " shows nothing";
        std::set<std::string> names;
        for (const Measured& m : found.measured) {
            EXPECT_TRUE(std::isfinite(m.value)) << e.id << ": " << m.name;
            EXPECT_TRUE(std::isfinite(m.bound.at_least) || std::isfinite(m.bound.at_most))
                << e.id << ": " << m.name;
            EXPECT_TRUE(names.insert(m.name).second) << e.id << " says twice: " << m.name;
            EXPECT_TRUE(m.pass()) << e.id << ": " << m.name << " is " << m.value;
        }
        for (const Technique& t : found.techniques) {
            EXPECT_FALSE(t.source.empty() || t.approximates.empty() || t.truth.empty()) << t.name;
            EXPECT_GE(t.max_error, t.mean_error) << t.name;
            EXPECT_GT(t.cost_ns(), 0.0) << t.name;
        }
    }
}

TEST(Registry, ABoundIsAnIntervalWithItsEndsAndNotANumberMissesIt) {
    EXPECT_TRUE(at_most("", 1.0, 1.0).pass());
    EXPECT_FALSE(at_most("", 1.001, 1.0).pass());
    EXPECT_TRUE(at_least("", 1.0, 1.0).pass());
    EXPECT_FALSE(at_least("", 0.999, 1.0).pass());
    EXPECT_FALSE(within("", 3.0, 1.0, 2.0).pass());
    EXPECT_FALSE(within("", std::nan(""), 1.0, 2.0).pass());
    EXPECT_FALSE(at_most("", std::nan(""), 2.0).pass());
    EXPECT_FALSE(at_most("", INFINITY, 2.0).pass());
}

TEST(Registry, SelectionKeepsTheOrderThatWasAskedFor) {
    const auto two = select_experiments(all_experiments(), {"teaching_page", "frostbite_table07"});
    ASSERT_EQ(two.size(), 2u);
    EXPECT_EQ(two[0].id, "teaching_page");
    EXPECT_EQ(two[1].id, "frostbite_table07");
    EXPECT_EQ(select_experiments(all_experiments(), {}).size(), all_experiments().size());
}

TEST(Registry, AnUnknownIdIsAUsageErrorWithTheNearestName) {
    try {
        (void)select_experiments(all_experiments(), {"karis2013_figur2"});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::usage);
        EXPECT_NE(error.hint().find("karis2013_figure2"), std::string::npos) << error.hint();
    }
}

}  // namespace
}  // namespace candela::measure
