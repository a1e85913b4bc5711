#include "compare_pictures.hpp"

#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <set>
#include <sstream>

#include "candela/io/image_read.hpp"
#include "candela/io/luminance_read.hpp"
#include "candela/scene/error.hpp"
#include "candela/version.hpp"
#include "frame_mode.hpp"
#include "option_rules.hpp"
#include "path_mode.hpp"

namespace candela::app {
namespace {

constexpr std::size_t max_picture_bytes = std::size_t{1} << 30;

std::string text_of(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", static_cast<double>(value));
    return text;
}

using Settings = std::vector<std::pair<std::string, std::string>>;

/// "slot=technique slot=technique" becomes one line a slot, so that two pictures can be told apart at a
/// glance.
void add_setting(Settings& settings, const std::string& key, const std::string& value) {
    if (key != "techniques") {
        settings.emplace_back(key, value);
        return;
    }
    std::istringstream words(value);
    for (std::string word; words >> word;) {
        const std::size_t equals = word.find('=');
        if (equals != std::string::npos)
            settings.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
}

/// Settings without the prefix that tells our attributes from others'.
Settings settings_of(const std::string& file, const std::map<std::string, io::ExrAttribute>& attributes) {
    Settings out{{"file", file}};
    const std::string prefix = "candela/";
    static const std::set<std::string> of_the_format{"pixelAspectRatio", "screenWindowWidth", "type",
                                                     "whiteLuminance"};
    for (const auto& [name, value] : attributes) {
        if (of_the_format.contains(name)) continue;
        const std::string key = name.starts_with(prefix) ? name.substr(prefix.size()) : name;
        const float* number = std::get_if<float>(&value);
        add_setting(out, key, number != nullptr ? text_of(*number) : std::get<std::string>(value));
    }
    return out;
}

NamedPicture load_luminance(const std::string& file, Diagnostics& diagnostics) {
    io::LuminanceImage image = io::read_luminance(file, diagnostics);
    NamedPicture out;
    out.name = std::filesystem::path(file).stem().string();
    out.picture = {image.width, image.height, std::move(image.luminance_nit)};
    out.settings = settings_of(file, image.attributes);
    if (const auto found = image.attributes.find("candela/exposure"); found != image.attributes.end()) {
        const float* exposure = std::get_if<float>(&found->second);
        if (exposure != nullptr && *exposure > 0.0f && std::isfinite(*exposure)) out.exposure = *exposure;
    }
    return out;
}

NamedPicture load_display(const std::string& file, Diagnostics& diagnostics) {
    const scene::Image image = io::decode_image(io::read_file(file, max_picture_bytes), file);
    NamedPicture out;
    out.name = std::filesystem::path(file).stem().string();
    out.meaning = measure::PixelMeaning::display;
    out.settings = settings_of(file, {});
    out.picture = {image.width, image.height,
                   std::vector<glm::vec3>(std::size_t{image.width} * image.height)};
    bool transparent = false;
    for (std::size_t i = 0; i < out.picture.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            out.picture.pixels[i][int(c)] = static_cast<float>(image.rgba[4 * i + c]) / 255.0f;
        transparent = transparent || image.rgba[4 * i + 3] != 255;
    }
    if (transparent) diagnostics.warn(file + ": its alpha is left out; colours are compared as stored");
    return out;
}

NamedPicture named(const std::string& name, const std::string& mode, const realtime::Still& still,
                   const Job& job, const std::string& device, std::uint32_t samples, std::uint32_t seed) {
    NamedPicture out;
    out.name = name;
    out.picture = {still.width, still.height, {}};
    for (const glm::vec4& nit : still.planes.light_nit) out.picture.pixels.emplace_back(nit);
    out.exposure = still.exposure;
    out.settings = {{"mode", mode},
                    {"profile", job.profile.name},
                    {"samples", std::to_string(samples)},
                    {"seed", std::to_string(seed)},
                    {"ev100", text_of(still.ev100)},
                    {"device", device},
                    {"version", version()}};
    add_setting(out.settings, "techniques", realtime::describe(job.profile));
    return out;
}

/// One way to make a picture of the scene.
struct SceneSource {
    std::string name;
    std::shared_ptr<Job> job;
    std::function<NamedPicture(const gpu::Device&)> render;
};

SceneSource path_source(const SceneOptions& options, const std::shared_ptr<Job>& job) {
    return {"path", job, [job, options](const gpu::Device&) {
                PathModeOptions path;
                path.samples = options.path_samples;
                path.direct_only = options.direct_only;
                path.shadows = options.job.shadows.way != "none";
                const PathModePicture picture = render_by_path(*job, options.job, path, {});
                NamedPicture out = named("path", "path", picture.still, *job, picture.info.device,
                                         picture.info.samples, options.job.seed);
                if (options.direct_only) out.settings.emplace_back("light", "direct only");
                out.settings.emplace_back("estimated relative error",
                                          text_of(static_cast<float>(picture.error)));
                return out;
            }};
}

SceneSource device_source(const SceneOptions& options, const std::shared_ptr<Job>& job, bool integrate) {
    const std::string name = integrate ? "integrate" : job->profile.name;
    const bool none = options.job.shadows.way == "none";
    const Shadows shadows = none ? Shadows::none : integrate ? Shadows::ray : Shadows::map;
    return {name, job, [job, options, integrate, name, shadows](const gpu::Device& device) {
                const std::uint32_t samples = integrate ? options.integrate_samples : options.samples;
                const FrameModeStill frame = render_on_device(
                    device, *job,
                    {integrate, samples, options.job.seed, false, shadows, options.job.shadows.atlas_texels});
                warn_of_unshadowed(frame.unshadowed_lights, job->diagnostics);
                return named(name, integrate ? "integrate" : "realtime", frame.still, *job,
                             device_line(device.info()), samples, options.job.seed);
            }};
}

/// The path tracer's picture first, as the reference, then the frame's integrals in full, then the frame
/// under each profile; the first two with the material model of the first profile.
std::vector<SceneSource> scene_sources(const SceneOptions& options) {
    std::vector<SceneSource> out;
    for (const std::string& profile : options.profiles) {
        JobOptions job_options = options.job;
        job_options.profile = profile;
        const auto job = std::make_shared<Job>(prepare(job_options));
        if (out.empty()) {
            if (options.truth) out.push_back(path_source(options, job));
            if (options.truth) out.push_back(device_source(options, job, true));
        }
        out.push_back(device_source(options, job, false));
    }
    return out;
}

/// Options of the command that say nothing about pictures that are there.
std::vector<std::string> options_of_scenes(const CLI::App& command) {
    static const std::set<std::string> of_pictures{"--output",   "--threshold",        "--names",
                                                   "--exposure", "--tonemap",          "--json",
                                                   "--help",     "--pixels-per-degree"};
    std::vector<std::string> out;
    for (const CLI::Option* option : command.get_options()) {
        if (!option->get_positional() && !of_pictures.contains(option->get_name()))
            out.push_back(option->get_name());
    }
    return out;
}

}  // namespace

void add_compared_scene_options(CLI::App& command, SceneOptions& o) {
    JobOptions& job = o.job;
    add_scene_options(command, job);
    add_picture_options(command, job);
    add_device_options(command, job);
    command.remove_option(command.get_option("--profile"));
    command
        .add_option(
            "--profile", o.profiles,
            "Of a scene (best); may be given several times; truth has the material model of the first")
        ->allow_extra_args(false)
        ->take_all();
    command.add_option("--samples,--spp", o.samples, "Samples a pixel of a scene's real-time frame")
        ->check(CLI::Range(1u, 4096u))
        ->capture_default_str();
    command.add_option("--path-spp", o.path_samples, "Samples a pixel of the path tracer")
        ->check(CLI::Range(1u, 1u << 24))
        ->capture_default_str();
    command.add_option("--integrate-spp", o.integrate_samples, "Samples a pixel of the integrator")
        ->check(CLI::Range(1u, 4096u))
        ->capture_default_str();
    command.add_flag("--direct-only", o.direct_only,
                     "Path: only light straight from its source, as the frame has it, with shadows");
    command.add_flag_callback(
        "--no-truth", [&o] { o.truth = false; },
        "Leave path and integrate out: the first profile is the reference");
}

void check_compare_options(const CLI::App& command, const SceneOptions& options, bool scene) {
    if (!scene)
        return refuse_without_effect(command, options_of_scenes(command), "on pictures",
                                     "candela compare SCENE.glb");
    check_environment_options(command, options.job);
    check_picture_options(command);
    check_shadow_options(command, options.job.shadows, "realtime");
    if (!options.job.shadows.way.empty() && options.job.shadows.way != "none")
        throw Error(Fault::usage, "has no effect: each mode has its own way", "--shadows",
                    "--shadows none, for pictures without any");
    if (!options.truth)
        refuse_without_effect(command, {"--path-spp", "--integrate-spp", "--direct-only"}, "with --no-truth");
    for (const char* exposure :
         {"--ev100", "--aperture", "--shutter", "--iso", "--auto-exposure", "--exposure-compensation"})
        refuse_together(command, {"--exposure", exposure});
}

NamedPicture load_picture(const std::string& file, Diagnostics& diagnostics) {
    return io::is_luminance_file(file) ? load_luminance(file, diagnostics) : load_display(file, diagnostics);
}

std::vector<NamedPicture> render_pictures(const SceneOptions& options, Diagnostics& diagnostics) {
    const std::vector<SceneSource> sources = scene_sources(options);
    const gpu::Device device(device_options(options.job));
    std::fprintf(stderr, "candela: device: %s\n", device_line(device.info()).c_str());
    std::vector<NamedPicture> out;
    for (const SceneSource& source : sources) out.push_back(source.render(device));
    // With what came up while rendering; of one profile, as the others would repeat it.
    diagnostics = sources.front().job->diagnostics;
    return out;
}

}  // namespace candela::app
