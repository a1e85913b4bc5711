#include "candela/measure/validation.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "candela/io/image_write.hpp"
#include "candela/io/output_folder.hpp"
#include "candela/measure/numerics.hpp"
#include "candela/scene/error.hpp"

namespace candela::measure {
namespace {

using Clock = std::chrono::steady_clock;

ExperimentResult run_one(const Experiment& experiment) {
    const auto start = Clock::now();
    ExperimentResult out;
    out.experiment = experiment;
    out.findings = experiment.run();
    out.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return out;
}

/// Experiments are taken from one counter by all threads; results keep the order of the experiments.
std::vector<ExperimentResult> run_all(std::span<const Experiment> experiments, unsigned threads,
                                      const ProgressFunction& progress) {
    std::vector<ExperimentResult> results(experiments.size());
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    std::exception_ptr failure;
    std::size_t done = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < experiments.size(); i = next++) {
            try {
                results[i] = run_one(experiments[i]);
                const std::scoped_lock lock(mutex);
                if (progress) progress(double(++done) / double(experiments.size()));
            } catch (...) {
                const std::scoped_lock lock(mutex);
                if (!failure) failure = std::current_exception();
            }
        }
    };
    {
        std::vector<std::jthread> pool;
        for (unsigned t = 1; t < threads; ++t) pool.emplace_back(work);
        work();
    }
    if (failure) std::rethrow_exception(failure);
    return results;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
    io::write_file(file, std::as_bytes(std::span(text)));
}

}  // namespace

bool ExperimentResult::pass() const {
    const auto& all = findings.measured;
    return !all.empty() && std::all_of(all.begin(), all.end(), [](const Measured& m) { return m.pass(); });
}

bool all_pass(std::span<const ExperimentResult> results) {
    return std::all_of(results.begin(), results.end(), [](const ExperimentResult& r) { return r.pass(); });
}

std::vector<ExperimentResult> run_experiments(std::span<const Experiment> experiments, unsigned threads,
                                              const ProgressFunction& progress) {
    std::vector<ExperimentResult> results = run_all(experiments, threads, progress);
    for (ExperimentResult& result : results) {
        for (const Technique& technique : result.findings.techniques)
            result.techniques.push_back({technique, technique.cost_ns()});
    }
    return results;
}

ValidationOutcome validate(std::span<const Experiment> experiments, const ValidationOptions& options) {
    if (!options.techniques_file.empty()) io::check_output_file(options.techniques_file);
    if (!options.folder.empty()) (void)io::make_output_folder(options.folder);
    ValidationOutcome out{run_experiments(experiments, options.threads, options.progress), 0};
    if (!options.folder.empty()) {
        write_text(options.folder / "results.json",
                   results_json(out.results, options.version).dump(2) + "\n");
        write_text(options.folder / "index.html", results_page(out.results, options.version));
    }
    if (!options.techniques_file.empty())
        write_text(options.techniques_file, techniques_markdown(out.results));
    out.exit_code = all_pass(out.results) ? 0 : 1;
    return out;
}

}  // namespace candela::measure
