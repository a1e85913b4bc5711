#include <algorithm>

#include "candela/bake/environment.hpp"
#include "candela/bake/sky.hpp"
#include "candela/io/environment_read.hpp"
#include "candela/measure/numerics.hpp"
#include "candela/scene/environment_sources.hpp"
#include "candela/scene/error.hpp"
#include "emission_units.hpp"
#include "job.hpp"
#include "option_rules.hpp"
#include "progress_line.hpp"
#include "shading/environment.glsl"
#include "sky_option.hpp"

namespace candela::app {
namespace {

/// A sky's picture as the environment; its sun goes with it.
void set_sky(const scene::SkySettings& settings, Job& job, std::optional<scene::Light>& sun) {
    bake::Sky sky = bake::sky_of(settings);
    job.scene.environment = std::move(sky.environment);
    sun = std::move(sky.sun);
}

/// A file's picture as the environment; true where the file says that it is in cd/m^2.
bool set_file(io::ReadEnvironment picture, Job& job) {
    const bool absolute = picture.absolute;
    job.scene.environment = std::move(picture);
    return absolute;
}

/// What the stage says; returns the illuminance that it asks for, 0 to leave the scale as it is.
float set_stage_environment(io::StageEnvironment e, const std::optional<scene::MemoryBudget>& memory,
                            Job& job, std::optional<scene::Light>& sun, bool& absolute) {
    e.options.memory = memory;
    if (e.sky)
        set_sky(*e.sky, job, sun);
    else if (e.file.empty())
        job.scene.environment = bake::studio_environment();
    else
        absolute = set_file(io::read_stage_environment(e, job.diagnostics), job);
    job.scene.environment->scale = e.scale;
    job.scene.environment->rotation_rad = e.rotation_rad;
    job.scene.environment->visible = e.visible;
    return e.illuminance_lx.value_or(0.0f);
}

/// Scales an environment and its sun so that an up-facing plane receives this from both.
void scale_to_illuminance(float lux, const std::optional<scene::Light>& sun, scene::Environment& e) {
    e.scale = 1.0f;
    float now_lx = bake::upward_illuminance_lx(e);
    if (sun) now_lx += sun->intensity * std::max(-sun->direction.y, 0.0f);
    if (!(now_lx > 0.0f)) throw input_error("the environment gives no light", e.name, "leave --env-lux out");
    e.scale = lux / now_lx;
}

/// Of the environment's sun beside one that the scene has: a scene made for its own sun gets another under
/// --env. A faint one, such as a moon, adds nothing that shows.
void warn_of_two_suns(const scene::Light& sun, const std::string& whose, Job& job) {
    constexpr float faintest = 0.01f;
    const scene::Light* own = nullptr;
    for (const scene::Light& light : job.scene.lights) {
        if (!scene::is_distant(light.type) || light.intensity < faintest * sun.intensity) continue;
        if (own == nullptr || light.intensity > own->intensity) own = &light;
    }
    if (own == nullptr) return;
    const std::string lx = measure::readable(double(own->intensity)) + " lx beside " +
                           measure::readable(double(sun.intensity)) + " lx";
    const std::string name = own->name.empty() ? "without a name" : "\"" + own->name + "\"";
    const std::string off = own->name.empty() ? "--light-scale 0 turns the scene file's lights off"
                                              : R"(off in a stage: {"lights": [{"override": ")" + own->name +
                                                    R"(", "off": true}]})";
    job.diagnostics.warn("two suns: the scene's light " + name + " and " + whose + ", " + lx + " (" + off +
                         ")");
}

}  // namespace

