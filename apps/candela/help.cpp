#include "help.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>

#include "candela/io/json_reader.hpp"
#include "candela/scene/error.hpp"

namespace candela::app {
namespace {

constexpr const char* kWhat = "What is shown";
constexpr const char* kLight = "Light";
constexpr const char* kCamera = "Camera and exposure";
constexpr const char* kQuality = "Quality and speed";
constexpr const char* kOutput = "Output";

const std::map<std::string, std::vector<std::string>>& options_of_groups() {
    static const std::map<std::string, std::vector<std::string>> groups{
        {kWhat,
         {"--stage", "--search", "--time", "--animation", "--variant", "--units", "--line-width", "--strict",
          "--at", "--normal", "--pixel", "--from", "--towards", "--field-deg", "--only", "--list"}},
        {kLight, {"--shadows", "--furnace", "--direct-only", "--max-bounces", "--emissive-scale"}},
        {kCamera,
         {"--size", "--width", "--height", "--camera", "--look-from", "--look-at", "--focal-mm", "--aperture",
          "--shutter", "--iso", "--ev100", "--auto-exposure", "--depth-of-field", "--focus-m", "--exposure"}},
        {kQuality,
         {"--mode", "--modes", "--profile", "--samples", "--time-limit", "--target-error", "--path-spp",
          "--integrate-spp", "--seed", "--shadow-atlas", "--no-truth", "--device", "--validation", "--memory",
          "--threads", "--checkpoint", "--checkpoint-every", "--frames", "--refresh"}},
        {kOutput,
         {"--output", "--png-bits", "--exr-type", "--aov", "--tonemap", "--json", "--names", "--threshold",
          "--pixels-per-degree", "--plot", "--per-klm", "--techniques"}}};
    return groups;
}

/// By name, and for names of a family by how they begin.
std::string group_of(const std::string& option) {
    for (const auto& [group, options] : options_of_groups()) {
        if (std::find(options.begin(), options.end(), option) != options.end()) return group;
    }
    for (const char* family : {"--env", "--light", "--emi", "--sun", "--sky"}) {
        if (option.starts_with(family)) return kLight;
    }
    for (const char* family : {"--exposure", "--meter"}) {
        if (option.starts_with(family)) return kCamera;
    }
    return {};
}

/// The groups in one order in every command, whichever option was added first.
class Formatter final : public CLI::Formatter {
  public:
    Formatter() { column_width(34); }

    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
        if (mode == CLI::AppFormatMode::Sub) return CLI::Formatter::make_help(app, std::move(name), mode);
        return make_description(app) + make_usage(app, std::move(name)) + make_positionals(app) +
               ordered_groups(app) + make_subcommands(app, mode) + "\n" + make_footer(app);
    }

