#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>

#include "candela/scene/error.hpp"
#include "demo_scenes.hpp"

namespace candela::scenes {

namespace {

void write(const std::filesystem::path& folder, const std::vector<std::string>& names) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) throw machine_error("the folder cannot be made: " + failure.message(), folder.string());
    for (const Demo& demo : demos())
        if (names.empty() || std::find(names.begin(), names.end(), demo.name) != names.end())
            demo.write(folder);
}

struct ManyLights {
    int count = 0;
    float range_m = 0.0f;
};

ManyLights many_lights_of(const std::string& text) {
    ManyLights m;
    char rest = 0;
    const int read = std::sscanf(text.c_str(), "%d:%f%c", &m.count, &m.range_m, &rest);
    const bool plain = read == 1 && text.find(':') == std::string::npos;
    if (!(plain || (read == 2 && m.range_m > 0.0f)) || m.count < 1 || m.count > 65536) m.count = 0;
    return m;
}

std::string is_many_lights(const std::string& text) {
    return many_lights_of(text).count > 0 ? ""
                                          : "a number of lamps up to 65536, or that and their range: 64:4.5";
}

int run(int argc, char** argv) {
    CLI::App app("Writes the demo scenes of Candela as glTF with stage files and environments.");
    std::filesystem::path folder;
    std::vector<std::string> names, known, many_lights;
    bool list = false;
    for (const Demo& demo : demos()) known.push_back(demo.name);
    app.add_option("FOLDER", folder, "Where to write; made if missing");
    // Of one word each, so that the folder may follow them.
    app.add_option("--only", names, "These scenes only")
        ->check(CLI::IsMember(known))
        ->delimiter(',')
        ->expected(1)
        ->allow_extra_args(false)
        ->take_all();
    app.add_option("--many-lights", many_lights,
                   "Instead: many_lights_COUNT for each COUNT, or COUNT:RANGE with the lamps' range in m")
        ->delimiter(',')
        ->expected(1)
        ->allow_extra_args(false)
        ->take_all()
        ->check(CLI::Validator(is_many_lights, "COUNT[:RANGE]"));
    app.add_flag("--list", list, "Say what there is, and write nothing");
    try {
        app.parse(argc, argv);
        if (!list && folder.empty()) throw CLI::RequiredError("FOLDER");
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::cerr << "candela-scenes: error: " << error.what() << " (candela-scenes --help)\n";
        return static_cast<int>(Fault::usage);
    }
    if (list) {
        for (const Demo& demo : demos()) std::cout << demo.name << ": " << demo.about << '\n';
        return 0;
    }
    if (many_lights.empty()) {
        write(folder, names);
    } else {
        std::filesystem::create_directories(folder);
        for (const std::string& text : many_lights) {
            const ManyLights m = many_lights_of(text);
            write_many_lights(folder, m.count, m.range_m);
        }
    }
    return 0;
}

}  // namespace
}  // namespace candela::scenes

int main(int argc, char** argv) {
    try {
        return candela::scenes::run(argc, argv);
    } catch (const candela::Error& error) {
        std::cerr << error.line() << '\n';
        return static_cast<int>(error.fault());
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return static_cast<int>(candela::Fault::machine);
    }
}