namespace {

/// Without the units of emission.
void choose_environment(const JobOptions& options, const io::Stage& stage, Job& job) {
    ProgressLine line("reading the environment");
    float lux = 0.0f;  // 0: leave the scale as it is
    bool absolute = true;
    std::optional<scene::Light> sun;
    const std::optional<scene::SkySettings> sky = sky_of_option(options.environment);
    const bool stage_counts = options.environment.empty() && stage.environment;
    if (options.environment == "none" || (stage_counts && stage.environment->none)) {
        job.scene.environment.reset();
        if (stage_counts) refuse_options_of_no_environment(options, options.stage_file);
        return;
    }
    if (stage_counts && stage.environment->sky && options.env_keep_sun)
        throw Error(Fault::usage, "has no effect on the stage's sky, whose sun is a light of its own",
                    "--env-keep-sun");
    if (stage_counts) lux = set_stage_environment(*stage.environment, options.memory, job, sun, absolute);
    if (sky || options.environment == "studio") absolute = true;
    if (sky)
        set_sky(*sky, job, sun);
    else if (options.environment == "studio")
        job.scene.environment = bake::studio_environment();
    else if (!options.environment.empty()) {
        check_environment_name(options.environment);
        io::EnvironmentOptions how = environment_options(options.env_file);
        how.memory = options.memory;
        how.progress = line.function();
        absolute = set_file(io::read_environment(options.environment, job.diagnostics, how), job);
    }
    if (!job.scene.environment && job.scene.lights.empty()) {
        job.scene.environment = bake::studio_environment();
    }
    if (!job.scene.environment) return refuse_options_of_no_environment(options, "the scene");
    scene::Environment& e = *job.scene.environment;
    if (options.env_scale) e.scale = *options.env_scale;
    if (options.env_rotate_deg) e.rotation_rad = *options.env_rotate_deg * shading::PI / 180.0f;
    if (options.env_visible) e.visible = *options.env_visible;
    if (options.env_lux) lux = *options.env_lux;
    if (lux > 0.0f) scale_to_illuminance(lux, sun, e);
    const bool stage_scales = stage_counts && stage.environment->scale != 1.0f;
    if (!absolute && !(lux > 0.0f) && !options.env_scale && !stage_scales) warn_of_level(e, job.diagnostics);
    if (sun) {
        bake::follow_environment(*sun, e);
        warn_of_two_suns(*sun, "the sky's", job);
        job.scene.lights.push_back(std::move(*sun));
        return;
    }
    const bool stage_keeps = stage_counts && stage.environment->keep_sun;
    if (options.env_keep_sun || stage_keeps || !scene::split_sun(job.scene)) return;
    const scene::Light found = job.scene.lights.back();
    job.scene.lights.pop_back();
    warn_of_two_suns(found, "that of " + e.name, job);
    job.scene.lights.push_back(found);
}

}  // namespace

void set_environment(const JobOptions& options, const io::Stage& stage, Job& job) {
    const bool brings_no_light = options.environment.empty() && !stage.environment &&
                                 !job.scene.environment && job.scene.lights.empty();
    choose_environment(options, stage, job);
    const bool relative = set_emission_units(options, stage, brings_no_light, job);
    if (!brings_no_light) return;
    const bool emits =
        std::any_of(job.scene.materials.begin(), job.scene.materials.end(),
                    [](const scene::Material& m) { return !m.unlit && m.emissive_nit != glm::vec3(0.0f); });
    std::string text = std::string("the scene brings no light") +
                       (emits ? " but that of its emissive surfaces" : "") +
                       ": lit by the built-in studio (--env FILE, --env none)";
    if (relative)
        text += "; its emission is relative, 1 is " + measure::readable(double(job.emission.nit_per_unit)) +
                " cd/m2 (--units absolute)";
    job.diagnostics.warn(text);
}

void add_environment_options(CLI::App& command, JobOptions& o) {
    add_emission_options(command, o);
    command.add_option("--env", o.environment,
                       "Environment: .hdr, .exr, .ktx2, .dds, .png, .jpg, .webp, a folder of cube faces, "
                       "NAME_{face}.exr, sky, "
                       "sky:KEY=VALUE,..., studio or none");
    add_environment_file_options(command, o.env_file);
    command.add_flag("--env-keep-sun", o.env_keep_sun,
                     "Leave a sun in the environment instead of making it a light that casts a shadow");
    command.add_option("--env-scale", o.env_scale, "Multiplies the environment's luminance");
    command.add_option("--env-rotate", o.env_rotate_deg, "Degrees about +Y, counter-clockwise from above");
    command.add_option("--env-lux", o.env_lux, "Scales the environment to this up-facing illuminance in lx");
    command.add_flag_callback(
        "--env-visible", [&o] { o.env_visible = true; }, "Draw the environment as background");
    command.add_flag_callback(
        "--env-hidden", [&o] { o.env_visible = false; },
        "Leave the background black, with the environment's light");
}

}  // namespace candela::app
