#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "candela/io/output_folder.hpp"
#include "candela/scene/error.hpp"
#include "candela/scene/printable.hpp"
#include "candela/version.hpp"
#include "command.hpp"
#include "emission_units.hpp"
#include "exposure_advice.hpp"
#include "frame_mode.hpp"
#include "job.hpp"
#include "path_mode.hpp"
#include "picture_files.hpp"
#include "progress_line.hpp"

namespace candela::app {
namespace {

struct RenderOptions {
    JobOptions job;
    PictureFileOptions files;
    PathModeOptions path;
    std::optional<std::uint32_t> samples;
    std::string mode = "realtime";
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void throw_validation(const gpu::Device& device) {
    const auto messages = device.validation_messages();
    if (!messages.empty()) throw machine_error("validation: " + messages.front());
}

using Seconds = std::map<std::string, double>;

realtime::Still render_frame_still(const RenderOptions& options, Job& job, PictureInfo& info,
                                   Seconds& seconds) {
    const bool integrate = options.mode == "integrate";
    const gpu::Device device(device_options(options.job));
    info.device = device_line(device.info());
    info.samples = options.samples.value_or(default_samples(integrate));
    std::fprintf(stderr, "candela: device: %s\n", info.device.c_str());
    const Shadows shadows = shadows_of(options.job.shadows, options.mode);
    info.settings["shadows"] = name_of(shadows);
    FrameModeStill frame = render_on_device(
        device, job,
        {integrate, info.samples, options.job.seed, !options.files.aovs.empty(), shadows,
         options.job.shadows.atlas_texels, integrate ? "rendering by integrate" : "rendering"});
    warn_of_unshadowed(frame.unshadowed_lights, job.diagnostics);
    seconds["setup"] = frame.setup_s;
    seconds["render"] = frame.render_s;
    if (options.job.validation) throw_validation(device);
    return std::move(frame.still);
}

nlohmann::json result_json(const RenderOptions& options, const Job& job, const realtime::Still& still,
                           const PictureInfo& info, const Seconds& seconds) {
    return {{"outputs", options.files.outputs},
            {"version", version()},
            {"mode", info.mode},
            {"device", info.device},
            {"profile", job.profile.name},
            {"techniques", realtime::describe(job.profile)},
            {"width", still.width},
            {"height", still.height},
            {"samples", info.samples},
            {"ev100", still.ev100},
            {"exposure", still.exposure},
            {"automatic_exposure", job.exposure.automatic()},
            {"units", emission_units_json(job.emission)},
            {"seconds", seconds},
            {"passes", pass_times_json(still.pass_times)},
            {"warnings", warnings_json(job.diagnostics)}};
}

void check_mode(const RenderOptions& options) {
    (void)shadows_of(options.job.shadows, options.mode);
    if (options.mode == "path") return;
    if (options.samples.value_or(1) > 4096) throw Error(Fault::usage, "more than 4096 samples", "--spp");
    for (const std::string& aov : options.files.aovs) {
        if (aov == "variance" || aov == "sample_count") {
            throw Error(Fault::usage, "only the path tracer has " + aov, "--aov", "--mode path");
        }
    }
}

void check_options(const CLI::App& command, const RenderOptions& options) {
    check_environment_options(command, options.job);
    check_picture_options(command);
    check_shadow_options(command, options.job.shadows, options.mode);
    check_path_options(command, options.job.shadows, options.mode);
    check_picture_file_options(command, options.files);
}

int render(RenderOptions options) {
    const auto start = std::chrono::steady_clock::now();
    check_outputs(options.files);
    if (!options.path.checkpoint.empty()) io::check_output_file(options.path.checkpoint);
    check_mode(options);
    Job job = prepare(options.job);
    Seconds seconds{{"load", seconds_since(start)}};

    PictureInfo info;
    info.mode = options.mode;
    info.seed = options.job.seed;
    realtime::Still still;
    std::string note;
    std::string finished_checkpoint;
    std::optional<double> error;
    bool finished = true;
    if (options.mode == "path") {
        options.path.samples = options.samples;
        options.path.shadows = shadows_of(options.job.shadows, options.mode) == Shadows::ray;
        const auto draw = std::chrono::steady_clock::now();
        PathModePicture picture = render_by_path(job, options.job, options.path, options.files);
        if (!picture.writes) return 0;
        seconds["render"] = seconds_since(draw);
        still = std::move(picture.still);
        info = std::move(picture.info);
        note = "; " + picture.note;
        error = picture.error;
        finished_checkpoint = picture.checkpoint;
        finished = picture.finished;
    } else {
        still = render_frame_still(options, job, info, seconds);
    }
    if (job.exposure.automatic() && !still.metered) {
        job.diagnostics.warn("the picture is black: nothing to meter (no light, or nothing in view)");
    }
    advise_exposure(job, still);
    const auto write = std::chrono::steady_clock::now();
    {
        const ProgressLine line("writing");
        write_pictures(options.files, job, still, info);
    }
    if (!finished_checkpoint.empty()) {
        std::error_code ignored;
        std::filesystem::remove(finished_checkpoint, ignored);
    }
    seconds["write"] = seconds_since(write);

    print_warnings(job.diagnostics);
    if (options.job.json) {
        nlohmann::json out = result_json(options, job, still, info, seconds);
        if (error) out["estimated_relative_error"] = *error;
        out["finished"] = finished;
        std::printf("%s\n", out.dump(2).c_str());
    } else {
        for (const std::string& file : options.files.outputs) {
            std::fprintf(stderr, "candela: wrote %s (%ux%u, EV100 %.2f%s%s)\n", printable(file).c_str(),
                         still.width, still.height, static_cast<double>(still.ev100),
                         job.exposure.automatic() ? ", metered" : "", note.c_str());
        }
    }
    return 0;
}

}  // namespace

void add_render(CLI::App& app, Action& action) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "Render a glTF scene to PNG and EXR");
    command->add_option("SCENE", options->job.scene_file, "A .gltf or .glb file")->required();
    command->add_option("-o,--output", options->files.outputs,
                        "FILE.png or FILE.exr; may be given several times (out.png)");
    add_scene_options(*command, options->job);
    add_picture_options(*command, options->job);
    add_device_options(*command, options->job);
    command
        ->add_option("--samples,--spp", options->samples,
                     "Samples a pixel (realtime 4, integrate 64, path 256)")
        ->check(CLI::Range(1u, 1u << 24));
    command
        ->add_option(
            "--mode", options->mode,
            "How light is found: realtime; integrate (the frame's integrals in full, on the device); path "
            "(ground truth with shadows and bounces, on the CPU)")
        ->check(CLI::IsMember({"realtime", "integrate", "path"}))
        ->capture_default_str();
    add_path_options(*command, options->path);
    command->add_option("--png-bits", options->files.png_bits, "8 or 16")->check(CLI::IsMember({8, 16}));
    command->add_option("--exr-type", options->files.exr_type, "half or float")
        ->check(CLI::IsMember({"half", "float"}));
    command->add_option("--aov", options->files.aovs, "Layers of EXR files, separated by commas, or all")
        ->delimiter(',');
    command->callback([options, command, &action] {
        if (options->files.outputs.empty()) options->files.outputs = {"out.png"};
        check_options(*command, *options);
        action = [options] { return render(*options); };
    });
}

}  // namespace candela::app
