#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "candela/io/image_write.hpp"
#include "candela/io/output_folder.hpp"
#include "candela/io/photometric.hpp"
#include "candela/measure/numerics.hpp"
#include "candela/measure/polar_plot.hpp"
#include "candela/scene/error.hpp"
#include "candela/scene/printable.hpp"
#include "command.hpp"
#include "job.hpp"
#include "option_rules.hpp"
#include "progress_line.hpp"

namespace candela::app {
namespace {

using nlohmann::json;
using scene::PhotometricProfile;

struct LightOptions {
    std::string file;
    std::string plot;
    std::size_t lamp_set = 1;
    bool per_klm = false;
    bool json = false;
};

const char* type_name(scene::PhotometricType type) {
    switch (type) {
        case scene::PhotometricType::b:
            return "B";
        case scene::PhotometricType::a:
            return "A";
        default:
            return "C";
    }
}

const char* symmetry_name(scene::PhotometricSymmetry symmetry) {
    switch (symmetry) {
        case scene::PhotometricSymmetry::axial:
            return "about the vertical axis";
        case scene::PhotometricSymmetry::plane_c0_c180:
            return "to plane C0-C180";
        case scene::PhotometricSymmetry::plane_c90_c270:
            return "to plane C90-C270";
        case scene::PhotometricSymmetry::both_planes:
            return "to planes C0-C180 and C90-C270";
        default:
            return "none";
    }
}

json number_or_null(const std::optional<double>& value) {
    return value ? json(*value) : json(nullptr);
}

json spread_json(const scene::PhotometricSpread& spread) {
    return {{"c0_c180_deg", number_or_null(spread.c0_c180_deg)},
            {"c90_c270_deg", number_or_null(spread.c90_c270_deg)}};
}

json size_json(const glm::dvec3& size_m) {
    return {{"along_c0_m", size_m.x}, {"along_c90_m", size_m.y}, {"height_m", size_m.z}};
}

json lamps_json(const scene::PhotometricLamps& lamps) {
    return {{"count", lamps.count},
            {"type", lamps.type},
            {"flux_lm", number_or_null(lamps.flux_lm)},
            {"power_w", number_or_null(lamps.power_w)},
            {"color_temperature_kelvin", number_or_null(lamps.temperature_kelvin)},
            {"color", lamps.color},
            {"color_rendering", lamps.color_rendering}};
}

json profile_json(const PhotometricProfile& p) {
    const scene::PhotometricPeak peak = scene::peak(p);
    const double integrated = scene::integrated_lm(p);
    json out{
        {"name", p.name},
        {"standard", p.standard},
        {"photometric_type", type_name(p.type)},
        {"photometry", p.absolute ? "absolute" : "relative"},
        {"symmetry", symmetry_name(p.symmetry)},
        {"integrated_lm", integrated},
        {"stated_lm", number_or_null(scene::stated_lm(p))},
        {"downward_fraction", integrated > 0.0 ? json(scene::downward_lm(p) / integrated) : json(nullptr)},
        {"peak", {{"intensity_cd", peak.candela}, {"c_deg", peak.c_deg}, {"gamma_deg", peak.gamma_deg}}},
        {"beam_angle", spread_json(scene::beam_angle(p))},
        {"field_angle", spread_json(scene::field_angle(p))},
        {"multiplier", p.multiplier},
        {"ballast_factor", p.ballast_factor},
        {"opening", size_json(p.opening_m)},
        {"round", p.round},
        {"lamp_set", p.lamp_set + 1},
        {"lamp_sets", json::array()},
        {"keywords", json::array()}};
    if (p.light_output_ratio) out["light_output_ratio"] = *p.light_output_ratio;
    if (p.housing_m) out["housing"] = size_json(*p.housing_m);
    if (!p.tilt.angles_deg.empty())
        out["tilt"] = {{"lamp_to_luminaire_geometry", p.tilt.lamp_to_luminaire_geometry},
                       {"angles_deg", p.tilt.angles_deg},
                       {"factors", p.tilt.factors}};
    for (const scene::PhotometricLamps& lamps : p.lamp_sets) out["lamp_sets"].push_back(lamps_json(lamps));
    for (const auto& [key, value] : p.keywords) out["keywords"].push_back({{"key", key}, {"value", value}});
    return out;
}

/// A relative IES file states its lamps' lumens, of which a luminaire loses some; it is said all the same,
/// since a file with a wrong multiplier looks no different.
void judge_lumens(const PhotometricProfile& p, Diagnostics& diagnostics) {
    constexpr double tolerance = 0.02;
    const std::optional<double> stated = scene::stated_lm(p);
    const double integrated = scene::integrated_lm(p);
    if (!stated || !(std::abs(integrated - *stated) > tolerance * *stated)) return;
    if (*stated <= 0.0) {
        diagnostics.warn("the file states 0 lm, its web integrates to " + measure::readable(integrated) +
                         " lm");
        return;
    }
    const bool lamps_only = p.format == scene::PhotometricFormat::ies;
    std::string text = "the web integrates to " + measure::readable(integrated) + " lm, " +
                       measure::readable(100.0 * integrated / *stated) + " % of the " +
                       measure::readable(*stated) + " lm that the file states" +
                       (lamps_only ? " for its lamps" : " for the luminaire");
    if (lamps_only && integrated < *stated) text += "; the rest stays in the luminaire, or the file is wrong";
    if (lamps_only && integrated > *stated) text += ": more than goes in";
    diagnostics.warn(text);
}

std::string spread_text(const scene::PhotometricSpread& spread) {
    const auto text = [](const std::optional<double>& angle) {
        return angle ? measure::fixed(*angle, 1) : std::string("none");
    };
    return text(spread.c0_c180_deg) + " deg in C0-C180, " + text(spread.c90_c270_deg) + " deg in C90-C270";
}

std::string size_text(const glm::dvec3& size_m, bool round) {
    return measure::number(size_m.x) + " m along C0, " + measure::number(size_m.y) + " m along C90, " +
           measure::number(size_m.z) + " m high" + (round ? ", round" : "");
}

void print_line(const char* label, const std::string& text) {
    std::printf("  %-12s %s\n", label, printable(text).c_str());
}

std::string lamps_text(const scene::PhotometricLamps& lamps) {
    std::string out = std::to_string(lamps.count);
    if (!lamps.type.empty()) out += " x " + lamps.type.substr(0, lamps.type.find('\n'));
    if (lamps.flux_lm) out += ", " + measure::readable(*lamps.flux_lm) + " lm";
    if (lamps.power_w) out += ", " + measure::readable(*lamps.power_w) + " W";
    if (lamps.temperature_kelvin) out += ", " + measure::readable(*lamps.temperature_kelvin) + " K";
    return out;
}

void print_profile(const std::string& file, const PhotometricProfile& p) {
    const scene::PhotometricPeak peak = scene::peak(p);
    const std::optional<double> stated = scene::stated_lm(p);
    std::printf("%s: %s\n", printable(file).c_str(), printable(p.name).c_str());
    print_line("format", p.standard + ", type " + type_name(p.type) +
                             (p.absolute ? ", absolute photometry" : ", relative photometry"));
    print_line("lumens", measure::readable(scene::integrated_lm(p)) + " lm integrated, " +
                             (stated ? measure::readable(*stated) + " lm stated" : "none stated"));
    print_line("peak", measure::readable(peak.candela) + " cd at C" + measure::number(peak.c_deg) +
                           " gamma " + measure::number(peak.gamma_deg));
    print_line("beam", spread_text(scene::beam_angle(p)) + " (50 %)");
    print_line("field", spread_text(scene::field_angle(p)) + " (10 %)");
    print_line("symmetry", symmetry_name(p.symmetry));
    print_line("opening", size_text(p.opening_m, p.round));
    if (p.housing_m) print_line("housing", size_text(*p.housing_m, false));
    for (std::size_t i = 0; i < p.lamp_sets.size(); ++i) {
        const bool other = i != p.lamp_set;
        print_line("lamps", lamps_text(p.lamp_sets[i]) + (other ? " (alternative)" : ""));
    }
    if (!p.tilt.angles_deg.empty())
        print_line("tilt",
                   "the lamp dims with the luminaire's tilt, to " +
                       measure::number(*std::min_element(p.tilt.factors.begin(), p.tilt.factors.end())));
}

void write_plot(const PhotometricProfile& profile, const LightOptions& options) {
    constexpr double pixels_per_px = 2.0;
    const measure::Drawing drawing = measure::polar_plot(profile, options.per_klm);
    if (options.plot.ends_with(".svg")) {
        const std::string svg = measure::svg_of(drawing);
        io::write_file(options.plot, std::as_bytes(std::span(svg)));
        return;
    }
    const measure::Panel picture = measure::picture_of(drawing, pixels_per_px);
    io::write_png(options.plot, picture.width, picture.height, std::span<const std::uint8_t>(picture.rgb),
                  {{"Title", drawing.title}});
}

int light(const LightOptions& options) {
    if (!options.plot.empty()) io::check_output_file(options.plot);
    Diagnostics diagnostics;
    const PhotometricProfile profile =
        io::load_photometric(options.file, diagnostics, {options.lamp_set - 1});
    judge_lumens(profile, diagnostics);
    if (!options.plot.empty()) write_plot(profile, options);
    if (options.json) {
        json out = profile_json(profile);
        out["file"] = options.file;
        out["warnings"] = warnings_json(diagnostics);
        if (!options.plot.empty()) out["plot"] = options.plot;
        std::printf("%s\n", out.dump(2, ' ', false, json::error_handler_t::replace).c_str());
        return 0;
    }
    print_profile(options.file, profile);
    for (const Diagnostics::Warning& w : diagnostics.warnings()) print_line("warning", w.text);
    if (!options.plot.empty()) print_written(options.plot);
    return 0;
}

std::string check_plot_name(const std::string& name) {
    return name.ends_with(".svg") || name.ends_with(".png") ? "" : name + " is neither .svg nor .png";
}

}  // namespace

void add_light(CLI::App& app, Action& action) {
    auto options = std::make_shared<LightOptions>();
    CLI::App* command = app.add_subcommand("light", "What is in a photometric file: IES LM-63 or EULUMDAT");
    command->add_option("FILE", options->file, "An .ies or .ldt file")->required();
    command->add_option("--plot", options->plot, "Write the polar diagram as .svg or .png")
        ->check(check_plot_name);
    command->add_option("--lamps", options->lamp_set, "Which of EULUMDAT's lamp sets, from 1")
        ->check(CLI::Range(std::size_t{1}, std::size_t{20}));
    command->add_flag("--per-klm", options->per_klm, "Diagram for 1000 lm of the lamps instead of in cd");
    command->add_flag("--json", options->json, "Print one JSON object on standard output");
    command->callback([options, command, &action] {
        if (!given(*command, "--plot"))
            refuse_without_effect(*command, {"--per-klm"}, "without a diagram", "--plot FILE.svg");
        action = [options] { return light(*options); };
    });
}

}  // namespace candela::app
