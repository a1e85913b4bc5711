#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <set>

#include "candela/scene/error.hpp"
#include "candela/version.hpp"
#include "compare_pictures.hpp"
#include "exposure_advice.hpp"
#include "frame_mode.hpp"
#include "option_rules.hpp"
#include "path_mode.hpp"

namespace candela::app {
namespace {

using measure::LightPaths;
using measure::Picture;
using realtime::Aov;
using realtime::Still;

Picture picture_of(const Still& still, const std::vector<glm::vec4>& plane) {
    Picture out{still.width, still.height, {}};
    out.pixels.reserve(plane.size());
    for (const glm::vec4& pixel : plane) out.pixels.emplace_back(pixel);
    return out;
}

Picture picture_of(const Still& still, Aov aov) {
    return picture_of(still, still.planes.aovs[static_cast<std::size_t>(aov)]);
}

Picture combined(const Picture& a, const Picture& b, float weight_a, float weight_b) {
    Picture out = a;
    for (std::size_t i = 0; i < out.pixels.size(); ++i)
        out.pixels[i] = weight_a * a.pixels[i] + weight_b * b.pixels.at(i);
    return out;
}

Picture direct_of(const Still& still) {
    return combined(picture_of(still, Aov::direct_diffuse), picture_of(still, Aov::direct_specular), 1.0f,
                    1.0f);
}

Picture indirect_of(const Still& still) {
    return combined(picture_of(still, Aov::indirect_diffuse), picture_of(still, Aov::indirect_specular), 1.0f,
                    1.0f);
}

LightPaths paths_of(const Still& still) {
    return {picture_of(still, Aov::direct_diffuse),
            picture_of(still, Aov::direct_specular),
            picture_of(still, Aov::indirect_diffuse),
            picture_of(still, Aov::indirect_specular),
            picture_of(still, Aov::emissive),
            {},
            {}};
}

std::string seconds_text(double seconds) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.1f s", seconds);
    return text;
}

NamedPicture named(const std::string& name, const std::string& mode, const Still& still, const Job& job,
                   const std::string& device, const std::string& samples, const std::string& seed) {
    NamedPicture out;
    out.name = name;
    out.mode = mode;
    out.picture = picture_of(still, still.planes.light_nit);
    out.exposure = still.exposure;
    out.ev100 = still.ev100;
    out.settings = {{"mode", mode},        {"profile", job.profile.name},   {"samples", samples},
                    {"seed", seed},        {"ev100", text_of(still.ev100)}, {"device", device},
                    {"version", version()}};
    add_setting(out.settings, "techniques", realtime::describe(job.profile));
    return out;
}

/// One way to make a picture of the scene; `progress_label` is of what is shown while it lasts.
struct SceneSource {
    std::string name;
    std::shared_ptr<Job> job;
    std::function<NamedPicture(const gpu::Device&, const std::string& progress_label)> render;
};

/// The path tracer's pictures of one job: the truth in two halves, and one without shadows.
class TruthSource {
  public:
    TruthSource(const SceneOptions& options, Job& job, std::string label)
        : options_(options), job_(job), label_(std::move(label)) {}

    NamedPicture render() {
        const auto start = std::chrono::steady_clock::now();
        // Two halves of other seeds: half against whole differs as the whole does from what it converges to,
        // because the variance of half minus whole is that of the whole.
        const std::uint32_t half = options_.path_samples / 2;
        PathModePicture first =
            trace(options_.path_samples - half, options_.job.seed, options_.direct_only, true);
        Still whole = first.still;
        std::string samples = std::to_string(first.info.samples);
        std::string seed = std::to_string(options_.job.seed);
        double error = first.error;
        if (half > 0) {
            const scene::Exposure asked = job_.exposure;
            job_.exposure = {};
            job_.exposure.ev100 = first.still.ev100;
            const PathModePicture second = trace(half, options_.job.seed + 1, options_.direct_only, true);
            job_.exposure = asked;
            const auto all = static_cast<float>(options_.path_samples);
            average(whole, second.still, static_cast<float>(options_.path_samples - half) / all);
            samples = std::to_string(options_.path_samples - half) + " + " + std::to_string(half);
            seed += " and " + std::to_string(options_.job.seed + 1);
            error = 0.5 * std::hypot(first.error, second.error);
        }
        advise_exposure(job_, whole);
        NamedPicture out = named("path", "path", whole, job_, first.info.device, samples, seed);
        if (half > 0) out.noise_sample = picture_of(first.still, first.still.planes.light_nit);
        if (options_.direct_only) out.settings.emplace_back("light", "direct only");
        out.settings.emplace_back("estimated relative error", text_of(static_cast<float>(error)));
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        out.settings.emplace_back("render time", seconds_text(taken.count()));
        out.paths = paths(whole, first);
        return out;
    }

