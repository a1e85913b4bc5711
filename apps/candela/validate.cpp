#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "candela/measure/validation.hpp"
#include "candela/version.hpp"
#include "command.hpp"
#include "option_rules.hpp"
#include "progress_line.hpp"

namespace candela::app {
namespace {

struct ValidateOptions {
    measure::ValidationOptions validation;
    std::vector<std::string> only;
    bool list = false;
    bool json = false;
};

nlohmann::json list_json(const std::vector<measure::Experiment>& experiments) {
    nlohmann::json out = nlohmann::json::array();
    for (const measure::Experiment& e : experiments) {
        out.push_back({{"id", e.id},
                       {"paper", e.paper},
                       {"reproduces", e.reproduces},
                       {"title", e.title},
                       {"computes", e.computes}});
    }
    return {{"experiments", out}};
}

int list(const std::vector<measure::Experiment>& experiments, bool json) {
    if (json) {
        std::printf("%s\n", list_json(experiments).dump(2).c_str());
        return 0;
    }
    for (const measure::Experiment& e : experiments) {
        std::printf("%-26s %s, %s: %s\n", e.id.c_str(), e.paper.c_str(), e.reproduces.c_str(),
                    e.title.c_str());
    }
    return 0;
}

int validate(const ValidateOptions& options) {
    const auto experiments = measure::select_experiments(measure::all_experiments(), options.only);
    if (options.list) return list(experiments, options.json);
    const measure::ValidationOutcome outcome = [&] {
        ProgressLine line("running " + std::to_string(experiments.size()) + " experiments");
        measure::ValidationOptions validation = options.validation;
        validation.progress = line.function();
        return measure::validate(experiments, validation);
    }();
    if (options.json) {
        std::printf("%s\n", measure::results_json(outcome.results, version()).dump(2).c_str());
    } else {
        std::fputs(measure::results_text(outcome.results).c_str(), stdout);
        if (!options.validation.folder.empty())
            print_written(std::vector<std::filesystem::path>{options.validation.folder / "index.html",
                                                             options.validation.folder / "results.json"});
        if (!options.validation.techniques_file.empty()) print_written(options.validation.techniques_file);
    }
    return outcome.exit_code;
}

}  // namespace

void add_validate(CLI::App& app, Action& action) {
    auto options = std::make_shared<ValidateOptions>();
    options->validation.version = version();
    CLI::App* command = app.add_subcommand(
        "validate", "Reproduce the papers' figures and tables; exit 1 when a bound is missed");
    command->add_option("-o,--output", options->validation.folder, "Folder for index.html and results.json");
    command->add_option("--only", options->only, "Run only these experiments: ID,...")->delimiter(',');
    command->add_option("--techniques", options->validation.techniques_file,
                        "Write the table of techniques, with errors and costs, to this Markdown file");
    command->add_option("--threads", options->validation.threads, "Threads to run experiments on")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
    command->add_flag("--list", options->list, "Only list the experiments");
    command->add_flag("--json", options->json, "Print one JSON object on standard output");
    command->callback([options, command, &action] {
        if (options->list)
            refuse_without_effect(*command, {"--output", "--techniques", "--threads"},
                                  "with --list, which runs nothing");
        action = [options] { return validate(*options); };
    });
}

}  // namespace candela::app
