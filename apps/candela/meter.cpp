#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "candela/measure/light_meter.hpp"
#include "candela/measure/path_model.hpp"
#include "candela/scene/error.hpp"
#include "candela/truth/render_path.hpp"
#include "command.hpp"
#include "frame_mode.hpp"
#include "job.hpp"
#include "local_light.hpp"
#include "option_rules.hpp"
#include "path_mode.hpp"
#include "progress_line.hpp"
#include "shading/exposure.glsl"

namespace candela::app {
namespace {

/// Of the meter's own picture: one tile of the path tracer.
constexpr std::uint32_t kFieldPixels = 32;

struct MeterOptions {
    JobOptions job;
    std::vector<double> at;
    std::vector<double> normal;
    std::vector<std::uint32_t> pixel;
    std::vector<double> from;
    std::vector<double> towards;
    float field_deg = 1.0f;
    std::string mode = "path";
    std::optional<std::uint32_t> samples;
    bool direct_only = false;
};

/// Mean over what the meter sees, in cd/m^2.
struct Reading {
    glm::dvec3 luminance_rgb{0.0};
    std::optional<double> standard_error;  ///< of the luminance, where it is an estimate by chance

    [[nodiscard]] double luminance_nit() const {
        return double(shading::luminance(glm::vec3(luminance_rgb)));
    }
};

glm::dvec3 vector_of(const std::vector<double>& v, const std::string& name) {
    for (const double x : v) {
        if (!(std::abs(x) <= 1e12)) throw Error(Fault::usage, "out of range", name, "-1e12 to 1e12");
    }
    return {v[0], v[1], v[2]};
}

glm::vec3 unit(const glm::vec3& v, const std::string& name) {
    const float length = glm::length(v);
    if (!(length > 1e-20f)) throw Error(Fault::usage, "has no direction", name, "three numbers, not all 0");
    return v / length;
}

/// Which of the three ways to measure is asked for: exactly one.
enum class Way { incident, pixel, spot };

Way way_of(const MeterOptions& o) {
    const int ways = (o.at.empty() ? 0 : 1) + (o.pixel.empty() ? 0 : 1) + (o.from.empty() ? 0 : 1);
    if (ways != 1) {
        throw Error(Fault::usage, "needs one of --at, --pixel and --from", "candela meter",
                    "--at x,y,z for the light that falls on a point, --pixel x,y for a luminance");
    }
    if (!o.normal.empty() && o.at.empty()) throw Error(Fault::usage, "needs --at", "--normal");
    if (o.from.empty() != o.towards.empty()) {
        throw Error(Fault::usage, "--from and --towards go together", "candela meter",
                    "--from x,y,z --towards x,y,z");
    }
    if (!o.at.empty()) return Way::incident;
    return o.pixel.empty() ? Way::spot : Way::pixel;
}

/// What only a picture that is shown has.
const std::vector<std::string>& of_pictures() {
    static const std::vector<std::string> names{"--aperture", "--shutter",       "--iso",
                                                "--ev100",    "--auto-exposure", "--exposure-compensation",
                                                "--tonemap"};
    return names;
}

void check_options(const CLI::App& command, const MeterOptions& options) {
    check_environment_options(command, options.job);
    check_picture_options(command);
    check_shadow_options(command, options.job.shadows, options.mode);
    if (options.pixel.empty())
        refuse_without_effect(
            command, {"--size", "--width", "--height", "--camera", "--look-from", "--look-at", "--focal-mm"},
            "without a picture whose pixel is read", "--pixel x,y");
    if (options.from.empty())
        refuse_without_effect(command, {"--field-deg"}, "but on a spot meter",
                              "--from x,y,z --towards x,y,z");
}

Reading mean_of(const std::vector<glm::vec4>& pixels) {
    Reading r;
    for (const glm::vec4& p : pixels) r.luminance_rgb += glm::dvec3(p) / double(pixels.size());
    return r;
}

Reading read_by_path(const Job& job, const MeterOptions& options) {
    truth::PathRenderOptions o;
    measure::set_model(job.profile, o.path);
    o.path.direct_only = options.direct_only;
    o.path.shadows = shadows_of(options.job.shadows, options.mode) == Shadows::ray;
    o.width = o.height = kFieldPixels;
    o.samples = options.samples.value_or(64);
    o.seed = options.job.seed;
    const std::unique_ptr<truth::Team> team = truth::join_team();
    ProgressLine line("metering");
    if (line.shown())
        o.progress = [&](const truth::PathProgress& p) { line.report(p.fraction, p.seconds_left, ""); };
    const truth::Film film = truth::render_path(job.scene, job.camera, o, *team).film;
    Reading r;
    double squared = 0.0;
    double paths = 0.0;
    for (std::uint32_t i = 0; i < kFieldPixels * kFieldPixels; ++i) {
        const double* p = film.pixel(i % kFieldPixels, i / kFieldPixels);
        r.luminance_rgb += glm::dvec3(p[0], p[1], p[2]);
        squared += p[truth::FilmLayout::squared];
        paths += film.tile_of(i % kFieldPixels, i / kFieldPixels).samples;
    }
    r.luminance_rgb /= paths;
    const double mean = r.luminance_nit();
    r.standard_error = std::sqrt(std::max(squared / paths - mean * mean, 0.0) / paths);
    return r;
}

Reading read_on_device(Job& job, const MeterOptions& options, Way way) {
    const bool integrate = options.mode == "integrate";
    const gpu::Device device(device_options(options.job));
    const std::uint32_t samples = options.samples.value_or(default_samples(integrate));
    const Shadows shadows = shadows_of(options.job.shadows, options.mode);
    const FrameModeStill frame = render_on_device(
        device, job,
        {integrate, samples, options.job.seed, false, shadows, options.job.shadows.atlas_texels, "metering"});
    warn_of_unshadowed(frame.unshadowed_lights, job.diagnostics);
    const std::vector<glm::vec4> picture = realtime::lit_nit(frame.still);
    if (way != Way::pixel) return mean_of(picture);
    return mean_of({picture.at(std::size_t{options.pixel[1]} * job.width + options.pixel[0])});
}

/// Aims the job's camera; its picture is then only what the meter sees, but for a pixel of a frame on the
/// device, which is part of a picture as a whole.
void aim(Job& job, const MeterOptions& o, Way way) {
    if (way == Way::pixel) {
        if (o.pixel[0] >= job.width || o.pixel[1] >= job.height) {
            throw Error(Fault::usage, "outside of the picture", "--pixel",
                        "0,0 to " + std::to_string(job.width - 1) + "," + std::to_string(job.height - 1));
        }
        if (o.mode != "path") return;
        job.camera = measure::through_pixel(job.camera, {o.pixel[0], o.pixel[1]}, {job.width, job.height});
    } else if (way == Way::spot) {
        const glm::vec3 from = job.scene.frame.to_own(vector_of(o.from, "--from"));
        const glm::vec3 towards = job.scene.frame.to_own(vector_of(o.towards, "--towards"));
        (void)unit(towards - from, "--towards");
        job.camera = measure::point_spot_meter(from, towards, o.field_deg * shading::PI / 180.0f);
    } else {
        const glm::vec3 normal = o.normal.empty()
                                     ? glm::vec3(0.0f, 1.0f, 0.0f)
                                     : unit(glm::vec3(vector_of(o.normal, "--normal")), "--normal");
        const glm::vec3 at = job.scene.frame.to_own(vector_of(o.at, "--at"));
        job.camera = measure::hold_card(job.scene, at, normal);
        // The card is matt by definition, whatever the profile thinks of rough surfaces.
        job.profile.diffuse = realtime::DiffuseTechnique::lambert;
    }
    job.width = job.height = kFieldPixels;
    // Automatic, whatever the stage says: the light buffer's range then suits what is read.
    job.exposure = {};
}

nlohmann::json result_of(const Reading& reading, Way way) {
    const bool incident = way == Way::incident;
    const double scale = incident ? double(shading::PI) : 1.0;
    const double value = reading.luminance_nit() * scale;
    nlohmann::json out;
    out[incident ? "illuminance_lx" : "luminance_nit"] = value;
    const glm::dvec3 rgb = reading.luminance_rgb * scale;
    out["rgb"] = {rgb.x, rgb.y, rgb.z};
    if (reading.standard_error) out["standard_error"] = *reading.standard_error * scale;
    const auto single = static_cast<float>(value);
    out["ev100"] = nullptr;
    if (value > 0.0) {
        out["ev100"] =
            incident ? shading::ev100_from_illuminance(single) : shading::ev100_from_luminance(single);
    }
    return out;
}

void print(const nlohmann::json& result, Way way) {
    const bool incident = way == Way::incident;
    const double value = result[incident ? "illuminance_lx" : "luminance_nit"];
    std::printf("%s  %.6g %s", incident ? "illuminance" : "luminance", value, incident ? "lx" : "cd/m2");
    if (result.contains("standard_error")) std::printf(" +- %.2g", result["standard_error"].get<double>());
    if (result["ev100"].is_null()) {
        std::printf("  (no light)\n");
    } else {
        std::printf("  EV100 %.2f (%s)\n", result["ev100"].get<double>(),
                    incident ? "incident, C = 250" : "reflected, K = 12.5");
    }
}

int meter(const MeterOptions& options) {
    const Way way = way_of(options);
    if (options.direct_only && options.mode != "path")
        throw Error(Fault::usage, "only the path tracer follows light further", "--direct-only",
                    "--mode path");
    Job job = prepare(options.job);
    // Without the meter's card, so that the cache of the scene's pictures serves.
    if (options.mode == "realtime") fill_irradiance_volumes(job, {});
    aim(job, options, way);
    const Reading reading =
        options.mode == "path" ? read_by_path(job, options) : read_on_device(job, options, way);
    print_warnings(job.diagnostics);
    nlohmann::json result = result_of(reading, way);
    if (!options.job.json) {
        print(result, way);
        return 0;
    }
    result["mode"] = options.mode;
    result["warnings"] = warnings_json(job.diagnostics);
    std::printf("%s\n", result.dump(2).c_str());
    return 0;
}

}  // namespace

void add_meter(CLI::App& app, Action& action) {
    auto o = std::make_shared<MeterOptions>();
    CLI::App* command = app.add_subcommand("meter", "Hold a light meter into a scene");
    command->add_option("SCENE", o->job.scene_file, "A .gltf or .glb file")->required();
    command->add_option("--at", o->at, "x,y,z in m: illuminance on a plane there (incident meter)")
        ->delimiter(',')
        ->expected(3);
    command->add_option("--normal", o->normal, "x,y,z that the plane faces (0,1,0)")
        ->delimiter(',')
        ->expected(3);
    command
        ->add_option("--pixel", o->pixel,
                     "x,y: luminance of a pixel of the picture, 0,0 upper left (spot meter)")
        ->delimiter(',')
        ->expected(2);
    command->add_option("--from", o->from, "x,y,z: luminance seen from there (spot meter)")
        ->delimiter(',')
        ->expected(3);
    command->add_option("--towards", o->towards, "x,y,z that the spot meter points at")
        ->delimiter(',')
        ->expected(3);
    command->add_option("--field-deg", o->field_deg, "Side of the square field of the spot meter")
        ->check(number_in(1e-3, 120.0))
        ->capture_default_str();
    command->add_option("--mode", o->mode, "path (truth), integrate or realtime")
        ->check(CLI::IsMember({"path", "integrate", "realtime"}))
        ->capture_default_str();
    command
        ->add_option("--samples,--spp", o->samples,
                     "Of each of the 32 x 32 pixels that the meter averages (path 64)")
        ->check(CLI::Range(1u, 1u << 20));
    command->add_flag("--direct-only", o->direct_only, "Only light straight from its source (path)");
    add_scene_options(*command, o->job);
    add_picture_options(*command, o->job);
    add_device_options(*command, o->job);
    // A meter reads what is there, whatever a camera would make of it.
    for (const std::string& option : of_pictures()) command->remove_option(command->get_option(option));
    command->callback([o, command, &action] {
        check_options(*command, *o);
        action = [o] { return meter(*o); };
    });
}

}  // namespace candela::app
