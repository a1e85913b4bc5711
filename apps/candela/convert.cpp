#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "candela/io/gltf_write.hpp"
#include "candela/io/output_folder.hpp"
#include "candela/scene/error.hpp"
#include "command.hpp"
#include "job.hpp"
#include "progress_line.hpp"

namespace candela::app {
namespace {

struct ConvertOptions : SceneFileOptions {
    std::string out_file;
    bool json = false;
};

void check_output(const ConvertOptions& options) {
    const std::filesystem::path out(options.out_file);
    if (out.extension() != ".gltf" && out.extension() != ".glb")
        throw Error(Fault::usage, "not a name of a glTF file: " + options.out_file, "-o",
                    "FILE.gltf or FILE.glb");
    std::error_code ignored;
    if (std::filesystem::equivalent(out, options.scene_file, ignored))
        throw Error(Fault::usage, "the scene would overwrite itself", "-o", "another name");
}

void warn_of_the_stage(const io::Stage& stage, Diagnostics& diagnostics) {
    if (stage.environment && !stage.environment->none)
        diagnostics.warn("glTF cannot carry the stage's environment");
    if (!stage.exposure.automatic()) diagnostics.warn("glTF cannot carry the stage's exposure");
    if (!stage.probes.reflection.empty() || !stage.probes.irradiance.empty())
        diagnostics.warn("glTF cannot carry the stage's probes");
    if (stage.camera.look_from) diagnostics.warn("the stage's camera is not written");
}

int convert(const ConvertOptions& options) {
    check_output(options);
    io::check_output_file(options.out_file);
    Diagnostics diagnostics;
    const StagedScene staged = load_staged_scene(options, diagnostics);
    refuse_warnings(options, diagnostics);
    warn_of_the_stage(staged.stage, diagnostics);
    {
        const ProgressLine line("writing");
        io::write_gltf(options.out_file, staged.scene, diagnostics);
    }
    print_warnings(diagnostics);
    if (options.json) {
        const nlohmann::json out{{"file", options.out_file}, {"warnings", warnings_json(diagnostics)}};
        std::printf("%s\n", out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    } else {
        print_written(options.out_file);
    }
    return 0;
}

}  // namespace

void add_convert(CLI::App& app, Action& action) {
    auto options = std::make_shared<ConvertOptions>();
    CLI::App* command = app.add_subcommand(
        "convert", "Write a scene with its stage's lights as glTF, as it stands at --time");
    command->add_option("SCENE", options->scene_file, "A .gltf or .glb file")->required();
    command->add_option("-o,--output", options->out_file, "FILE.gltf (with FILE.bin) or FILE.glb")
        ->required();
    add_scene_file_options(*command, *options);
    command->add_flag("--json", options->json, "Print one JSON object on standard output");
    command->callback([options, &action] { action = [options] { return convert(*options); }; });
}

}  // namespace candela::app
