#include "bake_probes.hpp"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "candela/io/output_folder.hpp"
#include "candela/scene/error.hpp"
#include "candela/version.hpp"
#include "job.hpp"
#include "local_light.hpp"
#include "progress_line.hpp"

namespace candela::app {
namespace {

struct BakeProbesOptions {
    std::string output;
    LocalLightOptions local;
    JobOptions job;
    bool json = false;
};

nlohmann::json names_json(const std::vector<std::filesystem::path>& files) {
    nlohmann::json out = nlohmann::json::array();
    for (const std::filesystem::path& file : files) out.push_back(file.string());
    return out;
}

nlohmann::json report_json(const LocalLightReport& report, std::size_t count) {
    return {{"count", count},
            {"file", report.file.string()},
            {"cached", report.cached},
            {"seconds", report.seconds}};
}

void print_report(const char* what, const LocalLightReport& report, std::size_t count) {
    if (count == 0) {
        std::printf("%s: none in the stage\n", what);
        return;
    }
    // "irradiance volumes", of which there may be one.
    const std::string name = std::string(what).substr(0, std::string(what).size() - (count == 1 ? 1 : 0));
    std::printf("%zu %s: %s %s in %.1f s\n", count, name.c_str(), report.cached ? "found in" : "written to",
                report.file.empty() ? "nowhere" : report.file.c_str(), report.seconds);
}

void print_pictures(const std::vector<std::filesystem::path>& pictures, const std::string& folder) {
    if (pictures.empty())
        std::printf("nothing written into %s: pictures are of reflection probes\n", folder.c_str());
    print_written(pictures);
}

/// Fills the cache that pictures of this scene look into.
int bake_probes(BakeProbesOptions options) {
    if (options.job.scene_file.empty())
        throw Error(Fault::usage, "needs a scene", "candela bake probes",
                    "candela bake probes SCENE --stage FILE");
    if (!options.output.empty()) io::check_output_folder(options.output);
    Job job = prepare(options.job);
    const std::size_t volumes = job.scene.irradiance_volumes.size();
    const std::size_t probes = job.scene.reflection_probes.size();
    if (volumes + probes == 0) {
        throw input_error("the stage has neither irradiance_volumes nor reflection_probes",
                          options.job.scene_file, "docs/stage.md, \"Probes\"");
    }
    const LocalLightReport irradiance = fill_irradiance_volumes(job, options.local);
    LocalLightReport reflection;
    std::vector<std::filesystem::path> pictures;
    if (probes > 0) {
        const gpu::Device device(device_options(options.job));
        std::fprintf(stderr, "candela: device: %s\n", device_line(device.info()).c_str());
        reflection = fill_reflection_probes(
            device, job,
            {shadows_of(options.job.shadows, "realtime") == Shadows::map, options.job.shadows.atlas_texels},
            options.local);
        if (!options.output.empty()) pictures = write_probe_pictures(job, options.output);
    }
    print_warnings(job.diagnostics);
    if (options.json) {
        const nlohmann::json out{{"version", version()},
                                 {"irradiance_volumes", report_json(irradiance, volumes)},
                                 {"reflection_probes", report_json(reflection, probes)},
                                 {"pictures", names_json(pictures)},
                                 {"warnings", warnings_json(job.diagnostics)}};
        std::printf("%s\n", out.dump(2).c_str());
        return 0;
    }
    print_report("irradiance volumes", irradiance, volumes);
    print_report("reflection probes", reflection, probes);
    if (!options.output.empty()) print_pictures(pictures, options.output);
    return 0;
}

}  // namespace

void add_bake_probes(CLI::App& bake, Action& action) {
    auto options = std::make_shared<BakeProbesOptions>();
    CLI::App* command = bake.add_subcommand(
        "probes", "Fill the cache with what a stage's irradiance volumes and reflection probes hold");
    command->add_option("SCENE", options->job.scene_file, "A .gltf or .glb file");
    add_scene_options(*command, options->job);
    command->add_option("--profile", options->job.profile, "Of the pictures to come");
    command
        ->add_option("--device", options->job.device,
                     "Of the pictures to come: auto, cpu, an index or a name")
        ->capture_default_str();
    command->add_option("--samples", options->local.samples, "Paths of each probe of a volume")
        ->check(CLI::Range(16u, 1u << 20))
        ->capture_default_str();
    command->add_flag("--refresh", options->local.refresh, "Even if the cache has them");
    add_shadow_options(*command, options->job.shadows);
    command->add_option("-o,--output", options->output,
                        "A folder for pictures of what the reflection probes see");
    command->add_flag("--json", options->json, "Print one JSON object on standard output");
    command->callback([options, command, &action] {
        check_environment_options(*command, options->job);
        check_shadow_options(*command, options->job.shadows, "realtime");
        action = [options] { return bake_probes(*options); };
    });
}

}  // namespace candela::app