  private:
    PathModePicture trace(std::uint32_t samples, std::uint32_t seed, bool direct_only, bool shadows) {
        PathModeOptions path;
        path.samples = samples;
        path.direct_only = direct_only;
        path.shadows = shadows && options_.job.shadows.way != "none";
        path.label = label_;
        path.light_paths = true;
        JobOptions job_options = options_.job;
        job_options.seed = seed;
        return render_by_path(job_, job_options, path, {});
    }

    static void mix(std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b, float weight_a) {
        for (std::size_t i = 0; i < a.size(); ++i) a[i] = weight_a * a[i] + (1.0f - weight_a) * b.at(i);
    }

    static void average(Still& a, const Still& b, float weight_a) {
        mix(a.planes.light_nit, b.planes.light_nit, weight_a);
        mix(a.planes.unlit, b.planes.unlit, weight_a);
        for (std::size_t i = 0; i < a.planes.aovs.size(); ++i)
            mix(a.planes.aovs[i], b.planes.aovs[i], weight_a);
    }

    /// The film tells the paths apart. What shadows and occlusion take away is the difference of the first
    /// half and of the same samples without them: other samples would add their noise to it.
    LightPaths paths(const Still& whole, const PathModePicture& first) {
        LightPaths out = paths_of(whole);
        if (options_.job.shadows.way == "none") return out;
        const Still open = trace(first.info.samples, options_.job.seed, true, false).still;
        const Picture taken = combined(direct_of(open), direct_of(first.still), 1.0f, -1.0f);
        out.unshadowed_direct = combined(direct_of(whole), taken, 1.0f, 1.0f);
        if (job_.scene.environment)
            out.occluded_environment =
                combined(indirect_of(open), picture_of(whole, first.environment_nit), 1.0f, -1.0f);
        return out;
    }

