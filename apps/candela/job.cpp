#include "job.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "candela/io/image_read.hpp"
#include "candela/io/json_reader.hpp"
#include "candela/scene/camera.hpp"
#include "candela/scene/error.hpp"
#include "candela/scene/strokes.hpp"
#include "candela/scene/world_scale.hpp"
#include "option_rules.hpp"
#include "shading/tone_curves.glsl"

namespace candela::app {
namespace {

Error usage(const std::string& what, const std::string& where, const std::string& hint) {
    return {Fault::usage, what, where, hint};
}

void check_range(float value, float low, float high, const std::string& where, const std::string& hint) {
    if (!(value >= low && value <= high)) throw usage("out of range", where, hint);
}

/// What the parser lets through as a number: nan, inf, and values that no scene means.
void check_numbers(const JobOptions& o) {
    const auto limit = [](const std::string& name, float value, float low, float high) {
        char range[64];
        std::snprintf(range, sizeof(range), "%g to %g", static_cast<double>(low), static_cast<double>(high));
        check_range(value, low, high, name, range);
    };
    limit("--env-scale", o.env_scale.value_or(1.0f), 0.0f, 1e12f);
    limit("--env-lux", o.env_lux.value_or(1.0f), 1e-9f, 1e12f);
    limit("--env-rotate", o.env_rotate_deg.value_or(0.0f), -36000.0f, 36000.0f);
    limit("--focal-mm", o.focal_mm.value_or(50.0f), 1.0f, 5000.0f);
    limit("--exposure-compensation", o.exposure_compensation.value_or(0.0f), -30.0f, 30.0f);
    limit("--aperture", o.aperture_f.value_or(1.0f), 0.1f, 1000.0f);
    limit("--iso", o.iso.value_or(100.0f), 1.0f, 1e7f);
    for (const double x : o.look_from) limit("--look-from", static_cast<float>(x), -1e12f, 1e12f);
    for (const double x : o.look_at) limit("--look-at", static_cast<float>(x), -1e12f, 1e12f);
}

void parse_size(const std::string& text, Job& job) {
    constexpr std::uint32_t largest = 16384;
    const char* end = text.data() + text.size();
    const auto [middle, first_error] = std::from_chars(text.data(), end, job.width);
    bool good = first_error == std::errc{} && middle != end && *middle == 'x';
    if (good) {
        const auto [stop, second_error] = std::from_chars(middle + 1, end, job.height);
        good = second_error == std::errc{} && stop == end;
    }
    if (!good || !job.width || !job.height || job.width > largest || job.height > largest) {
        throw usage("not a size: " + text, "--size", "WIDTHxHEIGHT, each 1 to 16384, such as 1280x720");
    }
}

/// --width and --height; one alone keeps the shape of the picture that is made without a size.
void set_sides(const JobOptions& o, Job& job) {
    constexpr double default_aspect = 16.0 / 9.0;
    const auto side = [](double texels) {
        return static_cast<std::uint32_t>(std::max(std::round(texels), 1.0));
    };
    if (o.width) job.width = *o.width;
    if (o.height) job.height = *o.height;
    if (o.width && !o.height) job.height = side(*o.width / default_aspect);
    if (o.height && !o.width) job.width = side(*o.height * default_aspect);
}

/// "f/8", "F8" and "8" are the same aperture.
CLI::Validator f_number() {
    return {[](std::string& value) -> std::string {
                std::string_view text = value;
                if (text.starts_with('f') || text.starts_with('F')) text.remove_prefix(1);
                if (text.size() < value.size() && text.starts_with('/')) text.remove_prefix(1);
                value = std::string(text);
                return {};
            },
            ""};
}

/// Seconds from "0.008" or "1/125".
float parse_shutter(const std::string& text) {
    const auto number = [&](std::string_view part) {
        float value = 0.0f;
        const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), value);
        const bool good =
            error == std::errc{} && stop == part.data() + part.size() && value > 0.0f && std::isfinite(value);
        if (!good)
            throw usage("not an exposure time: " + text, "--shutter", "seconds such as 0.008 or 1/125");
        return value;
    };
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos) return number(text);
    return number(std::string_view(text).substr(0, slash)) / number(std::string_view(text).substr(slash + 1));
}

std::uint32_t parse_tone_curve(const std::string& name) {
    if (name == "none") return shading::kToneNone;
    if (name == "aces") return shading::kToneAces;
    if (name == "agx") return shading::kToneAgx;
    return shading::kToneNeutral;
}

/// What a profile's file starts from: a mistake there is the file's and not the command line's.
realtime::Profile base_of(const nlohmann::json& json, const std::string& file) {
    if (!json.contains("base")) return realtime::profile_by_name("best", file);
    const std::string where = file + ": /base";
    if (!json["base"].is_string()) throw input_error("a profile's name is a string", where);
    try {
        return realtime::profile_by_name(json["base"].get<std::string>(), where);
    } catch (const Error& error) {
        throw input_error(error.what(), error.where(), error.hint());
    }
}

