#include "candela/measure/validation.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>

#include "candela/scene/error.hpp"
#include "tests/cli/process.hpp"
#include "tests/validate/markup.hpp"

namespace candela::measure {
namespace {

using nlohmann::json;
using test::TemporaryFolder;

/// A tiny experiment whose one number is 1 and may be at most `bound`.
Experiment planted(double bound, const std::string& id = "planted") {
    const auto run = [bound] {
        Findings out;
        out.text = "found <this> & that";
        out.measured = {at_most("one", 1.0, bound, "lx")};
        out.plots = {{"a plot", "", {"x"}, {"y"}, {{"s", {0.0, 1.0, 2.0}, {1.0, std::nan(""), 3.0}}}}};
        out.tables = {{"a table", {"a", "b"}, {{"<1>", "2"}}}};
        out.pictures = {{"a picture", "", 2, 1, {255, 0, 0, 0, 255, 0}}};
        out.techniques = {{"t", "a paper", "something", "the truth", "", 0.5, 1.0, [] { return 3.0; }}};
        return out;
    };
    return {"A paper", "Figure 1", "a title", "computes a thing", run, id};
}

ValidationOptions into(const TemporaryFolder& folder) {
    ValidationOptions options;
    options.folder = folder.path() / "made by it";
    options.techniques_file = folder.path() / "techniques.md";
    return options;
}

TEST(Validation, AMissedBoundIsExitCodeOneAndIsShownEverywhere) {
    const TemporaryFolder folder;
    const std::vector<Experiment> wrong{planted(2.0, "good"), planted(0.5, "bad")};
    const ValidationOutcome outcome = validate(wrong, into(folder));
    EXPECT_EQ(outcome.exit_code, 1);
    const json results = json::parse(test::slurp((into(folder).folder / "results.json").string()));
    EXPECT_FALSE(results["pass"]);
    EXPECT_TRUE(results["experiments"][0]["pass"]);
    EXPECT_FALSE(results["experiments"][1]["pass"]);
    EXPECT_NE(results_text(outcome.results).find("FAIL  bad"), std::string::npos);
    EXPECT_NE(results_text(outcome.results).find("1 of 2"), std::string::npos);
    const std::string page = test::slurp((into(folder).folder / "index.html").string());
    EXPECT_NE(page.find("badge fail"), std::string::npos);

    const std::vector<Experiment> right{planted(1.0)};
    EXPECT_EQ(validate(right, {}).exit_code, 0);
}

TEST(Validation, AnExperimentThatMeasuresNothingFails) {
    Experiment empty = planted(2.0);
    empty.run = [] { return Findings{}; };
    EXPECT_EQ(validate(std::vector<Experiment>{empty}, {}).exit_code, 1);
}

TEST(Validation, ResultsHaveTheDocumentedSchema) {
    const auto results = run_experiments(std::vector<Experiment>{planted(2.0)}, 1);
    const json out = results_json(results, "1.2.3");
    EXPECT_EQ(out["version"], "1.2.3");
    EXPECT_TRUE(out["pass"].is_boolean());
    const json& e = out["experiments"].at(0);
    for (const char* key : {"id", "paper", "reproduces", "title", "computes", "finding"})
        EXPECT_TRUE(e[key].is_string()) << key;
    EXPECT_TRUE(e["seconds"].is_number());
    const json& m = e["measured"].at(0);
    EXPECT_EQ(
        m,
        (json{
            {"name", "one"}, {"value", 1.0}, {"unit", "lx"}, {"bound", {{"at_most", 2.0}}}, {"pass", true}}));
    EXPECT_EQ(e["plots"].at(0)["series"].at(0)["y"], (json{1.0, nullptr, 3.0})) << "no number: null";
    EXPECT_EQ(e["tables"].at(0)["rows"].at(0), (json{"<1>", "2"}));
    const json& t = out["techniques"].at(0);
    for (const char* key : {"name", "source", "approximates", "truth", "unit", "experiment"})
        EXPECT_TRUE(t[key].is_string()) << key;
    EXPECT_EQ(t["mean_error"], 0.5);
    EXPECT_EQ(t["max_error"], 1.0);
    EXPECT_EQ(t["cost_ns"], 3.0);
}

TEST(Validation, ThePageStandsAlone) {
    const auto results =
        run_experiments(std::vector<Experiment>{planted(2.0, "first"), planted(0.0, "second")}, 2);
    const std::string page = results_page(results, "1.2.3");
    EXPECT_EQ(test::markup_fault(page), "");
    for (const char* reference :
         {"http:", "https:", "src=\"/", "<link", "<script", "url(", "@import", "file:"}) {
        std::string rest = page;
        for (std::size_t at; (at = rest.find("http://www.w3.org/2000/svg")) != std::string::npos;)
            rest.erase(at, 26);
        EXPECT_EQ(rest.find(reference), std::string::npos) << reference;
    }
    for (const char* expected : {"id=\"first\"", "href=\"#second\"", "<svg", "data:image/png;base64,",
                                 "found &lt;this&gt; &amp; that", "&lt;1&gt;", "id=\"techniques\""})
        EXPECT_NE(page.find(expected), std::string::npos) << expected;
}

TEST(Validation, TechniquesAreATableOfThatRun) {
    const TemporaryFolder folder;
    (void)validate(std::vector<Experiment>{planted(2.0)}, into(folder));
    const std::string text = test::slurp(folder / "techniques.md");
    EXPECT_NE(text.find("| t | a paper | something | the truth | 0.5 | 1 | 3 | planted |"), std::string::npos)
        << text;
}

TEST(Validation, ResultsKeepTheirOrderOnManyThreadsAndEachRunsOnce) {
    std::atomic<int> runs{0};
    std::vector<Experiment> many;
    for (int i = 0; i < 40; ++i) {
        many.push_back(planted(2.0, std::to_string(i)));
        many.back().run = [&runs, i] {
            ++runs;
            Findings out;
            out.measured = {within("own", i, i, i)};
            return out;
        };
    }
    const auto results = run_experiments(many, 4);
    EXPECT_EQ(runs, 40);
    for (std::size_t i = 0; i < results.size(); ++i)
        EXPECT_EQ(results[i].findings.measured.at(0).value, double(i));
}

TEST(Validation, AnExceptionOfAnExperimentComesOut) {
    Experiment broken = planted(2.0);
    broken.run = []() -> Findings { throw machine_error("the disk is full"); };
    EXPECT_THROW((void)run_experiments(std::vector<Experiment>{planted(2.0), broken, planted(2.0)}, 2),
                 Error);
}

TEST(Validation, AFileInPlaceOfTheFolderIsAnInputError) {
    const TemporaryFolder folder;
    std::ofstream(folder / "taken") << "x";
    ValidationOptions options;
    options.folder = folder / "taken";
    try {
        (void)validate(std::vector<Experiment>{planted(2.0)}, options);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input);
    }
}

}  // namespace
}  // namespace candela::measure
