#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "candela/io/image_write.hpp"
#include "candela/io/output_folder.hpp"
#include "candela/io/staging_folder.hpp"
#include "candela/measure/numerics.hpp"
#include "candela/scene/environment_sources.hpp"
#include "candela/scene/error.hpp"
#include "command.hpp"
#include "environment_option.hpp"
#include "job.hpp"
#include "option_rules.hpp"
#include "progress_line.hpp"
#include "shading/environment.glsl"

namespace candela::app {
namespace {

using nlohmann::json;
using scene::Environment;
using scene::EnvironmentSource;

constexpr double kDegPerRad = 180.0 / M_PI;

struct EnvOptions {
    std::string file;
    EnvironmentFileOptions how;
    std::optional<float> scale;
    std::optional<float> lux;
    std::string output;
    bool json = false;
    std::vector<std::uint32_t> card;  ///< x, y, w, h
    float value_nit = 0.0f;
    float contrast = 25.0f;
};

io::ReadEnvironment read(const EnvOptions& options, Diagnostics& diagnostics) {
    const float scale = options.scale.value_or(1.0f);
    if (!(scale > 0.0f && scale <= 1e12f))
        throw Error(Fault::usage, "out of range", "--env-scale", "above 0, to 1e+12");
    if (options.lux && !(*options.lux >= 1e-9f && *options.lux <= 1e12f))
        throw Error(Fault::usage, "out of range", "--env-lux", "1e-09 to 1e+12");
    io::ReadEnvironment e = environment_picture(options.file, options.how, diagnostics);
    e.scale = scale;
    if (!options.lux) {
        if (!options.scale && !e.absolute) warn_of_level(e, diagnostics);
        return e;
    }
    e.scale = 1.0f;
    const double now_lx = scene::upward_illuminance_lx(e);
    if (!(now_lx > 0.0)) throw input_error("the environment gives no light", e.name, "leave --env-lux out");
    e.scale = static_cast<float>(double{*options.lux} / now_lx);
    e.absolute = true;
    return e;
}

void write_map(const std::filesystem::path& file, const io::ReadEnvironment& e) {
    std::array<std::vector<float>, 3> planes;
    for (std::size_t c = 0; c < 3; ++c) {
        planes[c].resize(e.luminance_nit.size());
        std::transform(e.luminance_nit.begin(), e.luminance_nit.end(), planes[c].begin(),
                       [&](const glm::vec3& t) { return t[static_cast<int>(c)] * e.scale; });
    }
    io::write_exr(file, e.width, e.height,
                  {{"R", io::PixelType::float32, std::span<const float>(planes[0])},
                   {"G", io::PixelType::float32, std::span<const float>(planes[1])},
                   {"B", io::PixelType::float32, std::span<const float>(planes[2])}},
                  e.absolute ? std::map<std::string, io::ExrAttribute>{{"whiteLuminance", 1.0f}}
                             : std::map<std::string, io::ExrAttribute>{});
}

double elevation_deg(const glm::vec3& d) {
    return kDegPerRad * std::atan2(double{d.y}, std::hypot(double{d.x}, double{d.z}));
}

/// From -Z, the middle of the picture, to the right.
double azimuth_deg(const glm::vec3& d) {
    return kDegPerRad * std::atan2(double{d.x}, -double{d.z});
}

json direction_json(const glm::vec3& d) {
    return {
        {"elevation_deg", elevation_deg(d)}, {"azimuth_deg", azimuth_deg(d)}, {"direction", {d.x, d.y, d.z}}};
}

json source_json(const EnvironmentSource& s) {
    const double lx = shading::luminance(s.illuminance_lx);
    json out = direction_json(s.direction);
    out["illuminance_lx"] = lx;
    out["upward_lx"] = lx * std::max(double{s.direction.y}, 0.0);
    out["solid_angle_sr"] = s.solid_angle_sr;
    out["angular_diameter_deg"] = 2.0 * kDegPerRad * s.half_angle_rad();
    out["luminance_nit"] = s.solid_angle_sr > 0.0 ? lx / s.solid_angle_sr : 0.0;
    out["color"] = {s.illuminance_lx.x / lx, s.illuminance_lx.y / lx, s.illuminance_lx.z / lx};
    out["contrast"] = std::isfinite(s.contrast) ? json(s.contrast) : json(nullptr);
    return out;
}

json info_json(const Environment& e) {
    const scene::EnvironmentStatistics s = scene::statistics_of(e);
    json percentiles = json::array();
    for (std::size_t i = 0; i < s.percentiles_nit.size(); ++i)
        percentiles.push_back({{"percent", scene::kPercentiles[i]}, {"luminance_nit", s.percentiles_nit[i]}});
    json peak = direction_json(s.peak_direction);
    peak["luminance_nit"] = s.peak_nit;
    peak["solid_angle_sr"] = s.peak_solid_angle_sr;
    const std::optional<EnvironmentSource> sun = scene::find_sun(e);
    return {{"width", e.width},
            {"height", e.height},
            {"upward_illuminance_lx", s.upward_lx},
            {"downward_illuminance_lx", s.downward_lx},
            {"mean_luminance_nit", s.mean_luminance_nit},
            {"mean_nit", {s.mean_nit.x, s.mean_nit.y, s.mean_nit.z}},
            {"percentiles", percentiles},
            {"peak", peak},
            {"sun", sun ? source_json(*sun) : json(nullptr)}};
}

void print_line(const char* label, const std::string& text) {
    std::printf("  %-12s %s\n", label, text.c_str());
}

std::string nit(double value) {
    return measure::readable(value) + " cd/m2";
}

std::string place_text(const json& d) {
    return "elevation " + measure::fixed(d["elevation_deg"], 1) + " deg, azimuth " +
           measure::fixed(d["azimuth_deg"], 1) + " deg";
}

std::string source_text(const json& s) {
    return measure::readable(s["illuminance_lx"]) + " lx at normal incidence, " + place_text(s) + ", " +
           measure::fixed(s["angular_diameter_deg"], 2) + " deg wide, " + nit(s["luminance_nit"]) +
           ", colour " + measure::fixed(s["color"][0], 3) + " " + measure::fixed(s["color"][1], 3) + " " +
           measure::fixed(s["color"][2], 3);
}

void print_info(const std::string& file, const json& out) {
    std::printf("%s: %d x %d\n", file.c_str(), out["width"].get<int>(), out["height"].get<int>());
    print_line("illuminance", measure::readable(out["upward_illuminance_lx"]) + " lx facing up, " +
                                  measure::readable(out["downward_illuminance_lx"]) + " lx facing down");
    print_line("mean", nit(out["mean_luminance_nit"]));
    std::string percentiles;
    for (const json& p : out["percentiles"])
        percentiles += (percentiles.empty() ? "" : ", ") + measure::number(p["percent"]) +
                       " %: " + measure::readable(p["luminance_nit"]);
    print_line("percentiles", percentiles + " cd/m2");
    print_line("peak", nit(out["peak"]["luminance_nit"]) + " over " +
                           measure::readable(out["peak"]["solid_angle_sr"]) + " sr, " +
                           place_text(out["peak"]));
    print_line("sun", out["sun"].is_null() ? "none" : source_text(out["sun"]));
}

void print_json(json out, const EnvOptions& options, const Diagnostics& diagnostics) {
    out["file"] = options.file;
    out["warnings"] = warnings_json(diagnostics);
    std::printf("%s\n", out.dump(2, ' ', false, json::error_handler_t::replace).c_str());
}

int info(const EnvOptions& options) {
    Diagnostics diagnostics;
    const json out = info_json(read(options, diagnostics));
    if (options.json) {
        print_json(out, options, diagnostics);
        return 0;
    }
    print_info(options.file, out);
    print_warnings(diagnostics);
    return 0;
}

/// Of the rectangle, every texel by its solid angle.
double mean_luminance(const Environment& e, const std::vector<std::uint32_t>& card) {
    const auto ends_inside = [](std::uint32_t from, std::uint32_t count, std::uint32_t size) {
        return count > 0 && std::uint64_t{from} + count <= size;
    };
    if (!ends_inside(card[0], card[2], e.width) || !ends_inside(card[1], card[3], e.height))
        throw input_error(
            "the grey card is not inside the picture", e.name,
            "x,y,w,h in texels of " + std::to_string(e.width) + " x " + std::to_string(e.height));
    double sum = 0.0, solid_angles = 0.0;
    for (std::uint32_t y = card[1]; y < card[1] + card[3]; ++y) {
        const double texel = double{shading::equirect_texel_solid_angle(y, e.width, e.height)};
        for (std::uint32_t x = card[0]; x < card[0] + card[2]; ++x)
            sum += texel * double{shading::luminance(e.luminance_nit[std::size_t{y} * e.width + x])};
        solid_angles += texel * card[2];
    }
    return sum / solid_angles;
}

int calibrate(const EnvOptions& options) {
    if (!(options.value_nit > 0.0f && options.value_nit <= 1e12f))
        throw Error(Fault::usage, "out of range", "--value", "cd/m2, above 0, to 1e+12");
    if (!options.output.empty() && std::filesystem::path(options.output).extension() != ".exr")
        throw Error(Fault::usage, "not a name of an EXR file: " + options.output, "-o", "FILE.exr");
    if (!options.output.empty()) io::check_output_file(options.output);
    Diagnostics diagnostics;
    io::ReadEnvironment e = environment_picture(options.file, options.how, diagnostics);
    const double mean = mean_luminance(e, options.card);
    if (!(mean > 0.0)) throw input_error("the grey card is black", e.name);
    const double factor = double{options.value_nit} / mean;
    e.scale = static_cast<float>(factor);
    e.absolute = true;
    if (!options.output.empty()) write_map(options.output, e);
    if (options.json) {
        json out{{"factor", factor},
                 {"mean_before", mean},
                 {"upward_illuminance_lx", scene::upward_illuminance_lx(e)}};
        if (!options.output.empty()) out["output"] = options.output;
        print_json(out, options, diagnostics);
        return 0;
    }
    std::printf("%s: --env-scale %s makes the card %s; %s lx facing up\n", options.file.c_str(),
                measure::number(factor, 7).c_str(), nit(double{options.value_nit}).c_str(),
                measure::readable(scene::upward_illuminance_lx(e)).c_str());
    print_warnings(diagnostics);
    if (!options.output.empty()) print_written(options.output);
    return 0;
}

json light_json(const scene::Light& light) {
    return {{"name", light.name},
            {"type", "sun"},
            {"illuminance_lx", light.intensity},
            {"color", {light.color.x, light.color.y, light.color.z}},
            {"direction", {light.direction.x, light.direction.y, light.direction.z}},
            {"angular_diameter_deg", std::max(kDegPerRad * double{light.angular_diameter_rad}, 0.01)}};
}

/// All light, in lx at normal incidence from everywhere: what must not change.
double total_lx(const Environment& e) {
    return 4.0 * M_PI * shading::luminance(scene::mean_nit(e));
}

int split(const EnvOptions& options) {
    if (!(options.contrast >= 2.0f && options.contrast <= 1e9f))
        throw Error(Fault::usage, "out of range", "--contrast", "2 to 1e+09");
    io::check_output_folder(options.output);
    Diagnostics diagnostics;
    io::ReadEnvironment e = read(options, diagnostics);
    const double before_lx = total_lx(e);
    scene::SourceLimits limits;
    limits.contrast = double{options.contrast};
    const std::vector<EnvironmentSource> sources = scene::find_sources(e, limits);
    const std::vector<scene::Light> lights = scene::take_out(e, sources);
    const std::string stem = std::filesystem::path(e.name).stem().string();
    const std::string map = (stem.empty() ? "environment" : stem) + ".exr";
    json stage{{"environment", {{"file", map}, {"layout", "equirect"}, {"keep_sun", true}}},
               {"lights", json::array()}};
    json list = json::array();
    double lights_lx = 0.0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        stage["lights"].push_back(light_json(lights[i]));
        list.push_back(source_json(sources[i]));
        lights_lx += double{lights[i].intensity};
    }
    io::detail::StagingFolder files(options.output);
    write_map(files.file(map), e);
    const std::string text = stage.dump(2) + "\n";
    io::write_file(files.file("stage.json"), std::as_bytes(std::span(text)));
    (void)files.commit();
    const double after_lx = total_lx(e) + lights_lx;
    if (options.json) {
        print_json({{"sources", list},
                    {"folder", options.output},
                    {"total_before_lx", before_lx},
                    {"total_after_lx", after_lx}},
                   options, diagnostics);
        return 0;
    }
    std::printf("%s: %zu taken out into %s\n", options.file.c_str(), lights.size(), options.output.c_str());
    for (const json& s : list) print_line("source", source_text(s));
    print_line("energy", measure::number(100.0 * after_lx / before_lx) + " % of what it was");
    print_warnings(diagnostics);
    print_written(options.output);
    return 0;
}

CLI::App* add_verb(CLI::App& env, const std::string& name, const std::string& text,
                   const std::shared_ptr<EnvOptions>& o, Action& action, int (*run)(const EnvOptions&)) {
    CLI::App* verb = env.add_subcommand(name, text);
    verb->add_option("ENV", o->file, "An environment, as --env of render takes it")->required();
    add_environment_file_options(*verb, o->how);
    verb->add_flag("--json", o->json, "Print one JSON object on standard output");
    verb->callback([o, verb, &action, run] {
        check_environment_reading(*verb, o->file);
        refuse_together(*verb, {"--env-scale", "--env-lux"});
        action = [o, run] { return run(*o); };
    });
    return verb;
}

void add_scale(CLI::App& verb, EnvOptions& o) {
    verb.add_option("--env-scale", o.scale, "Multiplies the luminance");
    verb.add_option("--env-lux", o.lux, "Scales to this up-facing illuminance in lx");
}

}  // namespace

void add_env(CLI::App& app, Action& action) {
    auto o = std::make_shared<EnvOptions>();
    CLI::App* env =
        app.add_subcommand("env", "Distant light: what is in it, its absolute level, its sun and lamps");
    env->require_subcommand(1);
    add_scale(*add_verb(*env, "info", "Illuminance, luminances, peak and sun", o, action, info), *o);
    CLI::App* card = add_verb(*env, "calibrate", "Scale by something in the picture of known luminance", o,
                              action, calibrate);
    card->add_option("--grey-card", o->card, "x,y,w,h of it in texels of the equirectangular picture")
        ->delimiter(',')
        ->expected(4)
        ->required();
    card->add_option("--value", o->value_nit, "Its luminance in cd/m2")->required();
    card->add_option("-o,--output", o->output, "Write the scaled picture, .exr");
    CLI::App* verb =
        add_verb(*env, "split", "Take the sun and lamps out, as lights of a stage file", o, action, split);
    add_scale(*verb, *o);
    verb->add_option("--contrast", o->contrast, "Of a source's peak to what surrounds it")
        ->capture_default_str();
    verb->add_option("-o,--output", o->output, "Folder for stage.json and the picture without them")
        ->required();
}

}  // namespace candela::app