realtime::Profile load_profile(const std::string& name) {
    if (!name.ends_with(".json")) return realtime::profile_by_name(name, "--profile");
    const auto json = io::parse_json(io::read_file(name, 1u << 20), name, true);
    if (!json.is_object())
        throw input_error("not a JSON object", name, "{\"base\": \"best\", \"diffuse\": \"disney\"}");
    realtime::Profile profile = base_of(json, name);
    profile.name = std::filesystem::path(name).stem().string();
    for (const auto& [slot, technique] : json.items()) {
        if (slot == "base") continue;
        const std::string where = name + ": /" + slot;
        if (technique.is_number()) {
            realtime::set_parameter(profile, slot, technique.get<double>(), where);
            continue;
        }
        if (!technique.is_string()) throw input_error("a technique's name is a string", where);
        realtime::set_technique(profile, slot, technique.get<std::string>(), where);
    }
    return profile;
}

glm::dvec3 point_of(const std::vector<double>& v) {
    return {v[0], v[1], v[2]};
}

/// A camera of the scene, through another lens where one is asked for.
scene::Camera with_focal(scene::Camera camera, const std::optional<float>& focal_mm) {
    if (!focal_mm) return camera;
    if (camera.projection != scene::Projection::perspective)
        throw usage("an orthographic camera has no focal length: " + camera.name, "--focal-mm",
                    "--look-from x,y,z, or another --camera");
    camera.yfov_rad = scene::yfov_from_focal_mm(*focal_mm);
    camera.aspect = 0.0f;  // the author's viewport belongs to the author's lens
    return camera;
}

scene::Camera choose_camera(const JobOptions& options, const io::Stage& stage, Job& job) {
    const float aspect = static_cast<float>(job.width) / static_cast<float>(job.height);
    const scene::Aabb bounds = scene::world_bounds(job.scene);
    std::optional<float> focal_mm = options.focal_mm ? options.focal_mm : stage.camera.focal_mm;
    const float yfov = scene::yfov_from_focal_mm(focal_mm.value_or(50.0f));

    std::optional<glm::dvec3> from = stage.camera.look_from;
    std::optional<glm::dvec3> at = stage.camera.look_at;
    if (!options.look_from.empty()) from = point_of(options.look_from);
    if (!options.look_at.empty()) at = point_of(options.look_at);
    const std::string name = !options.camera.empty() ? options.camera : stage.camera.name.value_or("");
    if (!name.empty() && options.look_from.empty()) {
        std::string known;
        for (const scene::Camera& camera : job.scene.cameras) {
            if (camera.name == name) return with_focal(camera, focal_mm);
            known += (known.empty() ? "" : ", ") + camera.name;
        }
        throw input_error("no camera of this name: " + name, options.scene_file,
                          known.empty() ? "the scene has no cameras" : "it has " + known);
    }
    if (!options.look_at.empty() && !from)
        throw usage("needs a place to look from", "--look-at", "--look-from x,y,z");
    if (from) {
        const glm::vec3 center = bounds.empty() ? glm::vec3(0.0f) : 0.5f * (bounds.min + bounds.max);
        const glm::vec3 target = at ? job.scene.frame.to_own(*at) : center;
        const glm::vec3 eye = job.scene.frame.to_own(*from);
        if (!(glm::length(eye - target) > 1e-6f * (glm::length(eye) + glm::length(target)))) {
            throw usage("the camera stands where it looks", "--look-from", "move one of the two points");
        }
        return scene::look_at(eye, target, yfov);
    }
    if (!job.scene.cameras.empty()) return with_focal(job.scene.cameras.front(), focal_mm);
    if (options.focal_mm)
        throw usage("has no effect: the scene has no camera and is framed as a whole", "--focal-mm",
                    "--look-from x,y,z");
    if (focal_mm)
        job.diagnostics.warn(
            "the stage's focal_mm has no effect: without a camera the scene is framed as a whole");
    return scene::frame_bounds(bounds, aspect);
}

scene::Exposure choose_exposure(const JobOptions& options, const io::Stage& stage) {
    scene::Exposure e = stage.exposure;
    const bool camera_given = options.aperture_f || options.shutter_s || options.iso;
    if (options.auto_exposure || options.ev100 || camera_given) {
        const float compensation = e.compensation_ev;
        if (options.auto_exposure || options.ev100) e = {};
        e.ev100.reset();
        e.compensation_ev = compensation;
    }
    if (options.ev100) e.ev100 = options.ev100;
    if (options.aperture_f) e.aperture_f = options.aperture_f;
    if (options.shutter_s) e.shutter_s = parse_shutter(*options.shutter_s);
    if (options.iso) e.iso = options.iso;
    const int given = (e.aperture_f ? 1 : 0) + (e.shutter_s ? 1 : 0) + (e.iso ? 1 : 0);
    if (!e.ev100 && given > 0 && given < 3) {
        throw usage("a camera exposure needs all three of aperture, shutter and ISO",
                    "--aperture --shutter --iso", "or --ev100 E, or --auto-exposure");
    }
    if (e.ev100) check_range(*e.ev100, -30.0f, 40.0f, "--ev100", "-30 to 40");
    if (options.exposure_compensation) e.compensation_ev = *options.exposure_compensation;
    return e;
}

}  // namespace