    const SceneOptions& options_;
    Job& job_;
    std::string label_;
};

FrameModeStill frame_of(const gpu::Device& device, const SceneOptions& options, Job& job, bool integrate,
                        Shadows shadows, const std::string& label) {
    const std::uint32_t samples = integrate ? options.integrate_samples : options.samples;
    return render_on_device(
        device, job,
        {integrate, samples, options.job.seed, true, shadows, options.job.shadows.atlas_texels, label});
}

/// A second frame without shadows and occlusion tells what they take away. Probes hold the environment and
/// what surfaces reflect of it as one: with them its occlusion is unknown.
void add_unobstructed(const gpu::Device& device, const SceneOptions& options, Job& job, const Still& still,
                      const std::string& label, LightPaths& paths) {
    scene::Scene& scene = job.scene;
    const bool probes = !scene.irradiance_volumes.empty() || !scene.reflection_probes.empty();
    // Direct light needs no probes: filling them once more would be in vain.
    std::vector<scene::IrradianceVolume> volumes;
    std::vector<scene::ReflectionProbe> captures;
    std::swap(volumes, scene.irradiance_volumes);
    std::swap(captures, scene.reflection_probes);
    const std::vector<scene::Material> materials = scene.materials;
    for (scene::Material& material : scene.materials) material.occlusion_strength = 0.0f;
    const Still open = frame_of(device, options, job, false, Shadows::none, label).still;
    scene.materials = materials;
    std::swap(volumes, scene.irradiance_volumes);
    std::swap(captures, scene.reflection_probes);
    paths.unshadowed_direct = direct_of(open);
    if (scene.environment && !probes)
        paths.occluded_environment = combined(indirect_of(open), indirect_of(still), 1.0f, -1.0f);
}

NamedPicture device_picture(const gpu::Device& device, const SceneOptions& options, Job& job, bool integrate,
                            const std::string& name, const std::string& label) {
    const bool none = options.job.shadows.way == "none";
    const Shadows shadows = none ? Shadows::none : integrate ? Shadows::ray : Shadows::map;
    const FrameModeStill frame = frame_of(device, options, job, integrate, shadows, label);
    warn_of_unshadowed(frame.unshadowed_lights, job.diagnostics);
    advise_exposure(job, frame.still);
    NamedPicture out =
        named(name, integrate ? "integrate" : "realtime", frame.still, job, device_line(device.info()),
              std::to_string(integrate ? options.integrate_samples : options.samples),
              std::to_string(options.job.seed));
    out.settings.emplace_back("render time",
                              seconds_text(frame.render_s) + ", set-up " + seconds_text(frame.setup_s));
    out.paths = paths_of(frame.still);
    if (!none && !integrate) add_unobstructed(device, options, job, frame.still, label, *out.paths);
    return out;
}

/// The path tracer's picture first, then the frame under each profile, then the frame's integrals in full;
/// path and integrate with the material model of the first profile.
std::vector<SceneSource> scene_sources(const SceneOptions& options) {
    std::vector<SceneSource> out;
    std::vector<std::shared_ptr<Job>> jobs;
    for (const std::string& profile : options.profiles) {
        JobOptions job_options = options.job;
        job_options.profile = profile;
        jobs.push_back(std::make_shared<Job>(prepare(job_options)));
    }
    if (options.has_mode("path"))
        out.push_back(
            {"path", jobs[0], [&options, job = jobs[0]](const gpu::Device&, const std::string& label) {
                 return TruthSource(options, *job, label).render();
             }});
    const auto add = [&](const std::shared_ptr<Job>& job, bool integrate, const std::string& name) {
        out.push_back({name, job,
                       [&options, job, integrate, name](const gpu::Device& device, const std::string& label) {
                           return device_picture(device, options, *job, integrate, name, label);
                       }});
    };
    if (options.has_mode("realtime")) {
        for (const auto& job : jobs)
            add(job, false, jobs.size() > 1 ? "realtime " + job->profile.name : "realtime");
    }
    // Without a path tracer it is the truth.
    if (options.has_mode("integrate")) {
        add(jobs[0], true, "integrate");
        if (!options.has_mode("path")) std::rotate(out.begin(), out.end() - 1, out.end());
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

bool SceneOptions::has_mode(const std::string& mode) const {
    return std::find(modes.begin(), modes.end(), mode) != modes.end();
}

std::size_t SceneOptions::picture_count() const {
    const std::size_t frames = has_mode("realtime") ? std::max<std::size_t>(1, profiles.size()) : 0;
    return frames + (has_mode("path") ? 1 : 0) + (has_mode("integrate") ? 1 : 0);
}

void add_compared_scene_options(CLI::App& command, SceneOptions& o) {
    JobOptions& job = o.job;
    add_scene_options(command, job);
    add_picture_options(command, job);
    add_device_options(command, job);
    command.remove_option(command.get_option("--profile"));
    command.add_option(
        "--profile", o.profiles,
        "Of a scene (best); may be given several times; truth has the material model of the first");
    command
        .add_option(
            "--modes", o.modes,
            "Which pictures of a scene (realtime,path,integrate); the reference is path, else integrate")
        ->delimiter(',')
        ->check(CLI::IsMember({"realtime", "path", "integrate"}));
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
        "--no-truth", [&o] { o.modes = {"realtime"}; },
        "Leave path and integrate out (--modes realtime): the first profile is the reference");
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
    refuse_together(command, {"--no-truth", "--modes"});
    if (!options.has_mode("path"))
        refuse_without_effect(command, {"--path-spp", "--direct-only"}, "without the mode path");
    if (!options.has_mode("integrate"))
        refuse_without_effect(command, {"--integrate-spp"}, "without the mode integrate");
    if (!options.has_mode("realtime"))
        refuse_without_effect(command, {"--samples"}, "without the mode realtime");
    for (const char* exposure :
         {"--ev100", "--aperture", "--shutter", "--iso", "--auto-exposure", "--exposure-compensation"})
        refuse_together(command, {"--exposure", exposure});
}

std::vector<NamedPicture> render_pictures(const SceneOptions& options, Diagnostics& diagnostics) {
    const std::vector<SceneSource> sources = scene_sources(options);
    const gpu::Device device(device_options(options.job));
    std::fprintf(stderr, "candela: device: %s\n", device_line(device.info()).c_str());
    std::vector<NamedPicture> out;
    for (const SceneSource& source : sources) {
        const std::string label = source.name + ", picture " + std::to_string(out.size() + 1) + " of " +
                                  std::to_string(sources.size());
        out.push_back(source.render(device, label));
    }
    // With what came up while rendering; of one profile, as the others would repeat it.
    diagnostics = sources.front().job->diagnostics;
    return out;
}

}  // namespace candela::app