  private:
    std::string ordered_groups(const CLI::App* app) const {
        std::vector<std::string> groups{kWhat, kLight, kCamera, kQuality, kOutput};
        for (const std::string& group : app->get_groups()) {
            if (!group.empty() && group != "Options" &&
                std::find(groups.begin(), groups.end(), group) == groups.end())
                groups.push_back(group);
        }
        groups.emplace_back("Options");
        std::string out;
        for (const std::string& group : groups) {
            const auto options = app->get_options([&](const CLI::Option* option) {
                return option->get_group() == group && option->nonpositional();
            });
            if (!options.empty()) out += make_group(group, false, options);
        }
        return out;
    }
};

struct Example {
    const char* arguments;
    const char* what;
};

const std::map<std::string, std::vector<Example>>& examples() {
    static const std::map<std::string, std::vector<Example>> all{
        {"render",
         {{"scene.glb -o picture.png", "framed, lit by the studio if dark, metered"},
          {"scene.glb --env sky.exr --env-lux 20000 -o a.png -o a.exr",
           "20,000 lx from a picture of the sky"},
          {"scene.glb --env sky:elevation=35 --aperture f/16 --shutter 1/125 --iso 100 -o a.png",
           "a clear sky, exposed by hand"},
          {"scene.glb --mode path --target-error 0.02 -o truth.exr", "ground truth, to an error of 2 %"},
          {"scene.glb --stage evening.stage.json --look-from 2,1,3 --width 1920 -o a.png",
           "a stage's light, from elsewhere"}}},
        {"info",
         {{"", "the devices"},
          {"scene.glb --stage evening.stage.json", "lights in all their units, cameras, probes"}}},
        {"bench", {{"scene.glb --size 1280x720", "start-up, times of the passes, memory"}}},
        {"compare",
         {{"fast.exr truth.exr -o report.html", "two pictures; the last is the reference"},
          {"scene.glb -o report.html", "real time beside path and integrate"},
          {"scene.glb --modes realtime,path --path-spp 256 -o report.html", "without the integrator"},
          {"a.exr b.exr --threshold flip=0.05", "exit code 1 when it is worse"}}},
        {"meter",
         {{"scene.glb --at 0,0.8,0", "lx and EV100 on a point, facing up"},
          {"scene.glb --pixel 640,360", "the luminance of a pixel"},
          {"scene.glb --from 0,1.6,3 --towards 0,1,0", "a spot meter of one degree"}}},
        {"bake",
         {{"sky.exr -o baked", "filtered levels, irradiance, harmonics"},
          {"sky.exr --preset filament -o baked", "for others: filament, threejs, gltf"},
          {"probes room.glb --stage room.stage.json", "fills its probes ahead of time"},
          {"dfg -o dfg_table.exr", "a table of directional albedos"}}},
        {"bake probes",
         {{"room.glb --stage room.stage.json", "into the cache that pictures look into"},
          {"room.glb --stage room.stage.json -o seen", "and pictures of what the probes see"}}},
        {"convert", {{"scene.glb --stage evening.stage.json -o lit.glb", "with the stage's lights"}}},
        {"validate",
         {{"-o validation", "all experiments and a page of them"},
          {"--only karis2013_figure2", "one of them"},
          {"--list", "their names"}}},
        {"light", {{"lamp.ies --plot web.svg", "lumens, beam, polar diagram"}}},
        {"env",
         {{"info sky.exr", "illuminance, percentiles, the sun"},
          {"calibrate sky.exr --grey-card 310,180,24,16 --value 2300 -o sky_nit.exr",
           "absolute, by a card of known cd/m2"},
          {"split sky.exr -o split", "its sun and lamps as lights of a stage"}}}};
    return all;
}

std::string footer(const std::string& command, const std::vector<Example>& list) {
    std::string out = "Examples:";
    for (const Example& e : list) {
        const std::string arguments = e.arguments;
        out += "\n  candela " + command + (arguments.empty() ? "" : " " + arguments) + "\n      " + e.what;
    }
    return out;
}

void arrange(CLI::App& command, const std::string& name) {
    for (CLI::Option* option : command.get_options()) {
        if (option->get_positional() || option->get_group() != "Options") continue;
        if (const std::string group = group_of(option->get_name()); !group.empty()) option->group(group);
    }
    const auto found = examples().find(name);
    if (found != examples().end()) command.footer(footer(name, found->second));
    for (CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; }))
        arrange(*sub, name.empty() ? sub->get_name() : name + " " + sub->get_name());
}

/// Other programs' names, and what is here for them; a text with a blank is a sentence of its own.
struct Synonym {
    const char* name;
    const char* here;
};