void add_scene_options(CLI::App& command, JobOptions& o) {
    add_scene_file_options(command, o);
    add_environment_options(command, o);
}

void add_picture_options(CLI::App& command, JobOptions& o) {
    command.add_option("--size", o.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
    command.add_option("--width", o.width, "Pixels; alone, the height follows at 16:9")
        ->check(CLI::Range(1u, 16384u));
    command.add_option("--height", o.height, "Pixels; alone, the width follows at 16:9")
        ->check(CLI::Range(1u, 16384u));
    command.add_option("--camera", o.camera, "A camera of the scene, by name");
    command.add_option("--look-from", o.look_from, "x,y,z of the camera in m")->delimiter(',')->expected(3);
    command.add_option("--look-at", o.look_at, "x,y,z that it looks at")->delimiter(',')->expected(3);
    command.add_option("--focal-mm", o.focal_mm, "Focal length on a 36x24 mm sensor")
        ->check(number_in(1.0, 5000.0));
    command.add_option("--aperture", o.aperture_f, "f/N or N")
        ->transform(f_number())
        ->check(number_in(0.1, 1000.0));
    command.add_option("--shutter", o.shutter_s, "Exposure time in s, such as 1/125");
    command.add_option("--iso", o.iso, "Sensitivity")->check(number_in(1.0, 1e7));
    command.add_option("--ev100", o.ev100, "Exposure value at ISO 100")->check(number_in(-30.0, 40.0));
    command.add_flag("--auto-exposure", o.auto_exposure,
                     "Meter the picture (the default when nothing else is said)");
    command.add_option("--exposure-compensation", o.exposure_compensation, "Stops; positive brightens")
        ->check(number_in(-30.0, 30.0));
    command
        .add_option("--profile", o.profile,
                    "best, frostbite, ue4, mobile, lesson, lesson-literal or FILE.json")
        ->capture_default_str();
    command.add_option("--tonemap", o.tonemap, "Tone curve of PNG files")
        ->check(CLI::IsMember({"none", "aces", "agx", "neutral"}))
        ->capture_default_str();
    command.add_option("--line-width", o.line_width_px, "Width in pixels of the file's lines and points")
        ->check(number_in(0.1, 100.0))
        ->capture_default_str();
    add_shadow_options(command, o.shadows);
    command.add_option("--seed", o.seed, "Of the sample positions")->capture_default_str();
}

void add_device_options(CLI::App& command, JobOptions& o) {
    command.add_option("--device", o.device, "auto, cpu, an index or part of a name (candela info)")
        ->capture_default_str();
    command.add_flag("--validation", o.validation,
                     "Run under the Vulkan validation layer; its messages are errors");
    command.add_flag("--json", o.json, "Print one JSON object on standard output");
}

Job prepare(const JobOptions& options) {
    Job job;
    check_numbers(options);
    parse_size(options.size, job);
    set_sides(options, job);
    job.profile = load_profile(options.profile);
    job.tone_curve = parse_tone_curve(options.tonemap);
    StagedScene staged = load_staged_scene(options, job.diagnostics);
    // What is said of the files; that the studio lights a scene is no slip of theirs.
    refuse_warnings(options, job.diagnostics);
    job.scene = std::move(staged.scene);
    const io::Stage& stage = staged.stage;
    set_environment(options, stage, job);
    job.camera = scene::fitted(choose_camera(options, stage, job),
                               static_cast<float>(job.width) / static_cast<float>(job.height));
    scene::widen_strokes(job.scene, job.camera, job.width, job.height, options.line_width_px);
    job.exposure = choose_exposure(options, stage);
    scene::set_unit(job.scene, job.camera, scene::suitable_unit_m(job.scene));
    return job;
}

gpu::DeviceOptions device_options(const JobOptions& options) {
    gpu::DeviceOptions out;
    out.select = options.device;
    out.validation = options.validation;
    out.cache_folder = gpu::user_cache_folder();
    return out;
}

void print_warnings(const Diagnostics& diagnostics) {
    for (const Diagnostics::Warning& w : diagnostics.warnings()) {
        const std::string times = w.count > 1 ? " (" + std::to_string(w.count) + " times)" : "";
        std::fprintf(stderr, "candela: warning: %s%s\n", Error(Fault::input, w.text).line().c_str(),
                     times.c_str());
    }
}

nlohmann::json warnings_json(const Diagnostics& diagnostics) {
    auto list = nlohmann::json::array();
    for (const Diagnostics::Warning& w : diagnostics.warnings())
        list.push_back({{"text", w.text}, {"count", w.count}});
    return list;
}

nlohmann::json pass_times_json(const std::vector<gpu::PassTime>& times) {
    auto list = nlohmann::json::array();
    for (const gpu::PassTime& t : times) list.push_back({{"pass", t.name}, {"ms", t.milliseconds}});
    return list;
}

std::string device_line(const gpu::DeviceInfo& info) {
    return info.name + ", " + info.driver;
}

}  // namespace candela::app
