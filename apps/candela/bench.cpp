#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench_bake.hpp"
#include "bench_start.hpp"
#include "candela/io/image_write.hpp"
#include "candela/io/output_folder.hpp"
#include "candela/scene/error.hpp"
#include "candela/version.hpp"
#include "command.hpp"
#include "job.hpp"
#include "local_light.hpp"
#include "option_rules.hpp"
#include "progress_line.hpp"

namespace candela::app {
namespace {

struct BenchOptions {
    JobOptions job;
    int frames = 60;
    std::string graph_file;  ///< .svg or .dot
    bool first_frame_only = false;
};

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double peak_host_mib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Median time of each pass over the frames, in the order of the frame.
std::vector<gpu::PassTime> median_passes(const std::vector<std::vector<gpu::PassTime>>& frames) {
    std::vector<gpu::PassTime> out = frames.back();
    for (std::size_t pass = 0; pass < out.size(); ++pass) {
        std::vector<double> times;
        for (const auto& frame : frames) {
            if (pass < frame.size()) times.push_back(frame[pass].milliseconds);
        }
        out[pass].milliseconds = median(times);
    }
    return out;
}

void write_graph(const std::string& file, const realtime::Renderer& renderer,
                 std::span<const gpu::PassTime> times) {
    using Picture = realtime::Renderer::GraphPicture;
    const bool svg = std::filesystem::path(file).extension() == ".svg";
    const std::string text = renderer.frame_graph(svg ? Picture::svg : Picture::dot, times);
    io::write_file(file, std::as_bytes(std::span(text)));
    print_written({file});
}

int bench(const BenchOptions& options) {
    if (!options.graph_file.empty()) io::check_output_file(options.graph_file);
    const auto start = Clock::now();
    Job job = prepare(options.job);
    const double load_ms = milliseconds_since(start);
    const gpu::Device device(device_options(options.job));
    realtime::RendererOptions renderer_options;
    renderer_options.width = job.width;
    renderer_options.height = job.height;
    renderer_options.profile = job.profile;
    renderer_options.tone_curve = job.tone_curve;
    renderer_options.half_light = true;
    renderer_options.shadows = {shadows_of(options.job.shadows, "realtime") == Shadows::map,
                                options.job.shadows.atlas_texels};
    fill_local_light(device, job, renderer_options.shadows);
    std::vector<double> frame_ms;
    std::vector<std::vector<gpu::PassTime>> passes;
    {
        ProgressLine line("drawing frames");
        realtime::Renderer renderer(device, job.scene, renderer_options);
        (void)renderer.render_frame(job.camera, job.exposure);
        if (options.first_frame_only) {
            report_first_frame();
            return 0;
        }
        for (int i = 0; i < options.frames; ++i) {
            const auto frame = Clock::now();
            passes.push_back(renderer.render_frame(job.camera, job.exposure));
            frame_ms.push_back(milliseconds_since(frame));
            line.report((i + 1.0) / options.frames);
        }
        if (!options.graph_file.empty()) write_graph(options.graph_file, renderer, median_passes(passes));
        warn_of_unshadowed(renderer.unshadowed_lights(), job.diagnostics);
    }
    const std::vector<gpu::PassTime> pass_ms = median_passes(passes);
    const double device_mib = static_cast<double>(device.peak_memory_bytes()) / (1024.0 * 1024.0);
    const double host_mib = peak_host_mib();
    const StartTimes starts = [] {
        const ProgressLine line("starting twice");
        return measure_starts();
    }();
    if (options.job.json) {
        const nlohmann::json out{{"version", version()},
                                 {"device", device_line(device.info())},
                                 {"width", job.width},
                                 {"height", job.height},
                                 {"triangles", scene::triangle_count(job.scene)},
                                 {"lights", job.scene.lights.size()},
                                 {"load_ms", load_ms},
                                 {"start_to_first_frame_ms_cold", starts.cold_ms},
                                 {"start_to_first_frame_ms_warm", starts.warm_ms},
                                 {"frames", options.frames},
                                 {"frame_ms_median", median(frame_ms)},
                                 {"frame_ms_min", *std::min_element(frame_ms.begin(), frame_ms.end())},
                                 {"frame_ms_max", *std::max_element(frame_ms.begin(), frame_ms.end())},
                                 {"passes", pass_times_json(pass_ms)},
                                 {"peak_host_mib", host_mib},
                                 {"peak_device_mib", device_mib},
                                 {"warnings", warnings_json(job.diagnostics)}};
        std::printf("%s\n", out.dump(2).c_str());
        return 0;
    }
    std::printf("%s, %ux%u, %zu triangles, %zu lights\n", device_line(device.info()).c_str(), job.width,
                job.height, scene::triangle_count(job.scene), job.scene.lights.size());
    std::printf("start to first frame  %8.1f ms cold, %.1f ms warm (loading %.1f)\n", starts.cold_ms,
                starts.warm_ms, load_ms);
    std::printf("frame, median of %-4d %8.2f ms\n", options.frames, median(frame_ms));
    for (const gpu::PassTime& pass : pass_ms)
        std::printf("  %-18s  %8.2f ms\n", pass.name.c_str(), pass.milliseconds);
    std::printf("peak memory           %8.1f MiB host, %.1f MiB device\n", host_mib, device_mib);
    print_warnings(job.diagnostics);
    return 0;
}

}  // namespace

void add_bench(CLI::App& app, Action& action) {
    auto options = std::make_shared<BenchOptions>();
    CLI::App* command = app.add_subcommand("bench", "Measure start-up, per-pass times and memory");
    command->add_option("SCENE", options->job.scene_file, "A .gltf or .glb file");
    add_scene_options(*command, options->job);
    add_picture_options(*command, options->job);
    add_device_options(*command, options->job);
    add_bench_bake(*command, action);
    command->add_option("--frames", options->frames, "Frames to take the median of")
        ->check(CLI::Range(1, 100000));
    command->add_option("--graph", options->graph_file,
                        "Write the frame's graph: passes, images, buffers, bytes and times (.svg or .dot)");
    command->add_flag(kFirstFrameOnly, options->first_frame_only, "Leave after the first frame")->group("");
    command->callback([command, options, &action] {
        refuse_before_subcommand(*command);
        if (!command->get_subcommands().empty()) return;
        if (options->job.scene_file.empty()) throw CLI::RequiredError("SCENE");
        const auto kind = std::filesystem::path(options->graph_file).extension();
        if (!options->graph_file.empty() && kind != ".svg" && kind != ".dot")
            throw Error(Fault::usage, "takes a .svg or .dot file", "--graph");
        check_environment_options(*command, options->job);
        check_picture_options(*command);
        check_shadow_options(*command, options->job.shadows, "realtime");
        action = [options] { return bench(*options); };
    });
}

}  // namespace candela::app
