#include "bench_bake.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "candela/bake/environment.hpp"
#include "candela/io/environment_read.hpp"
#include "candela/measure/filter_error.hpp"
#include "candela/version.hpp"
#include "option_rules.hpp"
#include "progress_line.hpp"

namespace candela::app {
namespace {

using bake::FilterTechnique;

struct BenchBakeOptions {
    std::string environment;
    std::uint32_t size = 256;
    std::uint32_t texels = 24;
    int runs = 5;
    bool json = false;
};

struct Result {
    FilterTechnique technique;
    double milliseconds = 0.0;
    std::vector<measure::LevelError> errors;
};

double median_ms(int runs, const scene::Environment& environment, const bake::FilterOptions& options) {
    std::vector<double> times;
    for (int i = 0; i < runs; ++i) {
        const auto start = std::chrono::steady_clock::now();
        (void)bake::filter_environment(environment, options);
        times.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
    const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::nth_element(times.begin(), middle, times.end());
    return *middle;
}

/// The brute-force techniques once: they take seconds.
Result measure_technique(FilterTechnique technique, const scene::Environment& environment,
                         const measure::FilterTruth& truth, const BenchBakeOptions& options) {
    bake::FilterOptions filter;
    filter.size = options.size;
    filter.technique = technique;
    const bool quick =
        technique == FilterTechnique::harmonic || technique == FilterTechnique::filtered_importance;
    Result result{technique, median_ms(quick ? options.runs : 1, environment, filter), {}};
    // The truth is at the centres of texels; energy is asked of what is baked by default.
    const auto baked = measure::filter_errors(truth, bake::filter_environment(environment, filter));
    filter.texel = bake::TexelValue::center;
    result.errors = measure::filter_errors(truth, bake::filter_environment(environment, filter));
    for (std::size_t i = 0; i < baked.size(); ++i) result.errors[i].energy_ratio = baked[i].energy_ratio;
    return result;
}

nlohmann::json to_json(const Result& result) {
    nlohmann::json levels = nlohmann::json::array();
    for (const measure::LevelError& error : result.errors)
        levels.push_back({{"size", error.size},
                          {"alpha", error.alpha},
                          {"relative_rmse", error.rmse},
                          {"largest_relative_error", error.largest},
                          {"energy_ratio", error.energy_ratio}});
    return {{"technique", bake::filter_technique_name(result.technique)},
            {"milliseconds", result.milliseconds},
            {"levels", levels}};
}

void print(const Result& result) {
    std::printf("  %-20s %9.1f ms\n", bake::filter_technique_name(result.technique), result.milliseconds);
    for (const measure::LevelError& error : result.errors)
        std::printf("    %4u^2  alpha %.4f  relative RMSE %.1e  largest %.1e  energy %.4f\n", error.size,
                    double(error.alpha), error.rmse, error.largest, error.energy_ratio);
}

int bench_bake(const BenchBakeOptions& options) {
    std::vector<scene::Environment> environments;
    if (options.environment.empty()) {
        environments = {measure::one_texel_sun_environment(1024), bake::studio_environment()};
    } else {
        Diagnostics diagnostics;
        environments.push_back(io::read_environment(options.environment, diagnostics));
    }
    nlohmann::json out{{"version", version()}, {"size", options.size}, {"maps", nlohmann::json::array()}};
    for (const scene::Environment& environment : environments) {
        const measure::FilterTruth truth = [&] {
            const ProgressLine line("integrating " + environment.name);
            return measure::filter_truth(environment, options.size, scene::RoughnessMapping::linear,
                                         options.texels);
        }();
        if (!options.json)
            std::printf("%s, %ux%u, to a cube of %u^2 with all levels, and irradiance\n",
                        environment.name.c_str(), environment.width, environment.height, options.size);
        nlohmann::json results = nlohmann::json::array();
        constexpr std::array techniques{FilterTechnique::harmonic, FilterTechnique::filtered_importance,
                                        FilterTechnique::ggx_importance, FilterTechnique::cosine_power};
        for (const auto technique : techniques) {
            const Result result = [&] {
                const ProgressLine line("filtering " + environment.name + ", " +
                                        std::to_string(results.size() + 1) + " of " +
                                        std::to_string(techniques.size()));
                return measure_technique(technique, environment, truth, options);
            }();
            if (!options.json) print(result);
            results.push_back(to_json(result));
        }
        out["maps"].push_back({{"name", environment.name},
                               {"width", environment.width},
                               {"height", environment.height},
                               {"techniques", results}});
    }
    if (options.json) std::printf("%s\n", out.dump(2).c_str());
    return 0;
}

}  // namespace

void add_bench_bake(CLI::App& bench, Action& action) {
    auto options = std::make_shared<BenchBakeOptions>();
    CLI::App* command =
        bench.add_subcommand("bake", "Measure what filtering an environment costs and how far off it is");
    command->add_option(
        "ENV", options->environment,
        "Equirectangular .exr or .hdr; without: a sky with a sun of one texel, and the studio");
    command->add_option("--size", options->size, "Texels a side of the finest level, a power of two (256)")
        ->check(power_of_two(4, 2048));
    command->add_option("--texels", options->texels, "Texels a level that are held against the integral (24)")
        ->check(CLI::Range(1u, 100000u));
    command->add_option("--runs", options->runs, "Runs to take the median of (5)")
        ->check(CLI::Range(1, 1000));
    command->add_flag("--json", options->json, "Print one JSON object on standard output");
    command->callback([options, &action] { action = [options] { return bench_bake(*options); }; });
}

}  // namespace candela::app
