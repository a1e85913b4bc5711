#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "candela/io/image_write.hpp"
#include "candela/io/output_folder.hpp"
#include "candela/measure/report_html.hpp"
#include "candela/scene/error.hpp"
#include "candela/version.hpp"
#include "command.hpp"
#include "compare_analysis.hpp"
#include "compare_maps.hpp"
#include "compare_pictures.hpp"
#include "compare_table.hpp"
#include "option_rules.hpp"
#include "progress_line.hpp"
#include "shading/exposure.glsl"
#include "shading/tone_curves.glsl"

namespace candela::app {
namespace {

using nlohmann::json;

struct CompareOptions {
    SceneOptions scene;
    std::vector<std::string> inputs;
    std::vector<std::string> outputs;
    std::string command_line;  ///< for the report
    bool no_truth = false;
    std::vector<std::string> thresholds;
    std::vector<std::string> names;
    std::optional<float> exposure_ev100;
    double pixels_per_degree = measure::pixels_per_degree();
};

struct Threshold {
    std::string metric;
    double limit = 0.0;
};

std::string lower_extension(const std::string& file) {
    std::string e = std::filesystem::path(file).extension().string();
    std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return e;
}

bool is_scene(const std::string& file) {
    const std::string e = lower_extension(file);
    return e == ".glb" || e == ".gltf";
}

Threshold parse_threshold(const std::string& text) {
    const auto wrong = [&](const std::string& what) {
        std::string names;
        for (const std::string& name : measure::metric_names()) names += (names.empty() ? "" : ", ") + name;
        return Error(Fault::usage, what + ": " + text, "--threshold", "METRIC=VALUE, metrics: " + names);
    };
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) throw wrong("not a threshold");
    Threshold out{text.substr(0, equals), 0.0};
    std::transform(out.metric.begin(), out.metric.end(), out.metric.begin(),
                   [](char c) { return c == '_' ? '-' : c; });
    const auto& names = measure::metric_names();
    if (std::find(names.begin(), names.end(), out.metric) == names.end()) throw wrong("no such metric");
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + equals + 1, end, out.limit);
    if (error != std::errc{} || stop != end || std::isnan(out.limit)) throw wrong("not a number");
    return out;
}

/// What can be refused before anything is read or rendered.
void check_request(const CompareOptions& options) {
    for (const std::string& file : options.outputs) {
        const std::string e = lower_extension(file);
        if (e != ".png" && e != ".exr" && e != ".html")
            throw Error(Fault::usage, "unknown kind of output", file, ".html, .png or .exr");
        io::check_output_file(file);
    }
    refuse_same_output(options.outputs);
    const SceneOptions& scene = options.scene;
    const std::size_t pictures = is_scene(options.inputs[0]) ? scene.picture_count() : options.inputs.size();
    if (!options.names.empty() && options.names.size() != pictures)
        throw Error(Fault::usage, "as many names as pictures are needed", "--names",
                    std::to_string(pictures) + " pictures here");
    const auto scenes = std::count_if(options.inputs.begin(), options.inputs.end(), is_scene);
    if (scenes == 0 && options.inputs.size() < 2)
        throw Error(Fault::usage, "one picture has nothing to be compared with", options.inputs[0],
                    "candela compare A.exr REFERENCE.exr, or candela compare SCENE.glb");
    if (scenes > 0 && options.inputs.size() > 1)
        throw Error(Fault::usage, "a scene is compared with its own truth", options.inputs[1],
                    "candela compare SCENE.glb --profile best --profile ue4");
}

/// The pictures to compare and which of them is the reference.
struct Lineup {
    std::vector<NamedPicture> pictures;
    std::size_t reference = 0;
    Diagnostics diagnostics;
};

