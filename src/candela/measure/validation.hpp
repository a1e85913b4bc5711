#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "candela/measure/experiment.hpp"
#include "candela/scene/progress.hpp"

/// `candela validate`: runs experiments and writes what they found.
namespace candela::measure {

struct TechniqueCost {
    Technique technique;
    double cost_ns = 0.0;
};

struct ExperimentResult {
    Experiment experiment;
    Findings findings;
    std::vector<TechniqueCost> techniques;
    double seconds = 0.0;

    /// Every bound is met, and there is at least one.
    [[nodiscard]] bool pass() const;
};

/// Runs the experiments on `threads` >= 1 threads, then times their techniques one after the other. The first
/// exception of an experiment is thrown on.
[[nodiscard]] std::vector<ExperimentResult> run_experiments(std::span<const Experiment> experiments,
                                                            unsigned threads,
                                                            const ProgressFunction& progress = {});

[[nodiscard]] bool all_pass(std::span<const ExperimentResult> results);

/// results.json: {"version", "pass", "experiments": [...], "techniques": [...]}; docs/validation.md has its
/// schema. Numbers that are not finite become null.
[[nodiscard]] nlohmann::json results_json(std::span<const ExperimentResult> results,
                                          const std::string& version);

/// index.html: one file without external references.
[[nodiscard]] std::string results_page(std::span<const ExperimentResult> results, const std::string& version);

/// docs/techniques.md.
[[nodiscard]] std::string techniques_markdown(std::span<const ExperimentResult> results);

/// The outcome as lines of text for a terminal: one an experiment, and one for each bound that is missed.
[[nodiscard]] std::string results_text(std::span<const ExperimentResult> results);

/// "at most 0.01", "0.9 to 1.1", ...
[[nodiscard]] std::string bound_text(const Measured& measured);

struct ValidationOptions {
    std::filesystem::path folder;  ///< receives index.html and results.json, made if missing; empty: nothing
    std::filesystem::path techniques_file;  ///< empty: nothing
    unsigned threads = 2;
    std::string version;        ///< of Candela, for the files
    ProgressFunction progress;  ///< after each experiment
};

struct ValidationOutcome {
    std::vector<ExperimentResult> results;
    int exit_code = 0;  ///< 1 when a bound is missed
};

/// Runs and writes, each file under a temporary name first. Throws Error when a file cannot be written.
[[nodiscard]] ValidationOutcome validate(std::span<const Experiment> experiments,
                                         const ValidationOptions& options);

}  // namespace candela::measure
