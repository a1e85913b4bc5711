#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "bake_lobes.hpp"
#include "candela/bake/ltc_fit.hpp"
#include "candela/io/image_write_safe.hpp"
#include "candela/scene/error.hpp"
#include "candela/version.hpp"
#include "command.hpp"
#include "shading/lights/ltc.glsl"

namespace candela::app {
namespace {

struct BakeOptions {
    std::string what;
    std::string output;
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

int bake(const BakeOptions& options) {
    if (options.what == "lobes") return bake_lobes(options.output, options.json);
    if (options.what != "ltc")
        throw input_error("there is no table '" + options.what + "' to bake", "candela bake",
                          "candela bake ltc or candela bake lobes");
    return bake_ltc(options);
}

}  // namespace

void add_bake(CLI::App& app, Action& action) {
    auto options = std::make_shared<BakeOptions>();
    CLI::App* command = app.add_subcommand("bake", "Compute tables that rendering reads");
    command
        ->add_option(
            "what", options->what,
            "ltc: the matrices of linearly transformed cosines; lobes: reads of environments along the lobe")
        ->required();
    command->add_option("-o,--output", options->output,
                        "File for the table (ltc_table.bin; lobes: JSON, none unless said); its metadata "
                        "goes beside it, as .json");
    command->add_flag("--json", options->json, "Print one JSON object on standard output");
    command->callback([options, &action] { action = [options] { return bake(*options); }; });
}

}  // namespace candela::app