Lineup line_up(const CompareOptions& options) {
    Lineup out;
    if (is_scene(options.inputs[0])) {
        SceneOptions scene = options.scene;
        scene.job.scene_file = options.inputs[0];
        if (scene.profiles.empty()) scene.profiles = {"best"};
        if (scene.picture_count() < 2)
            throw Error(Fault::usage, "one picture has nothing to be compared with",
                        options.no_truth ? "--no-truth" : "--modes",
                        "another mode, or a second --profile: the first is the reference then");
        out.pictures = render_pictures(scene, out.diagnostics);
    } else {
        for (const std::string& file : options.inputs)
            out.pictures.push_back(load_picture(file, out.diagnostics));
        out.reference = out.pictures.size() - 1;
    }
    if (!options.names.empty()) {
        for (std::size_t i = 0; i < options.names.size(); ++i) out.pictures[i].name = options.names[i];
    } else {
        // Pictures of one name in two folders are told apart by their paths.
        for (std::size_t i = 0; i < out.pictures.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (out.pictures[i].name == out.pictures[j].name && !is_scene(options.inputs[0])) {
                    out.pictures[i].name = options.inputs[i];
                    out.pictures[j].name = options.inputs[j];
                }
    }
    const measure::Picture& reference = out.pictures[out.reference].picture;
    for (const NamedPicture& p : out.pictures) {
        if (p.picture.width == reference.width && p.picture.height == reference.height) continue;
        const auto size = [](const measure::Picture& q) {
            return std::to_string(q.width) + "x" + std::to_string(q.height);
        };
        const bool files = !is_scene(options.inputs[0]);
        const auto index = static_cast<std::size_t>(&p - out.pictures.data());
        throw input_error("is " + size(p.picture) + " pixels, the reference " +
                              (files ? options.inputs[out.reference] : out.pictures[out.reference].name) +
                              " " + size(reference),
                          files ? options.inputs[index] : p.name, "pictures of one size are needed");
    }
    return out;
}

struct Exposed {
    measure::ComparisonOptions options;
    float ev100 = 0.0f;
    const char* source = "none";
};

/// The exposure of the display pictures: asked for, the reference's, any picture's, or metered.
Exposed choose_exposure(const CompareOptions& options, const Lineup& lineup) {
    Exposed out;
    out.options.pixels_per_degree = options.pixels_per_degree;
    const std::string& tone = options.scene.job.tonemap;
    out.options.tone_curve = tone == "none"   ? shading::kToneNone
                             : tone == "aces" ? shading::kToneAces
                             : tone == "agx"  ? shading::kToneAgx
                                              : shading::kToneNeutral;
    std::vector<const NamedPicture*> order{&lineup.pictures[lineup.reference]};
    for (const NamedPicture& p : lineup.pictures) order.push_back(&p);
    const auto found = std::find_if(order.begin(), order.end(), [](const auto* p) { return p->exposure; });
    if (options.exposure_ev100) {
        out.ev100 = *options.exposure_ev100;
        out.source = "--exposure";
    } else if (found != order.end()) {
        out.options.exposure = *(*found)->exposure;
        out.ev100 = (*found)->ev100.value_or(shading::ev100_from_standard_output(out.options.exposure));
        out.source = "picture";
        return out;
    } else {
        const auto lit = std::find_if(order.begin(), order.end(), [](const auto* p) {
            return p->meaning == measure::PixelMeaning::luminance && measure::metered_ev100(p->picture);
        });
        if (lit != order.end()) {
            out.ev100 = *measure::metered_ev100((*lit)->picture);
            out.source = "metered";
        }
    }
    out.options.exposure = shading::standard_output_exposure(out.ev100);
    return out;
}

/// Luminance beside a display picture can only be compared as a display picture.
void agree_on_meaning(Lineup& lineup, Exposed& exposed) {
    const bool display = std::any_of(lineup.pictures.begin(), lineup.pictures.end(), [](const auto& p) {
        return p.meaning == measure::PixelMeaning::display;
    });
    exposed.options.meaning = measure::PixelMeaning::luminance;
    if (!display) return;
    for (NamedPicture& p : lineup.pictures) {
        if (p.meaning == measure::PixelMeaning::display) continue;
        p.picture = measure::display_picture(p.picture, exposed.options);
        lineup.diagnostics.warn(p.name + ": compared as a display picture, exposed and tone mapped");
    }
    exposed.options.meaning = measure::PixelMeaning::display;
}

/// diff.exr is diff-NAME.exr when there are several differences.
std::string output_name(const std::string& file, const std::string& name, bool several) {
    if (!several) return file;
    const std::filesystem::path path(file);
    std::string safe = name;
    std::replace(safe.begin(), safe.end(), '/', '_');
    std::replace(safe.begin(), safe.end(), ' ', '-');
    return (path.parent_path() / (path.stem().string() + "-" + safe + path.extension().string())).string();
}

/// Writes every output and returns the files.
std::vector<std::string> write_outputs(const CompareOptions& options, Lineup& lineup, const Exposed& exposed,
                                       const Analysis& analysis,
                                       std::vector<measure::Comparison>& comparisons) {
    std::vector<std::string> written;
    const measure::Picture& reference = lineup.pictures[lineup.reference].picture;
    const bool several = lineup.pictures.size() > 2;
    for (const std::string& file : options.outputs) {
        if (lower_extension(file) == ".html") continue;
        for (std::size_t i = 0; i < lineup.pictures.size(); ++i) {
            if (i == lineup.reference) continue;
            written.push_back(output_name(file, lineup.pictures[i].name, several));
            if (lower_extension(file) == ".exr")
                write_map_exr(written.back(), lineup.pictures[i].picture, reference, comparisons[i]);
            else
                write_map_png(written.back(), comparisons[i].flip);
        }
    }
    std::string title = "candela compare";
    for (const std::string& input : options.inputs)
        title += " " + std::filesystem::path(input).filename().string();
    std::string page;
    for (const std::string& file : options.outputs) {
        if (lower_extension(file) != ".html") continue;
        if (page.empty()) {
            measure::Report report{title, {}, lineup.reference, exposed.options, exposed.ev100, version()};
            report.command = options.command_line;
            report.noise = analysis.noise;
            for (std::size_t i = 0; i < lineup.pictures.size(); ++i) {
                NamedPicture& p = lineup.pictures[i];
                report.pictures.push_back(
                    {p.name, p.picture, p.settings, comparisons[i], analysis.verdicts[i], analysis.paths[i]});
            }
            page = measure::report_html(report);
        }
        io::write_file(file, std::as_bytes(std::span<const char>(page)));
        written.push_back(file);
    }
    return written;
}

json number(double value) {
    return std::isfinite(value) ? json(value) : json(nullptr);
}

json metrics_json(const measure::Metrics& m) {
    json out = json::object();
    for (const std::string& name : measure::metric_names()) {
        std::string key = name;
        std::replace(key.begin(), key.end(), '-', '_');
        if (const auto value = measure::metric_value(m, name)) out[key] = number(*value);
    }
    out["flip_max"] = m.flip_max;
    out["bias_rgb"] = m.errors.bias;
    return out;
}

/// Metrics down, pictures across, the reference's own noise last.
void print_table(const Lineup& lineup, const std::vector<measure::Comparison>& comparisons,
                 const Analysis& analysis, const Exposed& exposed) {
    const bool luminance = exposed.options.meaning == measure::PixelMeaning::luminance;
    const measure::Picture& reference = lineup.pictures[lineup.reference].picture;
    std::printf("reference %s, %ux%u, ", lineup.pictures[lineup.reference].name.c_str(), reference.width,
                reference.height);
    if (luminance)
        std::printf("luminance in cd/m2, shown at EV100 %.2f (%s)\n", double(exposed.ev100), exposed.source);
    else
        std::printf("display values\n");
    MetricTable table;
    for (std::size_t i = 0; i < lineup.pictures.size(); ++i)
        if (i != lineup.reference) table.pictures.push_back(lineup.pictures[i].name);
    if (analysis.noise) table.pictures.push_back("noise of " + lineup.pictures[lineup.reference].name);
    for (const std::string& name : measure::metric_names()) {
        if (name == "hdr-flip" && !luminance) continue;
        MetricTable::Row row{name, {}};
        for (std::size_t i = 0; i < lineup.pictures.size(); ++i)
            if (i != lineup.reference)
                row.values.push_back(measure::metric_value(comparisons[i].metrics, name).value_or(0.0));
        if (analysis.noise) row.values.push_back(measure::metric_value(*analysis.noise, name).value_or(0.0));
        table.rows.push_back(std::move(row));
    }
    print(table);
    for (const std::string& line : analysis.verdicts)
        if (!line.empty()) std::printf("%s\n", line.c_str());
}

/// One line for each threshold that is missed; JSON of all.
json check_thresholds(const std::vector<Threshold>& thresholds, const Lineup& lineup,
                      const std::vector<measure::Comparison>& comparisons, bool& passed) {
    json out = json::array();
    for (const Threshold& t : thresholds) {
        for (std::size_t i = 0; i < lineup.pictures.size(); ++i) {
            if (i == lineup.reference) continue;
            const std::string& name = lineup.pictures[i].name;
            const auto value = measure::metric_value(comparisons[i].metrics, t.metric);
            if (!value) {
                throw Error(Fault::usage, t.metric + " is not defined for display pictures", "--threshold",
                            "compare EXR files");
            }
            const bool minimum = measure::more_is_better(t.metric);
            const bool good = minimum ? *value >= t.limit : *value <= t.limit;
            out.push_back({{"metric", t.metric},
                           {"picture", name},
                           {"value", number(*value)},
                           {"limit", t.limit},
                           {"passed", good}});
            if (good) continue;
            passed = false;
            std::fprintf(stderr, "candela: %s: %s is %.6g, %s %.6g is allowed\n", name.c_str(),
                         t.metric.c_str(), *value, minimum ? "at least" : "at most", t.limit);
        }
    }
    return out;
}

int compare(const CompareOptions& options) {
    check_request(options);
    std::vector<Threshold> thresholds;
    for (const std::string& text : options.thresholds) thresholds.push_back(parse_threshold(text));
    Lineup lineup = line_up(options);
    Exposed exposed = choose_exposure(options, lineup);
    agree_on_meaning(lineup, exposed);
    const measure::Picture& reference = lineup.pictures[lineup.reference].picture;
    std::vector<measure::Comparison> comparisons(lineup.pictures.size());
    for (std::size_t i = 0; i < lineup.pictures.size(); ++i) {
        if (i == lineup.reference) continue;
        ProgressLine line("comparing " + lineup.pictures[i].name + " with " +
                          lineup.pictures[lineup.reference].name);
        measure::ComparisonOptions how = exposed.options;
        how.progress = line.function();
        comparisons[i] = measure::compare(lineup.pictures[i].picture, reference, how);
        if (comparisons[i].metrics.nonfinite > 0) {
            lineup.diagnostics.warn(lineup.pictures[i].name + ": " +
                                    std::to_string(comparisons[i].metrics.nonfinite) +
                                    " pixels are NaN or infinite here or in the reference and left out");
        }
    }
    bool passed = true;
    const json checks = check_thresholds(thresholds, lineup, comparisons, passed);
    const Analysis analysis = analyse(lineup.pictures, lineup.reference, exposed.options, comparisons);
    const std::vector<std::string> written = [&] {
        const ProgressLine line("writing");
        return write_outputs(options, lineup, exposed, analysis, comparisons);
    }();
    print_warnings(lineup.diagnostics);
    if (!options.scene.job.json) {
        print_table(lineup, comparisons, analysis, exposed);
        for (const std::string& file : written) std::fprintf(stderr, "candela: wrote %s\n", file.c_str());
        return passed ? 0 : 1;
    }
    const bool luminance = exposed.options.meaning == measure::PixelMeaning::luminance;
    json out{{"version", version()},
             {"reference", lineup.pictures[lineup.reference].name},
             {"width", reference.width},
             {"height", reference.height},
             {"unit", luminance ? "cd/m2" : "display"},
             {"pixels_per_degree", exposed.options.pixels_per_degree},
             {"pictures", json::array()},
             {"thresholds", checks},
             {"passed", passed},
             {"outputs", written},
             {"warnings", warnings_json(lineup.diagnostics)}};
    if (analysis.noise) out["reference_noise"] = metrics_json(*analysis.noise);
    if (luminance) {
        out["ev100"] = exposed.ev100;
        out["exposure"] = exposed.options.exposure;
        out["exposure_source"] = exposed.source;
    }
    for (std::size_t i = 0; i < lineup.pictures.size(); ++i) {
        if (i == lineup.reference) continue;
        out["pictures"].push_back({{"name", lineup.pictures[i].name},
                                   {"verdict", analysis.verdicts[i]},
                                   {"metrics", metrics_json(comparisons[i].metrics)}});
        if (!analysis.paths[i].empty()) out["pictures"].back()["light_paths"] = paths_json(analysis.paths[i]);
    }
    std::printf("%s\n", out.dump(2, ' ', false, json::error_handler_t::replace).c_str());
    return passed ? 0 : 1;
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command = app.add_subcommand("compare",
                                           "Hold pictures against a reference (the last one), or a scene's "
                                           "real-time frame against its ground truth");
    command->add_option("PICTURES", options->inputs, "A.exr|.hdr|.png ... REFERENCE, or one SCENE.glb|.gltf")
        ->required();
    command->add_option("-o,--output", options->outputs,
                        "report.html, diff.exr or diff.png; may be given several times");
    command->add_option("--threshold", options->thresholds,
                        "METRIC=VALUE: exit code 1 when worse; may be given several times");
    command->add_option("--names", options->names, "Names of the pictures, separated by commas")
        ->delimiter(',');
    command->add_option("--exposure", options->exposure_ev100, "EV100 at which luminance is shown")
        ->check(number_in(-30.0, 40.0));
    command->add_option("--pixels-per-degree", options->pixels_per_degree, "How large FLIP sees a pixel")
        ->check(number_in(1.0, 500.0))
        ->capture_default_str();
    add_compared_scene_options(*command, options->scene);
    command->callback([options, command, &action] {
        options->command_line = command_line();
        options->no_truth = given(*command, "--no-truth");
        check_compare_options(*command, options->scene,
                              std::any_of(options->inputs.begin(), options->inputs.end(), is_scene));
        action = [options] { return compare(*options); };
    });
}

}  // namespace candela::app
