#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "bake_dfg.hpp"
#include "bake_environment.hpp"
#include "bake_lobes.hpp"
#include "bake_probes.hpp"
#include "candela/bake/ltc_fit.hpp"
#include "candela/io/image_write_safe.hpp"
#include "candela/io/output_folder.hpp"
#include "candela/scene/error.hpp"
#include "candela/version.hpp"
#include "command.hpp"
#include "job.hpp"
#include "option_rules.hpp"
#include "progress_line.hpp"
#include "shading/lights/ltc.glsl"
#include "sky_option.hpp"

namespace candela::app {
namespace {

struct BakeOptions {
    std::string what;
    std::string output;
    BakeEnvironmentOptions environment;
    std::string visibility = "correlated";
    std::uint32_t dfg_size = 128;
    bool json = false;
};

/// What tables take; an environment takes all but these.
const std::vector<std::string> kOfDfg{"--visibility", "--dfg-size"};
const std::vector<std::string> kOfEnvironments{
    "--env-layout", "--env-cube", "--env-layer", "--env-negative", "--size",
    "--levels",     "--mapping",  "--technique", "--samples",      "--irradiance-size",
    "--preset",     "--format",   "--env-scale", "--env-rotate"};

bool is_table(const std::string& what) {
    return what == "ltc" || what == "lobes" || what == "dfg";
}

void check_options(const CLI::App& command, const BakeOptions& options) {
    if (is_table(options.what))
        refuse_without_effect(command, kOfEnvironments, "on " + options.what + ": it is of environments",
                              options.what == "dfg" ? "--dfg-size, --visibility" : "-o FILE");
    if (options.what != "dfg") refuse_without_effect(command, kOfDfg, "but on dfg", "candela bake dfg");
    if (is_table(options.what)) return;
    check_environment_reading(command, options.what);
    check_bake_environment_options(command, options.environment);
}

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
        throw Error(Fault::usage, "the table is binary; its metadata gets this ending", file.string(),
                    "-o ltc_table.bin");
    // Opened before the work, so that a folder that is not there is said at once.
    io::detail::SafeFile table_file(file);
    io::detail::SafeFile metadata_file(std::filesystem::path(file).replace_extension(".json"));
    const bake::LtcTable table = [] {
        ProgressLine line("fitting transformed cosines");
        return bake::fit_ltc_table(line.function());
    }();
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
        print_written(file);
    }
    return 0;
}

int bake(const BakeOptions& options) {
    if (options.what.empty())
        throw Error(Fault::usage, "needs what to bake", "candela bake",
                    "candela bake ENV.exr, candela bake probes SCENE, candela bake ltc, lobes or dfg");
    if (options.what == "ltc") return bake_ltc(options);
    if (options.what == "lobes") return bake_lobes(options.output, options.json);
    if (options.what == "dfg")
        return bake_dfg_table(options.output, options.visibility, options.dfg_size, options.json);
    const bool template_name = options.what.find('{') != std::string::npos;
    const bool made = options.what == "studio" || sky_of_option(options.what);
    if (!made && !template_name && !std::filesystem::exists(options.what))
        throw input_error("there is no table and no environment '" + options.what + "' to bake",
                          "candela bake",
                          "candela bake ltc, candela bake lobes, candela bake dfg, or candela bake ENV.exr, "
                          "studio or sky:KEY=VALUE,...");
    BakeEnvironmentOptions environment = options.environment;
    environment.environment = options.what;
    environment.folder = options.output.empty() ? "environment" : options.output;
    io::check_output_folder(environment.folder);
    environment.json = options.json;
    return bake_environment(environment);
}

void add_environment_options(CLI::App& command, BakeOptions& options) {
    BakeEnvironmentOptions& e = options.environment;
    const char* group = "Environments";
    add_environment_file_options(command, e.how);
    command
        .add_option("--size", e.size,
                    "Texels a side of the finest level (256); with threejs: of the cube that the "
                    "picture goes through (none: as it is)")
        ->check(power_of_two(1, 4096))
        ->group(group);
    command.add_option("--levels", e.levels, "Levels; 0: down to one texel, or what the preset ends with")
        ->check(CLI::Range(0u, 13u))
        ->group(group);
    command.add_option("--mapping", e.mapping, "Roughness of a level: linear, frostbite or filament")
        ->group(group);
    command
        .add_option("--technique", e.technique,
                    "harmonic (default), filtered-importance, ggx-importance or cosine-power")
        ->group(group);
    command.add_option("--samples", e.samples, "Samples a texel where the technique draws")
        ->check(CLI::Range(1u, 1u << 20))
        ->group(group);
    command.add_option("--irradiance-size", e.irradiance_size, "Texels a side of the irradiance (32)")
        ->check(CLI::Range(1u, 512u))
        ->group(group);
    command.add_option("--preset", e.preset, "Whose conventions: candela, filament, threejs or gltf")
        ->group(group);
    command.add_option("--format", e.format, "With candela: ktx2, ktx2-rgb9e5, dds, exr or exr-faces")
        ->group(group);
    command.add_option("--env-scale", e.scale, "Multiplies the environment")
        ->check(number_in(1e-9, 1e9))
        ->group(group);
    command.add_option("--env-rotate", e.rotate_deg, "Turns it about +Y, degrees")
        ->check(number_in(-36000.0, 36000.0))
        ->group(group);
}

}  // namespace

void add_bake(CLI::App& app, Action& action) {
    auto options = std::make_shared<BakeOptions>();
    CLI::App* command =
        app.add_subcommand("bake", "Filter environments and compute tables that rendering reads");
    command->add_option(
        "WHAT", options->what,
        "An environment (.exr, .hdr, .ktx2, .dds, studio) to filter; ltc: the matrices of linearly "
        "transformed cosines; lobes: reads of environments along the lobe; dfg: directional albedos");
    add_bake_probes(*command, action);
    command->add_option("-o,--output", options->output,
                        "Folder for an environment (environment); file for a table (ltc_table.bin, "
                        "dfg_table.exr; lobes: none unless said), "
                        "its metadata beside it as .json");
    add_environment_options(*command, *options);
    command->add_option("--visibility", options->visibility, "With dfg: correlated, uncorrelated or schlick");
    command->add_option("--dfg-size", options->dfg_size, "With dfg: texels a side (128)")
        ->check(CLI::Range(2u, 1024u));
    command->add_flag("--json", options->json, "Print one JSON object on standard output");
    command->callback([options, command, &action] {
        refuse_before_subcommand(*command);
        if (!command->get_subcommands().empty()) return;
        check_options(*command, *options);
        options->environment.size_given = command->count("--size") > 0;
        action = [options] { return bake(*options); };
    });
}

}  // namespace candela::app