constexpr std::array kSynonyms{
    Synonym{"--denoise", "there is no denoiser: more --samples, or --mode path --target-error E"},
    Synonym{"--denoiser", "there is no denoiser: more --samples, or --mode path --target-error E"},
    Synonym{"--resolution", "--size"},
    Synonym{"--res", "--size"},
    Synonym{"--dimensions", "--size"},
    Synonym{"--out", "--output"},
    Synonym{"--file", "--output"},
    Synonym{"--hdri", "--env"},
    Synonym{"--hdr", "--env"},
    Synonym{"--environment", "--env"},
    Synonym{"--ibl", "--env"},
    Synonym{"--skybox", "--env"},
    Synonym{"--background", "--env"},
    Synonym{"--rotation", "--env-rotate"},
    Synonym{"--fov", "--focal-mm"},
    Synonym{"--focal-length", "--focal-mm"},
    Synonym{"--lens", "--focal-mm"},
    Synonym{"--zoom", "--focal-mm"},
    Synonym{"--exposure", "--ev100"},
    Synonym{"--ev", "--ev100"},
    Synonym{"--fstop", "--aperture"},
    Synonym{"--f-stop", "--aperture"},
    Synonym{"--f-number", "--aperture"},
    Synonym{"--dof", "--depth-of-field"},
    Synonym{"--focus", "--focus-m"},
    Synonym{"--focus-distance", "--focus-m"},
    Synonym{"--eye", "--look-from"},
    Synonym{"--position", "--look-from"},
    Synonym{"--camera-position", "--look-from"},
    Synonym{"--target", "--look-at"},
    Synonym{"--camera-target", "--look-at"},
    Synonym{"--tone-mapping", "--tonemap"},
    Synonym{"--tonemapping", "--tonemap"},
    Synonym{"--tone", "--tonemap"},
    Synonym{"--integrator", "--mode"},
    Synonym{"--renderer", "--mode"},
    Synonym{"--engine", "--mode"},
    Synonym{"--path", "--mode"},
    Synonym{"--quality", "--samples"},
    Synonym{"--bounces", "--max-bounces"},
    Synonym{"--depth", "--max-bounces"},
    Synonym{"--max-depth", "--max-bounces"},
    Synonym{"--time-budget", "--time-limit"},
    Synonym{"--timeout", "--time-limit"},
    Synonym{"--noise", "--target-error"},
    Synonym{"--gpu", "--device"},
    Synonym{"--cpu", "--device"},
    Synonym{"--frame", "--time"},
    Synonym{"--passes", "--aov"},
    Synonym{"--layers", "--aov"},
    Synonym{"--bits", "--png-bits"},
    Synonym{"--reference", "the last picture is the reference"},
};

std::string lower_extension(const std::string& file) {
    std::string out = std::filesystem::path(file).extension().string();
    std::transform(out.begin(), out.end(), out.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return out;
}

}  // namespace

void arrange_help(CLI::App& app) {
    const auto formatter = std::make_shared<Formatter>();
    app.formatter(formatter);
    const auto all = [](const CLI::App*) { return true; };
    for (CLI::App* command : app.get_subcommands(all)) {
        command->formatter(formatter);
        for (CLI::App* sub : command->get_subcommands(all)) sub->formatter(formatter);
    }
    arrange(app, "");
    app.footer("candela help COMMAND: its options and examples, as candela COMMAND --help");
}

std::vector<std::string> without_help_command(const CLI::App& app, std::vector<std::string> arguments) {
    if (arguments.empty() || arguments.front() != "help") return arguments;
    arguments.erase(arguments.begin());
    const CLI::App* at = &app;
    for (const std::string& word : arguments) {
        // Of a command that there is not, the parser says so.
        const auto named = at->get_subcommands([&](const CLI::App* sub) { return sub->get_name() == word; });
        if (word == "--help" || word == "-h") continue;
        if (named.empty() && at != &app)
            throw Error(Fault::usage, "no command of candela " + at->get_name(), word,
                        "candela help " + at->get_name());
        if (named.empty()) return arguments;
        at = named.front();
    }
    arguments.emplace_back("--help");
    return arguments;
}

std::string option_suggestion(const std::string& name, const std::vector<std::string>& known) {
    const auto has = [&](const std::string& option) {
        return std::find(known.begin(), known.end(), option) != known.end();
    };
    for (const Synonym& synonym : kSynonyms) {
        if (name != synonym.name) continue;
        const std::string here = synonym.here;
        if (here.find(' ') != std::string::npos) return here;
        if (has(here)) return "did you mean " + here + "?";
    }
    const std::string near = io::nearest_name(name, known);
    return near.empty() ? "" : "did you mean " + near + "?";
}

std::string command_for_file(const std::string& word) {
    const std::string e = lower_extension(word);
    if (e == ".glb" || e == ".gltf") return "candela render " + word;
    if (e == ".exr" || e == ".hdr" || e == ".ktx2" || e == ".dds")
        return "candela env info " + word + ", or candela compare " + word + " REFERENCE";
    if (e == ".png") return "candela compare " + word + " REFERENCE.png";
    if (e == ".ies" || e == ".ldt") return "candela light " + word;
    if (word.ends_with(".stage.json")) return "candela render SCENE.glb --stage " + word;
    std::error_code none;
    if (std::filesystem::is_regular_file(word, none)) return "candela render " + word;
    return {};
}

}  // namespace candela::app
