#include "bake_environment.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "candela/bake/filter_environment.hpp"
#include "candela/io/environment_write.hpp"
#include "candela/measure/numerics.hpp"
#include "candela/scene/error.hpp"
#include "candela/version.hpp"
#include "job.hpp"
#include "option_rules.hpp"
#include "progress_line.hpp"

namespace candela::app {
namespace {

scene::Environment read(const BakeEnvironmentOptions& options, Diagnostics& diagnostics) {
    scene::Environment e = environment_picture(options.environment, options.how, diagnostics);
    e.scale = options.scale;
    e.rotation_rad = options.rotate_deg * static_cast<float>(M_PI / 180.0);
    return e;
}

scene::RoughnessMapping mapping_of(const std::string& name) {
    if (name == "linear") return scene::RoughnessMapping::linear;
    if (name == "frostbite") return scene::RoughnessMapping::frostbite;
    if (name == "filament") return scene::RoughnessMapping::filament;
    throw Error(Fault::usage, "there is no mapping of roughness '" + name + "'", "--mapping",
                "linear, frostbite or filament");
}

io::EnvironmentPreset preset_of(const std::string& name) {
    if (const auto preset = io::preset_by_name(name)) return *preset;
    throw Error(Fault::usage, "there is no preset '" + name + "'", "--preset",
                "candela, filament, threejs or gltf");
}

bake::FilterOptions filter_options(const BakeEnvironmentOptions& options, io::EnvironmentPreset preset) {
    const io::FilterDemand demand = io::demand_of(preset);
    bake::FilterOptions filter;
    filter.size = options.size;
    filter.sample_count = options.samples;
    filter.irradiance_size = options.irradiance_size;
    filter.technique = bake::filter_technique(options.technique.c_str());
    filter.mapping = options.mapping ? mapping_of(*options.mapping)
                                     : demand.mapping.value_or(scene::RoughnessMapping::linear);
    filter.levels = preset == io::EnvironmentPreset::threejs ? 1 : options.levels;
    // A preset whose coarsest level is larger ends there.
    if (filter.levels == 0 && demand.smallest_level > 1 && options.size >= demand.smallest_level)
        filter.levels = static_cast<std::uint32_t>(
                            std::lround(std::log2(double(options.size) / double(demand.smallest_level)))) +
                        1;
    return filter;
}

constexpr const char* kChannels[] = {"red", "green", "blue"};

nlohmann::json harmonics_of(const scene::HarmonicsWindow& window) {
    nlohmann::json channels = nlohmann::json::array();
    for (int c = 0; c < 3; ++c) {
        const glm::vec2& bands = window.bands[static_cast<std::size_t>(c)];
        channels.push_back({{"channel", kChannels[c]},
                            {"least_over_mean", window.least_over_mean[c]},
                            {"band_1_factor", bands.x},
                            {"band_2_factor", bands.y}});
    }
    return {{"relative_rmse_without_window", window.error_without},
            {"relative_rmse", window.error},
            {"windowed", window.any()},
            {"channels", channels}};
}

std::string harmonics_text(const scene::HarmonicsWindow& window) {
    const auto percent = [](double error) { return measure::number(100.0 * error) + " %"; };
    std::string out = "irradiance as 9 harmonics: relative RMSE " + percent(window.error_without);
    if (!window.any()) return out + ", nowhere negative, no window";
    out += ", " + percent(window.error) + " windowed";
    for (int c = 0; c < 3; ++c) {
        const glm::vec2& bands = window.bands[static_cast<std::size_t>(c)];
        if (bands == glm::vec2(1.0f)) continue;
        out += std::string("; ") + kChannels[c] + " fell to " +
               measure::number(double{window.least_over_mean[c]}) + " of its mean: band 1 x " +
               measure::number(double{bands.x}) + ", band 2 x " + measure::number(double{bands.y});
    }
    return out;
}

}  // namespace

void check_bake_environment_options(const CLI::App& command, const BakeEnvironmentOptions& o) {
    const io::EnvironmentPreset preset = preset_of(o.preset);
    const std::string name = "with the preset " + o.preset;
    if (preset != io::EnvironmentPreset::candela) {
        refuse_without_effect(command, {"--format"}, name + ", which has its own", "--preset candela");
        // Their irradiance is the harmonics.
        refuse_without_effect(command, {"--irradiance-size"}, name + ", which has harmonics only",
                              "--preset candela");
    }
    if (preset == io::EnvironmentPreset::threejs)
        refuse_without_effect(command, {"--levels", "--mapping", "--technique", "--samples"},
                              name + ": three.js filters by itself", "--preset candela");
    const io::FilterDemand demand = io::demand_of(preset);
    const scene::RoughnessMapping mapping =
        o.mapping ? mapping_of(*o.mapping) : scene::RoughnessMapping::linear;
    if (o.mapping && demand.mapping && mapping != *demand.mapping)
        throw Error(Fault::usage, "is not what the preset " + o.preset + " stands for", "--mapping",
                    "leave it out");
    const bake::FilterTechnique technique = bake::filter_technique(o.technique.c_str());
    if (technique == bake::FilterTechnique::harmonic || technique == bake::FilterTechnique::cosine_power)
        refuse_without_effect(command, {"--samples"},
                              "with the technique " + o.technique + ", which draws none",
                              "--technique filtered-importance");
    const std::uint32_t coarsest = std::max(demand.smallest_level, 1u);
    if (o.size < coarsest)
        throw Error(Fault::usage,
                    "the preset " + o.preset + " has no faces of less than " + std::to_string(coarsest) +
                        " texels a side",
                    "--size");
    const auto most = static_cast<std::uint32_t>(std::bit_width(o.size / coarsest));
    if (o.levels > most)
        throw Error(Fault::usage,
                    "a cube of " + std::to_string(o.size) + " has " + std::to_string(most) + " at most" +
                        (coarsest > 1 ? " " + name : ""),
                    "--levels", "0: all of them");
}

int bake_environment(const BakeEnvironmentOptions& options) {
    const io::EnvironmentPreset preset = preset_of(options.preset);
    const auto format = io::cube_format_by_name(options.format);
    if (!format)
        throw Error(Fault::usage, "there is no format '" + options.format + "'", "--format",
                    "ktx2, ktx2-rgb9e5, dds, exr or exr-faces");
    bake::FilterOptions filter = filter_options(options, preset);
    Diagnostics diagnostics;
    const scene::Environment environment = read(options, diagnostics);
    const auto start = std::chrono::steady_clock::now();
    const scene::FilteredEnvironment filtered = [&] {
        ProgressLine line("filtering the environment");
        filter.progress = line.function();
        return bake::filter_environment(environment, filter);
    }();
    const double milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    // three.js takes a picture of all directions as it is, and filters by itself.
    const bool as_it_is = preset == io::EnvironmentPreset::threejs && !options.size_given;
    const auto files = io::write_filtered_environment(options.folder, filtered, *format, preset,
                                                      as_it_is ? &environment : nullptr);
    nlohmann::json names = nlohmann::json::array();
    for (const auto& file : files) names.push_back(file.string());
    if (options.json) {
        const nlohmann::json out{{"version", version()},
                                 {"environment", options.environment},
                                 {"technique", options.technique},
                                 {"size", filter.size},
                                 {"levels", filtered.specular.size()},
                                 {"filter_ms", milliseconds},
                                 {"nit_per_unit", filtered.nit_per_unit},
                                 {"irradiance_sh", harmonics_of(filtered.irradiance_sh_window)},
                                 {"folder", options.folder},
                                 {"files", names},
                                 {"warnings", warnings_json(diagnostics)}};
        std::printf("%s\n", out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
        return 0;
    }
    std::printf("%s: %zu levels from %u^2 by %s in %.0f ms, %zu files\n", options.folder.c_str(),
                filtered.specular.size(), filter.size, options.technique.c_str(), milliseconds, files.size());
    if (filtered.nit_per_unit != 1.0f)
        std::printf("  stored values times %g are cd/m^2\n", double(filtered.nit_per_unit));
    std::printf("  %s\n", harmonics_text(filtered.irradiance_sh_window).c_str());
    print_written(options.folder);
    print_warnings(diagnostics);
    return 0;
}

}  // namespace candela::app
