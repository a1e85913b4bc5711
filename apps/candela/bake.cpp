#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "candela/bake/ltc_fit.hpp"
#include "candela/io/image_write_safe.hpp"
#include "candela/scene/error.hpp"
#include "candela/version.hpp"
#include "command.hpp"
#include "job.hpp"
#include "local_light.hpp"
#include "shading/lights/ltc.glsl"

namespace candela::app {
namespace {

struct BakeOptions {
    std::string what;
    std::string output;
    LocalLightOptions local;
    JobOptions job;
    bool json = false;
};

/// What a reader of the table must know, and how good it is.
nlohmann::json ltc_metadata(const bake::LtcTable& table) {
    const std::size_t size = shading::kLtcSize;
    nlohmann::json rows = nlohmann::json::array();
    for (std::size_t y = 0; y < size; ++y) {
        rows.emplace_back(nlohmann::json::array());
        // Five digits after the point are the fit's tolerance.
        for (std::size_t x = 0; x < size; ++x)
            rows.back().push_back(std::round(1.0e5 * double(table.errors[y * size + x])) / 1.0e5);
    }
    const double sum = std::accumulate(table.errors.begin(), table.errors.end(), 0.0);
    return {{"table", "linearly transformed cosines"},
            {"version", bake::kLtcVersion},
            {"written_by", std::string("candela ") + version()},
            {"lobe", "D V cos of GGX with height-correlated Smith, over its directional albedo; no Fresnel"},
            {"size", size},
            {"columns", "NoV = (x / (size - 1))^2"},
            {"rows", "perceptual roughness = y / (size - 1); alpha is its square, at least 0.002"},
            {"texel", "x, y, z, w of ltc_inverse_matrix in shading/lights/ltc.glsl"},
            {"layout",
             "\"CLTC\", version, size (32 bits each), size^2 texels of four floats, size^2 errors; "
             "little-endian"},
            {"error", "half the integral of |lobe - fit| over the hemisphere"},
            {"mean_error", sum / double(table.errors.size())},
            {"largest_error", *std::max_element(table.errors.begin(), table.errors.end())},
            {"errors", rows}};
}

int bake_ltc(const BakeOptions& options) {
    const std::filesystem::path file = options.output.empty() ? "ltc_table.bin" : options.output;
    if (file.extension() == ".json")
        throw input_error("the table is binary; its metadata gets this ending", file.string(),
                          "-o ltc_table.bin");
    // Opened before the work, so that a folder that is not there is said at once.
    io::detail::SafeFile table_file(file);
    io::detail::SafeFile metadata_file(std::filesystem::path(file).replace_extension(".json"));
    const bake::LtcTable table = bake::fit_ltc_table();
    nlohmann::json metadata = ltc_metadata(table);
    const std::string bytes = bake::encode_ltc_table(table);
    const std::string text = metadata.dump() + "\n";
    (void)table_file.write(bytes.data(), bytes.size());
    (void)metadata_file.write(text.data(), text.size());
    table_file.commit();
    metadata_file.commit();
    metadata.erase("errors");
    metadata["file"] = file.string();
    if (options.json) {
        std::printf("%s\n", metadata.dump(2).c_str());
    } else {
        std::printf("%s: %d x %d, error %.4f on average, %.4f at most\n", file.c_str(), shading::kLtcSize,
                    shading::kLtcSize, metadata["mean_error"].get<double>(),
                    metadata["largest_error"].get<double>());
    }
    return 0;
}

nlohmann::json report_json(const LocalLightReport& report, std::size_t count) {
    return {{"count", count},
            {"file", report.file.string()},
            {"cached", report.cached},
            {"seconds", report.seconds}};
}

void print_report(const char* what, const LocalLightReport& report, std::size_t count) {
    std::printf("%zu %s: %s %s in %.1f s\n", count, what, report.cached ? "found in" : "written to",
                report.file.empty() ? "nowhere" : report.file.c_str(), report.seconds);
}

/// Fills the cache that pictures of this scene look into.
int bake_probes(BakeOptions options) {
    if (options.job.scene_file.empty())
        throw Error(Fault::usage, "needs a scene", "candela bake probes",
                    "candela bake probes SCENE --stage FILE");
    Job job = prepare(options.job);
    const std::size_t volumes = job.scene.irradiance_volumes.size();
    const std::size_t probes = job.scene.reflection_probes.size();
    if (volumes + probes == 0) {
        throw input_error("the stage has neither irradiance_volumes nor reflection_probes",
                          options.job.scene_file, "docs/stage.md, \"Probes\"");
    }
    options.local.quiet = options.json;
    const LocalLightReport irradiance = fill_irradiance_volumes(job, options.local);
    LocalLightReport reflection;
    if (probes > 0) {
        const gpu::Device device(device_options(options.job));
        std::fprintf(stderr, "candela: device: %s\n", device_line(device.info()).c_str());
        reflection = fill_reflection_probes(
            device, job,
            {shadows_of(options.job.shadows, "realtime") == Shadows::map, options.job.shadows.atlas_texels},
            options.local);
        if (!options.output.empty()) write_probe_pictures(job, options.output);
    }
    print_warnings(job.diagnostics);
    if (options.json) {
        const nlohmann::json out{{"version", version()},
                                 {"irradiance_volumes", report_json(irradiance, volumes)},
                                 {"reflection_probes", report_json(reflection, probes)},
                                 {"warnings", warnings_json(job.diagnostics)}};
        std::printf("%s\n", out.dump(2).c_str());
        return 0;
    }
    if (volumes > 0) print_report("irradiance volumes", irradiance, volumes);
    if (probes > 0) print_report("reflection probes", reflection, probes);
    return 0;
}

int bake(const BakeOptions& options) {
    if (options.what == "ltc") return bake_ltc(options);
    if (options.what == "probes") return bake_probes(options);
    throw input_error("there is nothing called '" + options.what + "' to bake", "candela bake",
                      "candela bake ltc, candela bake probes SCENE");
}

}  // namespace

void add_bake(CLI::App& app, Action& action) {
    auto options = std::make_shared<BakeOptions>();
    CLI::App* command = app.add_subcommand("bake", "Compute tables that rendering reads");
    command
        ->add_option("what", options->what,
                     "ltc: the matrices of linearly transformed cosines; probes: what a stage's irradiance "
                     "volumes and "
                     "reflection probes hold, for the cache")
        ->required();
    command->add_option("scene", options->job.scene_file, "With probes: the scene");
    add_scene_options(*command, options->job);
    command->add_option("--profile", options->job.profile, "With probes: of the pictures to come");
    command->add_option("--samples", options->local.samples, "With probes: paths of each probe of a volume")
        ->check(CLI::Range(16u, 1u << 20))
        ->capture_default_str();
    command->add_flag("--refresh", options->local.refresh, "With probes: even if the cache has them");
    add_shadow_options(*command, options->job.shadows);
    command->add_option(
        "-o,--output", options->output,
        "File for the table (ltc_table.bin); its metadata goes beside it, as .json. With probes: a folder "
        "for pictures of what the reflection probes see");
    command->add_flag("--json", options->json, "Print one JSON object on standard output");
    command->callback([options, &action] { action = [options] { return bake(*options); }; });
}

}  // namespace candela::app
