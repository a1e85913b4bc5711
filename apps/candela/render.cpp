#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "candela/scene/error.hpp"
#include "candela/version.hpp"
#include "command.hpp"
#include "job.hpp"
#include "picture_files.hpp"

namespace candela::app {
namespace {

struct RenderOptions {
    JobOptions job;
    PictureFileOptions files;
    std::uint32_t samples = 0;  ///< 0: what suits the mode
    std::string mode = "realtime";
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void throw_validation(const gpu::Device& device) {
    const auto messages = device.validation_messages();
    if (!messages.empty()) throw machine_error("validation: " + messages.front());
}

std::uint32_t default_samples(const std::string& mode) {
    return mode == "integrate" ? 64 : 4;
}

int render(RenderOptions options) {
    const auto start = std::chrono::steady_clock::now();
    if (options.files.outputs.empty()) options.files.outputs = {"out.png"};
    check_outputs(options.files);
    if (options.samples == 0) options.samples = default_samples(options.mode);
    Job job = prepare(options.job);
    const double load_s = seconds_since(start);

    const gpu::Device device(device_options(options.job));
    const std::string device_text = device_line(device.info());
    std::fprintf(stderr, "candela: device: %s\n", device_text.c_str());
    realtime::Still still;
    double setup_s = 0.0;
    double render_s = 0.0;
    {
        realtime::RendererOptions renderer_options;
        renderer_options.width = job.width;
        renderer_options.height = job.height;
        renderer_options.samples = options.samples;
        renderer_options.seed = options.job.seed;
        renderer_options.profile = job.profile;
        renderer_options.tone_curve = job.tone_curve;
        renderer_options.aovs = !options.files.aovs.empty();
        if (options.mode == "integrate") renderer_options.integrate.emplace();
        const auto setup = std::chrono::steady_clock::now();
        realtime::Renderer renderer(device, job.scene, renderer_options);
        setup_s = seconds_since(setup);
        const auto draw = std::chrono::steady_clock::now();
        still = renderer.render_still(job.camera, job.exposure);
        render_s = seconds_since(draw);
    }
    if (options.job.validation) throw_validation(device);
    if (job.exposure.automatic() && !still.metered) {
        job.diagnostics.warn("the picture is black: nothing to meter (no light, or nothing in view)");
    }
    const auto write = std::chrono::steady_clock::now();
    write_pictures(options.files, job, still, {device_text, options.samples, options.job.seed, options.mode});
    const double write_s = seconds_since(write);

    print_warnings(job.diagnostics);
    if (options.job.json) {
        const nlohmann::json out{
            {"outputs", options.files.outputs},
            {"version", version()},
            {"device", device_text},
            {"mode", options.mode},
            {"profile", job.profile.name},
            {"techniques", realtime::describe(job.profile)},
            {"width", still.width},
            {"height", still.height},
            {"samples", options.samples},
            {"ev100", still.ev100},
            {"exposure", still.exposure},
            {"automatic_exposure", job.exposure.automatic()},
            {"seconds", {{"load", load_s}, {"setup", setup_s}, {"render", render_s}, {"write", write_s}}},
            {"passes", pass_times_json(still.pass_times)},
            {"warnings", warnings_json(job.diagnostics)}};
        std::printf("%s\n", out.dump(2).c_str());
    } else {
        for (const std::string& file : options.files.outputs) {
            std::fprintf(stderr, "candela: wrote %s (%ux%u, EV100 %.2f%s)\n", file.c_str(), still.width,
                         still.height, static_cast<double>(still.ev100),
                         job.exposure.automatic() ? ", metered" : "");
        }
    }
    return 0;
}

}  // namespace

void add_render(CLI::App& app, Action& action) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "Render a glTF scene to PNG and EXR");
    command->add_option("SCENE", options->job.scene_file, "A .gltf or .glb file")->required();
    command
        ->add_option("-o,--output", options->files.outputs,
                     "FILE.png or FILE.exr; may be given several times")
        ->take_all();
    add_scene_options(*command, options->job);
    add_picture_options(*command, options->job);
    add_device_options(*command, options->job);
    command->add_option("--samples,--spp", options->samples, "Samples a pixel [4, or 64 to integrate]")
        ->check(CLI::Range(1u, 4096u));
    command->add_option("--mode", options->mode, "How light is found")
        ->check(CLI::IsMember({"realtime", "integrate"}))
        ->capture_default_str();
    command->add_option("--png-bits", options->files.png_bits, "8 or 16")->check(CLI::IsMember({8, 16}));
    command->add_option("--exr-type", options->files.exr_type, "half or float")
        ->check(CLI::IsMember({"half", "float"}));
    command->add_option("--aov", options->files.aovs, "Layers of EXR files, separated by commas, or all")
        ->delimiter(',');
    command->callback([options, &action] { action = [options] { return render(*options); }; });
}

}  // namespace candela::app
